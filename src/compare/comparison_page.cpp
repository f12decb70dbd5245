// What one asks first comes first: what was varied, which runs stand out, what decides, and whether it can be trusted.
#include "compare/comparison_page.h"

#include <fmt/format.h>

#include "compare/page_charts.h"
#include "compare/page_script.h"
#include "compare/scenarios.h"
#include "export/gnuplot.h"
#include "export/page.h"
#include "files/export_error.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {
namespace {

/// Of a correlation: "-0.53".
string hundredths(double value) {
  return fmt::format("{:.2f}", std::abs(value) < 0.005 ? 0.0 : value);
}

/// "rises with speed 0.83"
string trend_of(double correlation, const string& name) {
  return fmt::format("{} with <b class=\"p\">{}</b><small>{}</small>", correlation > 0 ? "rises" : "falls",
                     html_text(name), hundredths(correlation));
}

class ComparisonPage {
 public:
  static constexpr size_t most_measures = 8, most_figures = 24, most_heat_values = 40;
  static constexpr size_t most_differences = 8, most_varied = 10, most_shared = 1000;
  static constexpr size_t most_named = 4;  // parameters of a run in a line

  explicit ComparisonPage(const PageContent& content) : c_(content), looks_(content.measures.size()) {
    vector<string> paths;
    for (const Parameter& parameter : c_.plan.parameters) paths.push_back(parameter.path);
    names_ = short_names(paths);
    for (const MeasureFinding& finding : c_.findings.measures)
      for (const auto* points : {&finding.highest, &finding.lowest})
        for (const size_t point : *points) looks_[finding.measure].add(mean(point, finding.measure));
    shown_ = shown_findings(c_.findings, most_measures);
    draw_charts();
  }

  string text() {
    string text = page_head(c_.plan.title, string(comparison_style) + heat_style());
    text += fmt::format("<h1>{}</h1>\n{}{}", html_text(c_.plan.title), facts(), marks_);

    // The first screen: the question and the answers beside the first chart, or of unrelated runs beside all bars.
    string first;
    for (size_t k = 0; k < shown_.size() && (k == 0 || c_.findings.variety == Variety::runs); ++k) {
      if (charts_[k].empty()) continue;
      first += charts_[k].front();
      charts_[k].erase(charts_[k].begin());
    }
    text += fmt::format("<div class=\"columns\"><div>{}{}{}</div><div>{}{}{}</div></div>\n", question(), answers(),
                        trust(), first, missing_, correlations());

    for (size_t k = 0; k < shown_.size(); ++k) {
      const string block = joined(charts_[k], "") + rankings(*shown_[k]);
      if (!block.empty())
        text += fmt::format("<h2>{}</h2>\n<div class=\"row\">{}</div>\n", html_text(label(shown_[k]->measure)), block);
    }
    if (!charts_.back().empty())
      text += fmt::format("<h2>Further charts</h2>\n<div class=\"row\">{}</div>\n", joined(charts_.back(), ""));
    return text + table_of_runs() + shared() + string(comparison_script) + page_end();
  }

 private:
  double mean(size_t point, size_t measure) const { return c_.outcomes.spread(point, measure).mean(); }
  string label(size_t measure) const { return label_of(c_.measures[measure].name); }
  string label_of_parameter(size_t p) const { return label_of({names_[p], c_.plan.parameters[p].unit}); }

  /// Of each measure that is shown: its heat map, then its charts. Charts of others come last.
  void draw_charts() {
    charts_.resize(shown_.size() + 1);
    if (c_.findings.variety == Variety::plane)
      if (const auto parameters = heat_map_parameters(c_.plan, c_.outcomes))
        for (size_t k = 0; k < shown_.size(); ++k)
          charts_[k].push_back(heat_table(heat_map(c_.outcomes, *parameters, shown_[k]->measure, most_heat_values),
                                          c_.plan, c_.measures[shown_[k]->measure], c_.outcomes, c_.runs));

    vector<Plot> plots;
    vector<size_t> places;  // of plots, among charts_
    for (const Chart& chart : chosen_charts(c_.plan, c_.measures, c_.outcomes, c_.findings)) {
      const ChartData data = chart_data(chart, c_.plan, c_.measures, c_.outcomes, c_.findings.variety);
      if (data.x.empty()) continue;
      const auto of_chart = [&](const MeasureFinding* one) { return c_.measures[one->measure].name == chart.y; };
      const auto place = size_t(ranges::find_if(shown_, of_chart) - shown_.begin());

      if (!data.numeric) {
        charts_[place].push_back(bar_table(data));
      } else if (plots.size() < most_figures) {
        plots.push_back(plot_of(data));
        places.push_back(place);
      }
    }
    draw_plots(std::move(plots), places);
  }

  /// A comparison does not fail for want of gnuplot. One that fails is an error, and the same command goes on from
  /// there.
  void draw_plots(vector<Plot> plots, const vector<size_t>& places) {
    if (plots.empty()) return;
    string gnuplot;
    try {
      gnuplot = find_gnuplot();
    } catch (const ExportError& error) {
      // The remedy is a line of its own.
      string why = error.what();
      if (const size_t line = why.find("\n  "); line != string::npos) why.replace(line, 3, ": ");
      missing_ = fmt::format("<p class=\"doubtful\">{} left out: {}. Then compare the runs again.</p>\n",
                             how_many(plots.size(), "chart is", "charts are"), html_text(why));
      return;
    }

    const PageFigures figures = draw_figures(std::move(plots), gnuplot);
    marks_ = figures.marks;
    for (size_t i = 0; i < figures.figures.size(); ++i) charts_[places[i]].push_back(figures.figures[i]);
  }

  string facts() const {
    string text = fmt::format("<p><span class=\"flag\">{}{}</span>", how_many(c_.count.all, "run", "runs"),
                              c_.plan.seed ? fmt::format(" of {} scenarios", c_.outcomes.points()) : "");
    text += c_.count.failed == 0 ? "<span class=\"flag good\">none failed</span>"
                                 : fmt::format("<span class=\"flag failed\">{} failed</span>", c_.count.failed);
    text += c_.count.doubtful == 0 ? "<span class=\"flag good\">none doubtful</span>"
                                   : fmt::format("<span class=\"flag doubtful\">{} doubtful</span>", c_.count.doubtful);
    text += "</p>\n<p class=\"links\">" + html_link(summary_name, "summary.csv: all numbers") +
            html_link(workbook_name, "comparison.xlsx: the workbook");
    if (c_.plan.seed) text += html_link(repeats_name, "repeats.csv: means of repeats");
    return text + "<a href=\"#table\">table of runs</a></p>\n";
  }

  string question() const {
    if (!c_.differences.rows.empty()) return differences();
    if (c_.outcomes.varied().empty()) return "<h2>What was varied</h2>\n<p>Nothing: the scenes are the same.</p>\n";
    constexpr const char* head =
        "<div class=\"wide\"><table><tr><th>parameter</th><th class=\"n\">values</th><th class=\"n\">from</th>"
        "<th class=\"n\">to</th></tr>\n";
    constexpr const char* end = "</table></div>\n";

    string text = fmt::format("<h2>What was varied</h2>\n{}", head);
    const span<const Varied> all = c_.outcomes.varied();
    for (const Varied& varied : all.first(min(all.size(), most_varied))) text += varied_row(varied);
    text += end;
    if (all.size() <= most_varied) return text;

    text += fmt::format("<details><summary>and {} more</summary>{}", all.size() - most_varied, head);
    for (const Varied& varied : all.subspan(most_varied)) text += varied_row(varied);
    return text + end + "</details>\n";
  }

  string varied_row(const Varied& varied) const {
    const Parameter& parameter = c_.plan.parameters[varied.parameter];
    string text = fmt::format("<tr><td class=\"t\">{}</td>", html_text(parameter.path));
    if (varied.values.empty())
      return text + fmt::format("<td>{}</td><td class=\"t\" colspan=\"2\">repeats of each</td></tr>\n",
                                c_.outcomes.most_runs());

    text += fmt::format("<td>{}</td>", varied.values.size());
    for (const Cell* value : {&varied.values.front(), &varied.values.back()})
      text += fmt::format("<td>{}{}{}</td>", html_text(shown_value(*value)), parameter.unit.empty() ? "" : " ",
                          html_text(parameter.unit));
    return text + "</tr>\n";
  }

  /// Of unrelated runs.
  string differences() const {
    string text =
        "<h2>What differs</h2>\n<p>The scenes have little in common.</p>\n<div "
        "class=\"wide\"><table><tr><th>value</th>";
    for (const string& run : c_.differences.runs) text += fmt::format("<th>{}</th>", html_text(run));
    text += "</tr>\n";

    const size_t shown = min(c_.differences.rows.size(), most_differences);
    for (size_t i = 0; i < shown; ++i) {
      const Difference& row = c_.differences.rows[i];
      text += fmt::format("<tr><td class=\"t\">{}</td>", html_text(label_of(c_.plan.parameters[row.parameter])));
      for (const string& value : row.values)
        text += fmt::format("<td class=\"t\">{}</td>", value.empty() ? "–" : html_text(shown_value(cell_of(value))));
      text += "</tr>\n";
    }
    text += "</table></div>\n";
    if (shown == c_.differences.rows.size()) return text;
    return text +
           fmt::format("<p class=\"quiet\">And {} more, in the workbook.</p>\n", c_.differences.rows.size() - shown);
  }

  /// "angle = 45 °, speed = 20 m/s"
  string values_of(size_t point) const {
    string text;
    for (size_t k = 0; k < min(c_.findings.parameters.size(), most_named); ++k) {
      const size_t p = c_.findings.parameters[k];
      text += (text.empty() ? "" : ", ") +
              name_of_value({names_[p], c_.plan.parameters[p].unit}, shown_value(c_.outcomes.value(point, p)));
    }
    return text;
  }

  string extreme(const MeasureFinding& finding, size_t point, size_t equal) const {
    string text = fmt::format("<b>{}</b> {}<small>{}", looks_[finding.measure].text(mean(point, finding.measure)),
                              c_.runs.link(c_.outcomes.id(point)), html_text(values_of(point)));
    if (equal > 1) text += fmt::format("{}and in {} more", values_of(point).empty() ? "" : "; ", equal - 1);
    return text + "</small>";
  }

  string answers() const {
    string text;
    const bool decided = any_of(shown_, [](const MeasureFinding* one) { return one->strongest.has_value(); });
    for (const MeasureFinding* finding : shown_) {
      text += fmt::format("<tr><th>{}</th><td>{}</td><td>{}</td>", html_text(label(finding->measure)),
                          extreme(*finding, finding->top, finding->at_highest),
                          extreme(*finding, finding->bottom, finding->at_lowest));

      const auto strongest = finding->strongest;
      if (decided)
        text += fmt::format(
            "<td>{}</td>",
            strongest ? trend_of(finding->correlations[*strongest], names_[c_.findings.parameters[*strongest]]) : "–");
      text += "</tr>\n";
    }

    if (!text.empty())
      text = fmt::format(
          "<h2>Highest and lowest</h2>\n<div class=\"wide\"><table class=\"answers\"><tr><th>measure</th>"
          "<th>highest</th><th>lowest</th>{}</tr>\n{}</table></div>\n",
          decided ? "<th>decided by <small>rank correlation</small></th>" : "", text);
    else if (c_.count.all > 1)
      text = "<p>No measure differs between the runs.</p>\n";
    return text + same_in_all();
  }

  string same_in_all() const {
    string text;
    for (const MeasureFinding& finding : c_.findings.measures)
      if (finding.is_constant && finding.points == c_.outcomes.points() && c_.count.all > 1)
        text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", label(finding.measure),
                            short_number(mean(finding.highest.front(), finding.measure)));
    return text.empty() ? text : fmt::format("<p>The same in all runs: {}.</p>\n", html_text(text));
  }

  string trust() const {
    string text = "<h3>How sure it is</h3>\n<ul>";
    if (c_.count.failed + c_.count.doubtful == 0) text += "<li>All runs are complete, and none is doubtful.</li>";
    if (c_.count.failed > 0)
      text += fmt::format("<li class=\"failed\">{} failed and {} no values.</li>",
                          how_many(c_.count.failed, "run", "runs"), c_.count.failed == 1 ? "has" : "have");
    if (c_.count.doubtful > 0)
      text += fmt::format(
          "<li class=\"doubtful\">{} doubtful: figures may be wrong. The manifest.json of each has the "
          "reason.</li>",
          how_many(c_.count.doubtful, "run is", "runs are"));
    for (const MeasureFinding* finding : shown_) text += repeats_of(*finding);
    return text + "</ul>\n";
  }

  /// The spread of repeats beside the differences between scenarios.
  string repeats_of(const MeasureFinding& finding) const {
    if (!isfinite(finding.spread_of_repeats)) return {};
    const double range = mean(finding.top, finding.measure) - mean(finding.bottom, finding.measure);
    const double share = finding.spread_of_repeats / range;
    return fmt::format("<li>{}: repeats differ by ± {:.3g} (standard deviation), {}.</li>",
                       html_text(label(finding.measure)), finding.spread_of_repeats,
                       share < 1 ? fmt::format("{:.2g} % of the range of their means", 100 * share)
                                 : "more than their means do: what differs may be chance");
  }

  string correlations() const {
    const vector<size_t>& parameters = c_.findings.parameters;
    if (parameters.size() < 2 || shown_.empty()) return {};
    string text = "<h3>Rank correlations</h3>\n<div class=\"wide\"><table><tr><th>measure</th>";
    for (const size_t p : parameters) text += fmt::format("<th class=\"n\">{}</th>", html_text(label_of_parameter(p)));
    text += "</tr>\n";

    for (const MeasureFinding* finding : shown_) {
      text += fmt::format("<tr><td class=\"t\">{}</td>", html_text(label(finding->measure)));
      for (const double correlation : finding->correlations)
        text += isfinite(correlation) ? fmt::format("<td style=\"background:rgba({},{:.2f})\">{}</td>",
                                                    correlation > 0 ? "230,120,0" : "0,114,178",
                                                    0.75 * std::abs(correlation), hundredths(correlation))
                                      : "<td>–</td>";
      text += "</tr>\n";
    }
    return text +
           "</table></div>\n<p class=\"quiet\">1: the measure rises whenever the parameter does. -1: it falls. Near 0: "
           "neither; it may rise and then fall, which the charts show.</p>\n";
  }

  string ranked(const MeasureFinding& finding, const string& title, const vector<size_t>& points) const {
    const vector<size_t>& parameters = c_.findings.parameters;
    const size_t named = min(parameters.size(), most_named);
    string text = fmt::format(
        "<div><h3>{}</h3>\n<div class=\"wide\"><table class=\"rank\"><tr><th></th><th class=\"n\">value</th>"
        "<th>run</th>",
        title);
    for (size_t k = 0; k < named; ++k)
      text += fmt::format("<th class=\"n\">{}</th>", html_text(label_of_parameter(parameters[k])));
    text += "</tr>\n";

    for (size_t i = 0; i < points.size(); ++i) {
      const Spread spread = c_.outcomes.spread(points[i], finding.measure);
      text += fmt::format("<tr><td>{}</td><td>{}{}</td><td class=\"t\">{}</td>", i + 1,
                          looks_[finding.measure].text(spread.mean()),
                          c_.plan.seed && spread.count() > 1 ? " ± " + looks_[finding.measure].text(spread.sd()) : "",
                          c_.runs.link(c_.outcomes.id(points[i])));
      for (size_t k = 0; k < named; ++k)
        text += fmt::format("<td>{}</td>", html_text(shown_value(c_.outcomes.value(points[i], parameters[k]))));
      text += "</tr>\n";
    }
    return text + "</table></div></div>\n";
  }

  string rankings(const MeasureFinding& finding) const {
    // Few runs are one list.
    if (finding.highest.size() + finding.lowest.size() == finding.points) {
      if (c_.findings.variety == Variety::runs) return {};  // the bars have them
      vector<size_t> all = finding.highest;
      all.insert(all.end(), finding.lowest.rbegin(), finding.lowest.rend());
      return ranked(finding, "From the highest to the lowest", all);
    }

    const auto title = [](const char* end, size_t equal) {
      return equal > 1 ? fmt::format("{}: {} equal", end, equal) : string(end);
    };
    return fmt::format("<div class=\"pair\">{}{}</div>\n",
                       ranked(finding, title("Highest", finding.at_highest), finding.highest),
                       ranked(finding, title("Lowest", finding.at_lowest), finding.lowest));
  }

  string table_of_runs() const {
    string text = "<h2>Runs</h2>\n";
    text += fmt::format("<p><span id=\"shown\">{}</span></p>\n",
                        c_.runs.rows() < c_.count.all
                            ? fmt::format("The first {} of {} runs; summary.csv has all.", c_.runs.rows(), c_.count.all)
                            : how_many(c_.count.all, "run", "runs"));
    text +=
        "<p class=\"tools quiet\" hidden=\"\">A click on a head sorts. Fields below the heads filter. Boxes put up to "
        "six runs side by side, and their films play in step.</p>\n";
    if (const string constants = c_.runs.constants(); !constants.empty())
      text += fmt::format("<p class=\"quiet\">The same in all rows: {}.</p>\n", html_text(constants));
    return text + "<div id=\"table\">" + c_.runs.html() + "</div>\n";
  }

  string shared() const {
    if (c_.common.empty()) return {};
    string text = fmt::format("<details><summary>{} that all scenes share</summary><div class=\"wide\"><table>",
                              how_many(c_.common.size(), "value", "values"));
    const size_t rows = min(c_.common.size(), most_shared);
    for (size_t i = 0; i < rows; ++i)
      text += fmt::format("<tr><td class=\"t\">{}</td><td class=\"t\">{}</td><td class=\"t\">{}</td></tr>\n",
                          html_text(c_.common[i].path), html_text(c_.common[i].text), html_text(c_.common[i].unit));
    text += "</table></div>";
    if (rows < c_.common.size())
      text += fmt::format("<p class=\"quiet\">The first {}; the workbook has all.</p>", rows);
    return text + "</details>\n";
  }

  const PageContent& c_;
  vector<string> names_;      // short ones, by parameter
  vector<NumberLook> looks_;  // by measure
  vector<const MeasureFinding*> shown_;
  string marks_, missing_;
  vector<vector<string>> charts_;  // by shown_, then others
};

}  // namespace

string comparison_page(const PageContent& content) {
  return ComparisonPage(content).text();
}

}  // namespace carom
