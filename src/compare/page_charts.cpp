// Tables stay sharp at every size, can be copied, and need no gnuplot.
#include "compare/page_charts.h"

#include <fmt/format.h>

#include "compare/scenarios.h"
#include "scene/color_map.h"
#include "std.h"

namespace carom {
namespace {

/// Colours of the first lines, by PlotSeries::style: those that differ most.
constexpr size_t line_styles[] = {3, 0, 2, 4, 1, 5, 6, 7};
/// Points of a cloud, of which more would cover each other.
constexpr size_t most_in_cloud = 500;
constexpr size_t heat_steps = 48;
/// Of a map with more columns the numbers have no room, or all heads.
constexpr size_t most_numbered = 12, most_heads = 25;
constexpr size_t most_bar_rows = 40;

/// "speed" and "m/s" of "speed (m/s)".
pair<string, string> label_and_unit(const string& label) {
  const size_t open = label.rfind(" (");
  if (open == string::npos || !label.ends_with(")")) return {label, ""};
  return {label.substr(0, open), label.substr(open + 2, label.size() - open - 3)};
}

PlotSeries series_of(const ChartData& chart, size_t k) {
  const ChartLine& line = chart.lines[k];
  PlotSeries series{line.name, line_styles[k % plot_styles], {}};
  series.form = chart.joined && chart.x.size() > 1 ? PlotForm::marks : PlotForm::points;
  series.tint = 0.45 * double(k / plot_styles);

  const size_t every = chart.joined ? 1 : 1 + (max<size_t>(chart.x.size(), 1) - 1) / most_in_cloud;
  for (size_t row = 0; row < chart.x.size(); row += every) {
    const double y = line.y[row];
    if (!isfinite(y) || !chart.x[row].is_number()) continue;
    PlotPoint point{chart.x[row].number, y};
    if (!line.spread.empty() && line.spread[row] > 0) {
      point.low = y - line.spread[row];
      point.high = y + line.spread[row];
    }
    series.points.push_back(std::move(point));
  }
  return series;
}

/// Where its bar begins and how long it is, in per cent of the column.
pair<double, double> bar_of(double value, double low, double high) {
  if (!(high > low) || !isfinite(value)) return {0, 0};
  const double zero = (0 - low) / (high - low), at = (value - low) / (high - low);
  return {100 * min(zero, at), 100 * std::abs(at - zero)};
}

/// The only point with two values. None: there are several, or none.
constexpr size_t no_run = size_t(-1), several_runs = size_t(-2);
vector<size_t> points_of(const HeatMap& map, const Outcomes& outcomes) {
  const Varied &down = outcomes.varied()[map.down], &across = outcomes.varied()[map.across];
  vector<size_t> row(down.values.size(), no_run), column(across.values.size(), no_run);
  for (size_t i = 0; i < map.rows.size(); ++i) row[map.rows[i]] = i;
  for (size_t i = 0; i < map.columns.size(); ++i) column[map.columns[i]] = i;

  vector<size_t> points(map.means.size(), no_run);
  for (size_t i = 0; i < outcomes.points(); ++i) {
    const size_t r = row[down.of_point[i]], c = column[across.of_point[i]];
    if (r == no_run || c == no_run) continue;
    size_t& point = points[r * map.columns.size() + c];
    point = point == no_run ? i : several_runs;
  }
  return points;
}

}  // namespace

Plot plot_of(const ChartData& chart) {
  Plot plot;
  plot.title = chart.title;
  plot.scale = PlotScale::linear;
  tie(plot.x_label, plot.x_unit) = label_and_unit(chart.x_label);
  tie(plot.y_label, plot.y_unit) = label_and_unit(chart.y_label);

  bool has_spread = false;
  for (size_t k = 0; k < chart.lines.size(); ++k) {
    plot.series.push_back(series_of(chart, k));
    has_spread = has_spread || any_of(chart.lines[k].spread, [](double sd) { return sd > 0; });
  }
  if (has_spread) plot.subtitle = "bars: mean ± standard deviation of repeats";
  if (!chart.note.empty()) plot.subtitle += (plot.subtitle.empty() ? "" : "; ") + chart.note;
  return plot;
}

string bar_table(const ChartData& chart) {
  double low = 0, high = 0;
  NumberLook look;
  for (const ChartLine& line : chart.lines)
    for (const double y : line.y) {
      look.add(y);
      if (!isfinite(y)) continue;
      low = min(low, y);
      high = max(high, y);
    }

  string text = fmt::format("<figure class=\"bars\"><figcaption>{}</figcaption><div class=\"wide\"><table>",
                            html_text(chart.title));
  if (chart.lines.size() > 1) {
    text += fmt::format("<tr><th>{}</th>", html_text(chart.x_label));
    for (const ChartLine& line : chart.lines) text += fmt::format("<th colspan=\"2\">{}</th>", html_text(line.name));
    text += "</tr>\n";
  }

  const size_t shown = min(chart.x.size(), most_bar_rows);
  for (size_t row = 0; row < shown; ++row) {
    text += fmt::format("<tr><td class=\"t\">{}</td>", html_text(chart.x[row].text));
    for (const ChartLine& line : chart.lines) {
      const auto [begin, length] = bar_of(line.y[row], low, high);
      text += fmt::format("<td class=\"bar\"><i style=\"margin-left:{:.4g}%;width:{:.4g}%\"></i></td><td>{}</td>",
                          begin, length, look.text(line.y[row]));
    }
    text += "</tr>\n";
  }
  text += "</table></div>";
  if (shown < chart.x.size()) text += fmt::format("<p class=\"quiet\">The first {} of {}.</p>", shown, chart.x.size());
  return text + "</figure>\n";
}

string heat_class(double part) {
  return fmt::format("h{}", std::lround(clamp(part, 0.0, 1.0) * (heat_steps - 1)));
}

string heat_style() {
  string text;
  for (size_t step = 0; step < heat_steps; ++step) {
    const Color color = color_in(ColorMap::viridis, double(step) / (heat_steps - 1));
    const bool is_dark = 0.3 * color.r + 0.59 * color.g + 0.11 * color.b < 0.5;
    text += fmt::format(".h{}{{background:{}{}}}", step, hex_text(color), is_dark ? ";color:#fff" : "");
  }
  return text;
}

string heat_table(const HeatMap& map, const ComparisonPlan& plan, const Measure& measure, const Outcomes& outcomes,
                  const RunTable& runs) {
  const Varied &down = outcomes.varied()[map.down], &across = outcomes.varied()[map.across];
  const Parameter &rows = plan.parameters[map.down], &columns = plan.parameters[map.across];
  const vector<string> names = short_names({rows.path, columns.path});
  const vector<size_t> points = points_of(map, outcomes);
  const bool has_numbers = map.columns.size() <= most_numbered;

  NumberLook look;
  double low = infinity, high = -low;
  for (const double mean : map.means) {
    look.add(mean);
    if (!isfinite(mean)) continue;
    low = min(low, mean);
    high = max(high, mean);
  }

  string text = fmt::format(
      "<figure class=\"heat\"><figcaption>{}<small>down: {}; across: {}</small></figcaption>\n<div class=\"wide\">"
      "<table{}><tr><th></th>",
      html_text(label_of(measure.name)), html_text(label_of({names[0], rows.unit})),
      html_text(label_of({names[1], columns.unit})), has_numbers ? "" : " class=\"fine\"");
  const size_t every = 1 + (max<size_t>(map.columns.size(), 1) - 1) / most_heads;
  for (size_t k = 0; k < map.columns.size(); ++k)
    text += fmt::format("<th><span>{}</span></th>",
                        k % every == 0 ? html_text(shown_value(across.values[map.columns[k]])) : "");
  text += "</tr>\n";

  for (size_t i = 0; i < map.rows.size(); ++i) {
    text += fmt::format("<tr><th>{}</th>", html_text(shown_value(down.values[map.rows[i]])));
    for (size_t k = 0; k < map.columns.size(); ++k) {
      const double mean = map.mean(i, k);
      if (!isfinite(mean)) {
        text += "<td></td>";
        continue;
      }

      const size_t point = points[i * map.columns.size() + k];
      const string to = point < outcomes.points() ? runs.anchor(outcomes.id(point)) : "";
      const string title = fmt::format("{} = {}, {} = {}: {}", names[0], shown_value(down.values[map.rows[i]]),
                                       names[1], shown_value(across.values[map.columns[k]]), short_number(mean));
      text += fmt::format(
          "<td class=\"{}\"><a{} title=\"{}\">{}</a></td>", heat_class(high > low ? (mean - low) / (high - low) : 0.5),
          to.empty() ? "" : fmt::format(" href=\"{}\"", to), html_text(title), has_numbers ? look.text(mean) : "");
    }
    text += "</tr>\n";
  }

  text += "</table></div>\n<p class=\"scale\">" + look.text(low) + " <span>";
  for (size_t step = 0; step < heat_steps; step += 2) text += fmt::format("<i class=\"h{}\"></i>", step);
  return text + fmt::format("</span> {}</p></figure>\n", look.text(high));
}

}  // namespace carom
