// What one asks first comes first: what was varied, which runs stand out, what decides, and whether it can be trusted.
#include "compare/comparison_page.h"

#include <fmt/format.h>

#include "compare/page_charts.h"
#include "compare/page_script.h"
#include "compare/scenarios.h"
#include "export/child.h"
#include "export/page.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {
namespace {

constexpr size_t most_heat_maps = 12, most_figures = 24, most_differences = 20, most_heat_values = 40;
constexpr size_t most_shared = 1000;
constexpr size_t most_named = 4;  // parameters of a run in a line

string value_text(const Cell& cell) {
  return cell.is_number() ? short_number(cell.number) : cell.text;
}

/// "rises with speed (rank correlation 0.83)"
string trend_of(double correlation, const string& name) {
  return fmt::format("{} with <b class=\"p\">{}</b> <small>rank correlation {:.2f}</small>",
                     correlation > 0 ? "rises" : "falls", html_text(name), correlation);
}

class ComparisonPage {
 public:
  explicit ComparisonPage(const PageContent& content) : c_(content), looks_(content.measures.size()) {
    vector<string> paths;
    for (const Parameter& parameter : c_.plan.parameters) paths.push_back(parameter.path);
    names_ = short_names(paths);
    for (const MeasureFinding& finding : c_.findings.measures)
      for (const auto* points : {&finding.highest, &finding.lowest})
        for (const size_t point : *points) looks_[finding.measure].add(mean(point, finding.measure));
    draw_charts();
  }

  string text() {
    string text = page_head(c_.plan.title, string(comparison_style()) + heat_style());
    text += fmt::format("<h1>{}</h1>\n{}{}", html_text(c_.plan.title), facts(), marks_);

    // The first screen: the question and the answers beside the first chart.
    const string first = charts_.empty() ? "" : exchange(charts_.front(), "");
    text += fmt::format("<div class=\"columns\"><div>{}{}</div><div>{}{}</div></div>\n", question(), answers(), first,
                        trust());
    text += correlations() + missing_;
    if (charts_.size() > 1)
      text += fmt::format("<h2>More charts</h2>\n<div class=\"columns\">{}</div>\n", joined(charts_, ""));
    return text + ranking() + table_of_runs() + shared() + string(comparison_script()) + page_end();
  }

 private:
  double mean(size_t point, size_t measure) const { return c_.outcomes.spread(point, measure).mean(); }
  string label(size_t measure) const { return label_of(c_.measures[measure].name); }
  string label_of_parameter(size_t p) const { return label_of({names_[p], c_.plan.parameters[p].unit}); }

  /// Heat maps, then charts along numbers, then along texts.
  void draw_charts() {
    const bool is_plane = c_.findings.variety == Variety::plane;
    const auto parameters = is_plane ? heat_map_parameters(c_.plan, c_.outcomes) : nullopt;
    for (const MeasureFinding& finding : c_.findings.measures)
      if (parameters && !finding.is_constant && charts_.size() < most_heat_maps)
        charts_.push_back(heat_table(heat_map(c_.outcomes, *parameters, finding.measure, most_heat_values), c_.plan,
                                     c_.measures[finding.measure], c_.outcomes, c_.runs));

    vector<Plot> plots = plots_of(c_.charts);
    if (plots.size() > most_figures) plots.resize(most_figures);
    if (!plots.empty()) {
      if (const auto gnuplot = find_program("gnuplot")) {
        PageFigures figures = draw_figures(std::move(plots), *gnuplot);
        marks_ = std::move(figures.marks);
        std::move(figures.figures.begin(), figures.figures.end(), std::back_inserter(charts_));
      } else {
        missing_ = fmt::format(
            "<p class=\"doubtful\">{} left out, because gnuplot is not on the PATH: install it (on Debian: apt install "
            "gnuplot-nox), and compare again with --force.</p>\n",
            how_many(plots.size(), "chart is", "charts are"));
      }
    }

    for (const ChartData& chart : c_.charts)
      if (!chart.numeric && !chart.x.empty()) charts_.push_back(bar_table(chart));
  }

  string facts() const {
    string text = fmt::format("<p><span class=\"flag\">{}</span>", how_many(c_.count, "run", "runs"));
    text += c_.failed == 0 ? "<span class=\"flag good\">none failed</span>"
                           : fmt::format("<span class=\"flag failed\">{} failed</span>", c_.failed);
    text += c_.doubtful == 0 ? "<span class=\"flag good\">none doubtful</span>"
                             : fmt::format("<span class=\"flag doubtful\">{} doubtful</span>", c_.doubtful);
    text += "</p>\n<p class=\"links\">" + html_link(summary_name, "summary.csv: all numbers") +
            html_link(workbook_name, "comparison.xlsx: the workbook");
    if (c_.plan.seed) text += html_link(repeats_name, "repeats.csv: means of repeats");
    return text + "<a href=\"#table\">table of runs</a></p>\n";
  }

  string question() const {
    if (!c_.differences.rows.empty()) return differences();
    if (c_.outcomes.varied().empty()) return "<h2>What was varied</h2>\n<p>Nothing: the scenes are the same.</p>\n";
    string text =
        "<h2>What was varied</h2>\n<div class=\"wide\"><table><tr><th>parameter</th><th class=\"n\">values</th>"
        "<th class=\"n\">from</th><th class=\"n\">to</th><th>unit</th></tr>\n";
    for (const Varied& varied : c_.outcomes.varied()) {
      const Parameter& parameter = c_.plan.parameters[varied.parameter];
      text += fmt::format("<tr><td class=\"t\">{}</td>", html_text(parameter.path));
      if (varied.values.empty())
        text += "<td class=\"t\" colspan=\"4\">tells repeats apart</td></tr>\n";
      else
        text += fmt::format("<td>{}</td><td>{}</td><td>{}</td><td class=\"t\">{}</td></tr>\n", varied.values.size(),
                            html_text(value_text(varied.values.front())), html_text(value_text(varied.values.back())),
                            html_text(parameter.unit));
    }
    return text + "</table></div>\n";
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
        text += fmt::format("<td class=\"t\">{}</td>", value.empty() ? "–" : html_text(value_text(cell_of(value))));
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
      const Varied& varied = c_.outcomes.varied()[p];
      text += fmt::format(
          "{}{}", text.empty() ? "" : ", ",
          name_of_value({names_[p], c_.plan.parameters[p].unit}, value_text(varied.values[varied.of_point[point]])));
    }
    return text;
  }

  string extreme(const MeasureFinding& finding, const vector<size_t>& points, size_t equal) const {
    if (points.empty()) return {};
    const size_t point = points.front();
    string text = fmt::format("<b>{}</b> {}<small>{}", looks_[finding.measure].text(mean(point, finding.measure)),
                              c_.runs.link(c_.outcomes.id(point)), html_text(values_of(point)));
    if (equal > 1) text += fmt::format("{}and in {} more", values_of(point).empty() ? "" : "; ", equal - 1);
    return text + "</small>";
  }

  string answers() const {
    string text, constants;
    for (const MeasureFinding& finding : c_.findings.measures) {
      const string name = label(finding.measure);
      if (finding.is_constant || finding.points == 0) {
        constants += constants.empty() ? "" : ", ";
        constants += finding.points == 0 ? name + " (undefined)" : name;
        continue;
      }
      // Of few runs the lowest is the last of the highest ones.
      vector<size_t> lowest = finding.lowest;
      if (lowest.empty() && !finding.highest.empty()) lowest = {finding.highest.back()};
      const string trend = finding.strongest ? trend_of(finding.correlations[*finding.strongest],
                                                        names_[c_.findings.parameters[*finding.strongest]])
                                             : "";
      text += fmt::format("<tr><th>{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", html_text(name),
                          extreme(finding, finding.highest, finding.at_highest),
                          extreme(finding, lowest, finding.at_lowest), trend);
    }
    if (!text.empty())
      text =
          "<h2>Highest and lowest</h2>\n<div class=\"wide\"><table class=\"answers\"><tr><th>measure</th>"
          "<th>highest</th><th>lowest</th><th>decided by</th></tr>\n" +
          text + "</table></div>\n";
    if (!constants.empty()) text += fmt::format("<p>The same in all runs: {}.</p>\n", html_text(constants));
    return text;
  }

  string trust() const {
    string text = "<h3>How sure it is</h3>\n<ul>";
    if (c_.failed + c_.doubtful == 0) text += "<li>All runs are complete, and none is doubtful.</li>";
    if (c_.failed > 0)
      text += fmt::format("<li class=\"failed\">{} failed and {} no values.</li>", how_many(c_.failed, "run", "runs"),
                          c_.failed == 1 ? "has" : "have");
    if (c_.doubtful > 0)
      text += fmt::format(
          "<li class=\"doubtful\">{} doubtful: figures may be wrong. The manifest.json of each has the "
          "reason.</li>",
          how_many(c_.doubtful, "run is", "runs are"));
    for (const MeasureFinding& finding : c_.findings.measures)
      if (c_.plan.seed && !finding.is_constant) text += repeats_of(finding);
    return text + "</ul>\n";
  }

  /// The spread of repeats beside the differences between scenarios.
  string repeats_of(const MeasureFinding& finding) const {
    double squares = 0;
    size_t count = 0;
    Spread means;
    for (size_t i = 0; i < c_.outcomes.points(); ++i) {
      const Spread spread = c_.outcomes.spread(i, finding.measure);
      means.add(spread.mean());
      if (spread.count() < 2) continue;
      squares += spread.sd() * spread.sd();
      ++count;
    }
    if (count == 0) return {};
    const double sd = sqrt(squares / double(count)), range = means.max() - means.min();
    string text = fmt::format("<li>{}: repeats spread by ± {} (standard deviation)", html_text(label(finding.measure)),
                              short_number(sd));
    if (range > 0) text += fmt::format(", {:.2g} % of what the scenarios differ by", 100 * sd / range);
    return text + ".</li>";
  }

  string correlations() const {
    const vector<size_t>& parameters = c_.findings.parameters;
    if (parameters.size() < 2) return {};
    string text =
        "<h2>Rank correlations</h2>\n<p class=\"quiet\">1: the measure always rises with the parameter. -1: it always "
        "falls. 0: neither; it may still rise and then fall.</p>\n<div class=\"wide\"><table><tr><th>measure</th>";
    for (const size_t p : parameters) text += fmt::format("<th class=\"n\">{}</th>", html_text(label_of_parameter(p)));
    text += "</tr>\n";

    for (const MeasureFinding& finding : c_.findings.measures) {
      if (finding.is_constant) continue;
      text += fmt::format("<tr><td class=\"t\">{}</td>", html_text(label(finding.measure)));
      for (const double correlation : finding.correlations)
        text += isfinite(correlation) ? fmt::format("<td style=\"background:rgba({},{:.2f})\">{:.2f}</td>",
                                                    correlation > 0 ? "230,120,0" : "0,114,178",
                                                    0.75 * std::abs(correlation), correlation)
                                      : "<td>–</td>";
      text += "</tr>\n";
    }
    return text + "</table></div>\n";
  }

  string ranked(const MeasureFinding& finding, const char* title, const vector<size_t>& points) const {
    const vector<size_t>& parameters = c_.findings.parameters;
    const size_t named = min(parameters.size(), most_named);
    string text = fmt::format(
        "<div class=\"wide\"><table class=\"rank\"><tr><th></th><th class=\"n\">{}</th><th>run</th>", title);
    for (size_t k = 0; k < named; ++k)
      text += fmt::format("<th class=\"n\">{}</th>", html_text(label_of_parameter(parameters[k])));
    text += "</tr>\n";

    for (size_t i = 0; i < points.size(); ++i) {
      const Spread spread = c_.outcomes.spread(points[i], finding.measure);
      text += fmt::format("<tr><td>{}</td><td>{}{}</td><td class=\"t\">{}</td>", i + 1,
                          looks_[finding.measure].text(spread.mean()),
                          c_.plan.seed && spread.count() > 1 ? fmt::format(" ± {:.2g}", spread.sd()) : "",
                          c_.runs.link(c_.outcomes.id(points[i])));
      for (size_t k = 0; k < named; ++k) {
        const Varied& varied = c_.outcomes.varied()[parameters[k]];
        text += fmt::format("<td>{}</td>", html_text(value_text(varied.values[varied.of_point[points[i]]])));
      }
      text += "</tr>\n";
    }
    return text + "</table></div>\n";
  }

  string ranking() const {
    string text;
    for (const MeasureFinding& finding : c_.findings.measures) {
      if (finding.is_constant || finding.points == 0) continue;
      text += fmt::format("<details{}><summary>{}</summary><div class=\"columns\">{}{}</div></details>\n",
                          text.empty() ? " open=\"\"" : "", html_text(label(finding.measure)),
                          ranked(finding, "highest", finding.highest),
                          finding.lowest.empty() ? "" : ranked(finding, "lowest", finding.lowest));
    }
    return text.empty() ? "" : "<h2>Ranking</h2>\n" + text;
  }

  string table_of_runs() const {
    string text = "<h2>Runs</h2>\n";
    text += fmt::format("<p><span id=\"shown\">{}</span>{}. {}</p>\n",
                        c_.runs.rows() < c_.count ? fmt::format("The first {} of {}", c_.runs.rows(), c_.count) : "All",
                        how_many(c_.count, " run", " runs").substr(to_string(c_.count).size()),
                        c_.runs.rows() < c_.count ? html_link(summary_name, "summary.csv") + " has all." : "");
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
  string marks_, missing_;
  vector<string> charts_;
};

}  // namespace

string comparison_page(const PageContent& content) {
  return ComparisonPage(content).text();
}

}  // namespace carom
