// A grid of narrow columns, as wide as a printed page: heat maps have a column for each value, and everything else
// takes several. Below the answers a block for each measure has its figure on the left and its ranking on the right.
#include "compare/compare_sheet.h"

#include <fmt/format.h>

#include "compare/scenarios.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

constexpr size_t columns = 48, figure_columns = 27, ranking_columns = columns - figure_columns - 1;
constexpr double column_pixels = 27, row_pixels = 19;
constexpr double row_height = 14.25;                      // points
constexpr double column_width = (column_pixels - 5) / 7;  // characters
/// Rows of a printed page.
constexpr size_t page_rows = 43;
/// A ranking has a title, heads, its runs, and space below it.
constexpr size_t unit_rows = MeasureFinding::most_ranked + 4;
constexpr size_t most_measures = 6, most_heat_values = figure_columns - 2, most_differences = 12;
constexpr size_t chart_rows = 19;
constexpr size_t turned_rows = 2;  // beyond one, of turned heads

/// The columns of each item of a row.
constexpr size_t measure_columns = 10, number_columns = 4, value_columns = 3, parameter_columns = 2,
                 correlation_columns = 3;

struct Layout {
  size_t id;                  // columns of a run's id
  vector<size_t> parameters;  // places in Findings::parameters that rankings have
  bool beside;                // whether the highest and the lowest runs stand side by side
};

size_t ranked_width(size_t id, size_t parameters) {
  return id + value_columns + parameters * parameter_columns;
}

Layout layout_of(const FrontPage& page) {
  constexpr double letter = 8, margin = 6;  // pixels
  double widest = 0;
  for (const MeasureFinding& finding : page.findings.measures)
    for (const auto* points : {&finding.highest, &finding.lowest})
      for (const size_t point : *points) widest = max(widest, letter * double(letters_of(page.outcomes.id(point))));
  const size_t id = size_t(clamp(ceil((widest + margin) / column_pixels), 2.0, 6.0));

  const size_t all = page.findings.parameters.size();
  const bool beside = 2 * ranked_width(id, all) + 1 <= ranking_columns;
  const size_t most = (ranking_columns - id - value_columns) / parameter_columns;
  return {id, evenly_spaced(all, beside ? all : most), beside};
}

/// Short names of the parameters that vary.
vector<string> names_of(const FrontPage& page) {
  vector<string> paths;
  for (const size_t p : page.findings.parameters) paths.push_back(page.plan.parameters[p].path);
  return short_names(paths);
}

/// Of all values of a parameter, by its place in Findings::parameters.
NumberLook look_of(const FrontPage& page, size_t place) {
  NumberLook look;
  for (const Cell& value : page.outcomes.varied()[page.findings.parameters[place]].values) look.add(value.number);
  return look;
}

double value_of(const FrontPage& page, const MeasureFinding& finding, size_t point) {
  return page.outcomes.spread(point, finding.measure).mean();
}

NumberLook look_of(const FrontPage& page, const MeasureFinding& finding) {
  NumberLook look;
  for (const auto* points : {&finding.highest, &finding.lowest})
    for (const size_t point : *points) look.add(value_of(page, finding, point));
  return look;
}

void add_correlation_scale(Worksheet& sheet, size_t row, size_t column, size_t rows, size_t width) {
  lxw_conditional_format scale{};
  scale.type = LXW_CONDITIONAL_3_COLOR_SCALE;
  scale.min_rule_type = scale.mid_rule_type = scale.max_rule_type = LXW_CONDITIONAL_RULE_TYPE_NUMBER;
  scale.min_value = -1;
  scale.mid_value = 0;
  scale.max_value = 1;
  scale.min_color = 0x8FBFE0;
  scale.mid_color = 0xFFFFFF;
  scale.max_color = 0xF4B183;
  worksheet_conditional_format_range(sheet.get(), to_row(row), to_column(column), to_row(row + rows - 1),
                                     to_column(column + width - 1), &scale);
}

/// Cells of a map with few columns are wider.
size_t columns_of_cell(const HeatMap& map) {
  return clamp<size_t>(most_heat_values / max<size_t>(map.columns.size(), 1), 1, 4);
}

/// The columns of the answers.
struct AnswerColumns {
  size_t id = 0;            // columns of a run's id
  size_t values = 0;        // how many parameters have their values, if there is room
  size_t correlations = 0;  // how many have a correlation
  size_t before_correlations = 0;
};

AnswerColumns answer_columns(const FrontPage& page) {
  AnswerColumns answer;
  answer.id = layout_of(page).id;
  const size_t all = page.findings.parameters.size();
  size_t fixed = measure_columns + 2 * (number_columns + answer.id) + (page.plan.seed ? number_columns : 0);
  if (fixed + all * (2 * value_columns + correlation_columns) <= columns) answer.values = all;
  fixed += 2 * answer.values * value_columns;
  answer.correlations = min(all, (columns - fixed) / correlation_columns);
  answer.before_correlations = fixed;
  return answer;
}

/// Writes cells of a row from left to right.
struct RowOfCells {
  Worksheet& sheet;
  size_t row, column = 0;

  void put(size_t width, const Cell& value, CellStyle style, const NumberLook* look = nullptr) {
    sheet.wide(row, column, width, value, style, look);
    column += width;
  }
};

void write_answer_heads(Worksheet& sheet, size_t row, const FrontPage& page, const AnswerColumns& answer) {
  const vector<string> names = names_of(page);
  RowOfCells heads{sheet, row};
  heads.put(measure_columns, Cell{"measure"}, CellStyle::header);
  for (const char* end : {"highest", "lowest"}) {
    heads.put(number_columns, Cell{end}, CellStyle::fitted_header);
    heads.put(answer.id, Cell{"run"}, CellStyle::fitted_header);
    for (size_t k = 0; k < answer.values; ++k) heads.put(value_columns, Cell{names[k]}, CellStyle::fitted_varied);
  }

  if (page.plan.seed) heads.put(number_columns, Cell{"repeats, sd"}, CellStyle::fitted_header);
  for (size_t k = 0; k < answer.correlations; ++k)
    heads.put(correlation_columns, Cell{"ρ " + names[k]}, CellStyle::fitted_header);
}

/// `looks`: of the parameters' values.
void write_answer(Worksheet& sheet, size_t row, const FrontPage& page, const MeasureFinding& finding,
                  const AnswerColumns& answer, const vector<NumberLook>& looks) {
  const NumberLook look = look_of(page, finding);
  RowOfCells cells{sheet, row};
  cells.put(measure_columns, Cell{label_of(page.measures[finding.measure].name)}, CellStyle::total);

  for (const auto& [point, equal] : {pair(finding.top, finding.at_highest), pair(finding.bottom, finding.at_lowest)}) {
    cells.put(number_columns, Cell{{}, value_of(page, finding, point)}, CellStyle::fitted, &look);
    const string others = equal > 1 ? fmt::format(" +{}", equal - 1) : "";
    cells.put(answer.id, Cell{string(page.outcomes.id(point)) + others}, CellStyle::fitted_name);
    for (size_t k = 0; k < answer.values; ++k)
      cells.put(value_columns, page.outcomes.value(point, page.findings.parameters[k]), CellStyle::fitted_varied,
                &looks[k]);
  }

  if (page.plan.seed) cells.put(number_columns, Cell{{}, finding.spread_of_repeats}, CellStyle::fitted, &look);
  NumberLook hundredths;
  hundredths.add(0.12);
  for (size_t k = 0; k < answer.correlations; ++k)
    cells.put(correlation_columns, Cell{{}, finding.correlations[k]},
              k == finding.strongest ? CellStyle::total : CellStyle::fitted, &hundredths);
}

}  // namespace

/// Begins a new printed page unless so many rows still have room on this one.
void CompareSheet::begin_page(size_t rows) {
  if (row_ + extra_ + rows <= page_ + page_rows || row_ == page_) return;
  breaks_.push_back(row_);
  page_ = row_;
  extra_ = 0;
}

/// Of unrelated runs: the values that matter most.
void CompareSheet::write_differences(const FrontPage& page) {
  const DifferenceList& differences = page.differences;
  if (differences.rows.empty()) return;
  constexpr size_t columns_of_path = 12;
  const size_t width = (columns - columns_of_path) / max<size_t>(differences.runs.size(), 4);

  sheet_.wide(row_, 0, columns_of_path, Cell{"What differs"}, CellStyle::header);
  for (size_t k = 0; k < differences.runs.size(); ++k)
    sheet_.wide(row_, columns_of_path + k * width, width, Cell{differences.runs[k]}, CellStyle::fitted_header);
  ++row_;

  const size_t shown = min(differences.rows.size(), most_differences);
  for (size_t i = 0; i < shown; ++i, ++row_) {
    const Difference& difference = differences.rows[i];
    sheet_.wide(row_, 0, columns_of_path, Cell{label_of(page.plan.parameters[difference.parameter])});
    for (size_t k = 0; k < difference.values.size(); ++k) {
      const string& value = difference.values[k];
      sheet_.wide(row_, columns_of_path + k * width, width, value.empty() ? Cell{"-"} : cell_of(value),
                  CellStyle::fitted_name);
    }
  }

  if (shown < differences.rows.size())
    sheet_.text(row_++, 0, fmt::format("and {} more, on the sheet Parameters", differences.rows.size() - shown),
                CellStyle::note);
  ++row_;
}

/// A row for each measure: its highest and lowest value, their runs, and its rank correlation with each parameter.
void CompareSheet::write_answers(const FrontPage& page) {
  const vector<const MeasureFinding*> shown = shown_findings(page.findings, most_measures);
  if (shown.empty()) return;
  const AnswerColumns answer = answer_columns(page);
  write_answer_heads(sheet_, row_++, page, answer);

  const size_t first_row = row_;
  for (const MeasureFinding* finding : shown) write_answer(sheet_, row_++, page, *finding, answer, looks_);
  if (answer.correlations > 0) {
    add_correlation_scale(sheet_, first_row, answer.before_correlations, row_ - first_row,
                          answer.correlations * correlation_columns);
    sheet_.text(row_++, 0,
                "ρ: Spearman's rank correlation, from -1 (falls) to 1 (rises); the strongest is bold. What rises and "
                "falls again has none: see the figures.",
                CellStyle::note);
  }
  ++row_;
}

/// The runs with the highest and the lowest values, beginning at the present row.
void CompareSheet::write_ranking(const FrontPage& page, const MeasureFinding& finding, size_t first_column) {
  const Layout layout = layout_of(page);
  const vector<string> names = names_of(page);
  const string label = label_of(page.measures[finding.measure].name);
  const NumberLook look = look_of(page, finding);
  const size_t width = ranked_width(layout.id, layout.parameters.size());

  size_t row = row_, column = first_column;
  for (const bool is_high : {true, false}) {
    const vector<size_t>& points = is_high ? finding.highest : finding.lowest;
    if (points.empty()) break;
    const size_t equal = is_high ? finding.at_highest : finding.at_lowest;
    string title = fmt::format("{}: {}", label, finding.lowest.empty() ? "all" : is_high ? "highest" : "lowest");
    if (equal > 1) title += fmt::format(" ({} equal)", equal);

    sheet_.wide(row, column, width, Cell{title}, CellStyle::total);
    sheet_.wide(row + 1, column, layout.id, Cell{"run"}, CellStyle::fitted_header);
    sheet_.wide(row + 1, column + layout.id, value_columns, Cell{"value"}, CellStyle::fitted_header);
    for (size_t k = 0; k < layout.parameters.size(); ++k)
      sheet_.wide(row + 1, column + ranked_width(layout.id, k), parameter_columns, Cell{names[layout.parameters[k]]},
                  CellStyle::fitted_varied);

    for (size_t i = 0; i < points.size(); ++i) {
      const size_t at = row + 2 + i;
      sheet_.wide(at, column, layout.id, Cell{string(page.outcomes.id(points[i]))}, CellStyle::fitted_name);
      sheet_.wide(at, column + layout.id, value_columns, Cell{{}, value_of(page, finding, points[i])},
                  CellStyle::fitted, &look);
      for (size_t k = 0; k < layout.parameters.size(); ++k)
        sheet_.wide(at, column + ranked_width(layout.id, k), parameter_columns,
                    page.outcomes.value(points[i], page.findings.parameters[layout.parameters[k]]),
                    CellStyle::fitted_varied, &looks_[layout.parameters[k]]);
    }

    // The lowest stand beside the highest, or below them.
    if (layout.beside)
      column += width + 1;
    else
      row += points.size() + 2;
  }
}

/// A heat map on the left.
void CompareSheet::write_map(const FrontPage& page, const HeatMap& map, size_t measure) {
  const auto axis = [&](const char* direction, size_t parameter, size_t shown) {
    const size_t all = page.outcomes.varied()[parameter].values.size();
    return fmt::format("{} {}{}", direction, page.plan.parameters[parameter].path,
                       shown < all ? fmt::format(" ({} of {} values)", shown, all) : "");
  };
  sheet_.text(row_, 0,
              fmt::format("{}: {}, {}", label_of(page.measures[measure].name), axis("down", map.down, map.rows.size()),
                          axis("across", map.across, map.columns.size())),
              CellStyle::section);

  HeatMapPlace place{row_ + 1, 0, 2, true, columns_of_cell(map)};
  if (place.is_turned()) {
    sheet_.set_head_row(row_ + 1, 1 + turned_rows);
    extra_ += turned_rows;
  }
  write_heat_map(sheet_, page.plan, page.outcomes, map, measure, place, page.summary);
}

/// A measure with its figure and its ranking. `left`: charts of the measure, of which those with room are taken.
void CompareSheet::write_block(const FrontPage& page, const MeasureFinding& finding, vector<ChartData>& left,
                               SheetCharts& charts) {
  const bool beside = layout_of(page).beside;
  size_t rows = beside ? unit_rows : 2 * unit_rows;
  optional<HeatMap> map;
  if (page.heat_map) {
    map = heat_map(page.outcomes, *page.heat_map, finding.measure, most_heat_values);
    rows = max(rows, (map->rows.size() + 3 + unit_rows - 1) / unit_rows * unit_rows);
  }
  begin_page(rows + (map && columns_of_cell(*map) == 1 ? turned_rows : 0));
  sheet_.set_heights(row_, row_ + rows, row_height);

  // Beside a high map there is room for a chart below the ranking.
  const auto take_chart = [&](size_t row, size_t column, size_t width) {
    if (left.empty()) return;
    charts.draw(sheet_, left.front(),
                {row, column, double(width) * column_pixels - 6, double(unit_rows) * row_pixels - 6});
    left.erase(left.begin());
  };
  if (map) write_map(page, *map, finding.measure);
  if (map && beside && rows > unit_rows) take_chart(row_ + unit_rows, figure_columns + 1, ranking_columns);
  for (size_t row = 0; !map && row < rows; row += unit_rows) take_chart(row_ + row, 0, figure_columns);

  write_ranking(page, finding, figure_columns + 1);
  row_ += rows;
}

void CompareSheet::write(const FrontPage& page, SheetCharts& charts) {
  worksheet_set_column(sheet_.get(), 0, to_column(columns - 1), column_width, nullptr);
  sheet_.text(row_++, 0, page.plan.title, CellStyle::title);
  for (const string& line : page.lines) sheet_.note(row_++, columns, line, columns * column_pixels / 6.5);
  for (size_t place = 0; place < page.findings.parameters.size(); ++place) looks_.push_back(look_of(page, place));
  const size_t first = row_++;
  write_answers(page);
  write_differences(page);
  sheet_.set_heights(first, row_, row_height);

  // A block for each measure, with its own charts. The others follow.
  vector<ChartData> others;
  map<string, vector<ChartData>> of_measure;
  for (const Chart& chart : chosen_charts(page.plan, page.measures, page.outcomes, page.findings))
    of_measure[chart.y].push_back(chart_data(chart, page.plan, page.measures, page.outcomes, page.findings.variety));
  for (const MeasureFinding* finding : shown_findings(page.findings, most_measures))
    write_block(page, *finding, of_measure[page.measures[finding->measure].name], charts);
  for (const Measure& measure : page.measures)
    for (ChartData& chart : of_measure[measure.name])
      if (!chart.x.empty()) others.push_back(std::move(chart));

  // Two charts side by side.
  const size_t all = others.size() + (page.series.empty() ? 0 : 1);
  for (size_t k = 0; k < all; ++k) {
    if (k % 2 == 0) {
      begin_page(chart_rows + 1);
      sheet_.set_heights(row_, row_ + chart_rows + 1, row_height);
    }
    const ChartPlace place{row_, k % 2 * (columns / 2), double(columns) / 2 * column_pixels - 8,
                           double(chart_rows) * row_pixels};
    if (k < others.size())
      charts.draw(sheet_, others[k], place);
    else
      charts.draw_over_time(sheet_, page.series, page.scenarios, place);
    if (k % 2 == 1 || k + 1 == all) row_ += chart_rows + 1;
  }

  charts.finish();
  worksheet_gridlines(sheet_.get(), LXW_HIDE_ALL_GRIDLINES);
  sheet_.print_pages(breaks_);
  worksheet_print_area(sheet_.get(), 0, 0, to_row(max<size_t>(row_, 1) - 1), to_column(columns - 1));
}

}  // namespace carom
