// Draws the charts with libxlsxwriter.
// Axis ends are computed here, because a spreadsheet ignores error bars when it chooses them.
#include "compare/sheet_charts.h"

#include <fmt/format.h>

#include "std.h"

namespace carom {
namespace {

constexpr const char* points_name = "Points";
/// Error bars of a chart. Each is a series of its own.
constexpr size_t most_bars = 120;
constexpr size_t most_marked = 200;  // points of a line with markers

// Distinct for people with colour vision deficiency, too (Okabe and Ito 2008).
constexpr array<lxw_color_t, 8> colors = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7,
                                          0xE69F00, 0x56B4E9, 0x595959, 0x8C510A};

lxw_color_t color_of(size_t number) {
  return colors[number % colors.size()];
}

struct CellRange {
  const char* sheet;
  size_t first_row, column, last_row;
};

lxw_chart_series* add_series(lxw_chart* chart, const CellRange& x, const CellRange& y, const string& name) {
  lxw_chart_series* series = chart_add_series(chart, nullptr, nullptr);
  chart_series_set_categories(series, x.sheet, to_row(x.first_row), to_column(x.column), to_row(x.last_row),
                              to_column(x.column));
  chart_series_set_values(series, y.sheet, to_row(y.first_row), to_column(y.column), to_row(y.last_row),
                          to_column(y.column));
  if (!name.empty()) chart_series_set_name(series, name.c_str());
  return series;
}

void set_line(lxw_chart_series* series, size_t number, bool drawn) {
  lxw_chart_line line{};
  line.color = color_of(number);
  line.dash_type = uint8_t(number < colors.size() ? LXW_CHART_LINE_DASH_SOLID : LXW_CHART_LINE_DASH_DASH);
  line.width = 1.75F;
  line.none = drawn ? LXW_FALSE : LXW_TRUE;
  chart_series_set_line(series, &line);
}

void set_marker(lxw_chart_series* series, size_t number, bool drawn) {
  chart_series_set_marker_type(series, drawn ? LXW_CHART_MARKER_CIRCLE : LXW_CHART_MARKER_NONE);
  if (!drawn) return;
  lxw_chart_fill fill{};
  fill.color = color_of(number);
  lxw_chart_line edge{};
  edge.color = fill.color;
  chart_series_set_marker_size(series, 5);
  chart_series_set_marker_fill(series, &fill);
  chart_series_set_marker_line(series, &edge);
}

void set_texts(lxw_chart* chart, const string& title, const string& x, const string& y, bool legend) {
  lxw_chart_font large{}, small{};
  large.size = 12;
  large.bold = LXW_TRUE;
  small.size = 10;
  small.bold = LXW_EXPLICIT_FALSE;
  chart_title_set_name(chart, title.c_str());
  chart_title_set_name_font(chart, &large);
  chart_axis_set_name(chart->x_axis, x.c_str());
  chart_axis_set_name_font(chart->x_axis, &small);
  chart_axis_set_name(chart->y_axis, y.c_str());
  chart_axis_set_name_font(chart->y_axis, &small);
  // Beside the plot and not along an axis that may cross it.
  chart_axis_set_label_position(chart->x_axis, LXW_CHART_AXIS_LABEL_POSITION_LOW);
  chart_axis_set_label_position(chart->y_axis, LXW_CHART_AXIS_LABEL_POSITION_LOW);
  lxw_chart_line grid{};
  grid.color = 0xD9D9D9;
  grid.width = 0.75F;
  chart_axis_major_gridlines_set_line(chart->y_axis, &grid);
  chart_legend_set_position(chart, legend ? LXW_CHART_LEGEND_BOTTOM : LXW_CHART_LEGEND_NONE);
}

/// Draws a standard deviation up and down from one point.
/// It is a series of its own, because the error bars of one series all have the same length.
void add_bar(lxw_chart* chart, const CellRange& x, const CellRange& y, size_t row, double length, size_t number) {
  lxw_chart_series* point = add_series(chart, {x.sheet, row, x.column, row}, {y.sheet, row, y.column, row}, "");
  set_line(point, number, false);
  set_marker(point, number, false);
  lxw_chart_line line{};
  line.color = color_of(number);
  line.width = 1.25F;
  chart_series_set_error_bars(point->y_error_bars, LXW_CHART_ERROR_BAR_TYPE_FIXED, length);
  chart_series_set_error_bars_line(point->y_error_bars, &line);
}

/// Sets the ends of an axis so that it contains `low` to `high`.
/// A spreadsheet ignores error bars and lets columns begin anywhere.
/// Zero is included if that takes less than half of the axis.
void set_ends(lxw_chart_axis* axis, double low, double high) {
  if (!(high > low)) return;
  if (low > 0 && low < 0.5 * high) low = 0;
  if (high < 0 && high > 0.5 * low) high = 0;
  // Choose a step of 1, 2 or 5 times a power of ten, with four to ten steps.
  double step = 1;
  while (step * 10 < high - low) step *= 10;
  while (step > high - low) step /= 10;
  for (const double part : {0.5, 0.4, 0.5})
    if ((high - low) / step < 4) step *= part;
  chart_axis_set_min(axis, step * floor(low / step));
  chart_axis_set_max(axis, step * ceil(high / step));
  chart_axis_set_major_unit(axis, step);
}

/// The least and the greatest value drawn, including error bars.
pair<double, double> ends_of(const ChartData& data) {
  double low = infinity, high = -low;
  for (const ChartLine& line : data.lines)
    for (size_t row = 0; row < line.y.size(); ++row) {
      if (!isfinite(line.y[row])) continue;
      const double sd = line.spread.empty() || !(line.spread[row] > 0) ? 0 : line.spread[row];
      low = min(low, line.y[row] - sd);
      high = max(high, line.y[row] + sd);
    }
  return {low, high};
}

size_t bars_of(const ChartData& data) {
  size_t bars = 0;
  for (const ChartLine& line : data.lines)
    bars += size_t(ranges::count_if(line.spread, [](double sd) { return sd > 0; }));
  return bars;
}

/// The library's charts have 480 x 288 pixels.
void insert(Worksheet& sheet, lxw_chart* chart, const ChartPlace& place) {
  lxw_chart_options options{};
  options.x_scale = place.width / 480.0;
  options.y_scale = place.height / 288.0;
  options.y_offset = 3;
  options.object_position = LXW_OBJECT_MOVE_DONT_SIZE;
  worksheet_insert_chart_opt(sheet.get(), to_row(place.row), to_column(place.column), chart, &options);
}

}  // namespace

SheetCharts::SheetCharts(Workbook& book, bool streamed) : book_(book), points_(book.add(points_name, streamed)) {}

void SheetCharts::draw(Worksheet& sheet, const ChartData& data, const ChartPlace& place) {
  if (data.x.empty()) return;
  const size_t first_row = write_points(data);
  const size_t last_row = first_row + data.x.size() - 1;
  const size_t bars = bars_of(data);
  const bool barred = data.numeric && bars > 0 && bars <= most_bars;

  // Texts along x are drawn as columns, in their order.
  lxw_chart* chart = book_.add_chart(data.numeric ? LXW_CHART_SCATTER : LXW_CHART_COLUMN);
  const CellRange x{points_name, first_row, 0, last_row};

  for (size_t k = 0; k < data.lines.size(); ++k) {
    lxw_chart_series* series = add_series(chart, x, {points_name, first_row, 1 + k, last_row}, data.lines[k].name);
    if (data.numeric) {
      set_line(series, k, data.joined && data.x.size() > 1);
      set_marker(series, k, data.x.size() <= most_marked || !data.joined);
    } else {
      lxw_chart_fill fill{};
      fill.color = color_of(k);
      chart_series_set_fill(series, &fill);
    }
  }

  // Error bars are series without names.
  vector<int16_t> unnamed;
  for (size_t k = 0; barred && k < data.lines.size(); ++k)
    for (size_t row = 0; row < data.x.size(); ++row)
      if (const double sd = data.lines[k].spread[row]; sd > 0) {
        unnamed.push_back(int16_t(data.lines.size() + unnamed.size()));
        add_bar(chart, x, {points_name, first_row, 1 + k, last_row}, first_row + row, sd, k);
      }
  unnamed.push_back(-1);

  string title = data.title;
  if (barred) title += ", mean ± standard deviation";
  if (!data.note.empty()) title += fmt::format(" ({})", data.note);
  set_texts(chart, title, data.x_label, data.y_label, data.lines.size() > 1);
  if (unnamed.size() > 1) chart_legend_delete_series(chart, unnamed.data());

  chart_show_blanks_as(chart, LXW_CHART_BLANKS_AS_CONNECTED);
  const auto [low, high] = ends_of(data);
  if (barred) set_ends(chart->y_axis, low, high);
  if (!data.numeric && low >= 0) chart_axis_set_min(chart->y_axis, 0);
  insert(sheet, chart, place);
}

void SheetCharts::draw_over_time(Worksheet& sheet, const vector<PlacedSeries>& series, size_t scenarios,
                                 const ChartPlace& place) {
  lxw_chart* chart = book_.add_chart(LXW_CHART_SCATTER_STRAIGHT);
  const string& name = series.front().name;
  size_t drawn = 0;
  double low = numeric_limits<double>::quiet_NaN(), high = low;

  for (const PlacedSeries& one : series) {
    if (one.name != name) continue;
    lxw_chart_series* line = add_series(chart, {"Series", 1, one.time_column, one.rows},
                                        {"Series", 1, one.value_column, one.rows}, one.scenario);
    set_line(line, drawn, true);
    set_marker(line, 0, false);
    ++drawn;
    low = std::fmin(low, one.least);
    high = std::fmax(high, one.greatest);
  }

  // An axis of rounding errors shows nothing.
  constexpr double noise = 1e-6;
  const double largest = max(std::abs(low), std::abs(high));
  if (high - low < noise * largest) set_ends(chart->y_axis, min(low, 0.0), max(high, 0.0));

  string title = fmt::format("{} over time", label_of(name));
  if (scenarios > drawn) title += fmt::format(" ({} of {})", drawn, scenarios);
  set_texts(chart, title, "time (s)", label_of(name), drawn > 1);
  insert(sheet, chart, place);
}

/// The points of a chart, below those of the charts before it. Returns the row of the first one.
size_t SheetCharts::write_points(const ChartData& chart) {
  const size_t first_row = row_;
  points_.text(first_row, 0, chart.title, CellStyle::note);
  points_.set_head_row(first_row + 1);
  points_.head(first_row + 1, 0, chart.x_label, CellStyle::varied_header);

  // All lines are measured before the first number is written, and share one look.
  NumberLook x_look, look;
  for (const Cell& x : chart.x) x_look.add(x.number);
  for (size_t k = 0; k < chart.lines.size(); ++k) {
    const string& name = chart.lines[k].name;
    points_.head(first_row + 1, 1 + k, name.empty() ? chart.y_label : name);
    for (const double y : chart.lines[k].y) look.add(y);
  }

  for (size_t row = 0; row < chart.x.size(); ++row) {
    points_.cell(first_row + 2 + row, 0, chart.x[row], CellStyle::varied, &x_look);
    for (size_t k = 0; k < chart.lines.size(); ++k)
      points_.number(first_row + 2 + row, 1 + k, chart.lines[k].y[row], CellStyle::plain, &look);
  }

  row_ = first_row + 3 + chart.x.size();
  return first_row + 2;
}

void SheetCharts::finish() {
  points_.fit_all(10, 30);
  points_.print_first_page();
}

}  // namespace carom
