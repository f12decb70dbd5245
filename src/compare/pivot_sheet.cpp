// Writes means as AVERAGEIFS formulas on the sheet Summary, with their present results, as long as the table is small.
// A formula needs literal criteria. With other values, or in a large table, plain numbers are written.
#include "compare/pivot_sheet.h"

#include <fmt/format.h>

#include "compare/scenarios.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

constexpr size_t most_blocks = 6, most_labels = 250, most_formulas = 2500;

string range_of(size_t column, const SummaryPlace& summary) {
  char name[LXW_MAX_COL_NAME_LENGTH];
  lxw_col_to_name(name, to_column(column), LXW_TRUE);
  return fmt::format("Summary!{0}${1}:{0}${2}", name, summary.first_row + 1, summary.first_row + summary.rows);
}

string cell_name(size_t row, size_t column, bool row_fixed) {
  char name[LXW_MAX_COL_NAME_LENGTH];
  lxw_col_to_name(name, to_column(column), row_fixed ? LXW_FALSE : LXW_TRUE);
  return fmt::format("{}{}{}", name, row_fixed ? "$" : "", row + 1);
}

/// Whether a formula's criterion takes the value literally: no wildcard, no comparison, no truth value, not too long.
bool is_literal(const Cell& cell) {
  if (cell.is_number()) return true;
  const string text = in_lower_case(cell.text);
  return !text.empty() && text.size() <= 255 && text.find_first_of("<>=*?~'") == string::npos && text != "true" &&
         text != "false";
}

/// Whether criteria tell these values apart, whatever the case of their letters.
bool are_literal(const vector<Cell>& values) {
  set<string> texts;
  return all_of(values, [&](const Cell& cell) {
    return is_literal(cell) && (cell.is_number() || texts.insert(in_lower_case(cell.text)).second);
  });
}

void add_scale(Worksheet& sheet, size_t row, size_t column, size_t rows, size_t columns) {
  if (rows == 0 || columns == 0) return;
  lxw_conditional_format scale{};
  scale.type = LXW_CONDITIONAL_2_COLOR_SCALE;
  scale.min_color = 0xFFFFFF;
  scale.max_color = 0x8FBFE0;
  worksheet_conditional_format_range(sheet.get(), to_row(row), to_column(column), to_row(row + rows - 1),
                                     to_column(column + columns - 1), &scale);
}

/// Whether formulas can take the criteria of a heat map from the cells of its heads.
bool has_formulas(const Outcomes& outcomes, const HeatMap& map, const SummaryPlace& summary) {
  return summary.rows > 0 && map.means.size() <= most_formulas && are_literal(outcomes.varied()[map.down].values) &&
         are_literal(outcomes.varied()[map.across].values);
}

}  // namespace

size_t write_heat_map(Worksheet& sheet, const ComparisonPlan& plan, const Outcomes& outcomes, const HeatMap& map,
                      size_t measure, const HeatMapPlace& place, const SummaryPlace& summary) {
  const Varied &down = outcomes.varied()[map.down], &across = outcomes.varied()[map.across];
  const size_t first_row = place.head_row + 1, first_column = place.first_column + place.columns_of_head;
  const CellStyle plain = place.is_small ? CellStyle::fitted : CellStyle::plain;

  // All numbers are looked at before the first is written.
  NumberLook down_look, across_look, look;
  for (const Cell& value : down.values) down_look.add(value.number);
  for (const Cell& value : across.values) across_look.add(value.number);
  for (const double mean : map.means) look.add(mean);

  const vector<string> names = short_names({plan.parameters[map.down].path, plan.parameters[map.across].path});
  sheet.wide(place.head_row, place.first_column, place.columns_of_head,
             Cell{fmt::format("{} \\ {}", names[0], names[1])},
             place.is_small ? CellStyle::fitted_header : CellStyle::header);
  for (size_t k = 0; k < map.columns.size(); ++k)
    sheet.wide(place.head_row, first_column + k * place.columns_of_cell, place.columns_of_cell,
               across.values[map.columns[k]], place.is_turned() ? CellStyle::turned_header : CellStyle::varied_header,
               &across_look);

  const bool formulas = has_formulas(outcomes, map, summary);
  for (size_t i = 0; i < map.rows.size(); ++i) {
    const size_t row = first_row + i;
    sheet.wide(row, place.first_column, place.columns_of_head, down.values[map.rows[i]],
               place.is_small ? CellStyle::fitted_varied : CellStyle::varied, &down_look);

    for (size_t k = 0; k < map.columns.size(); ++k) {
      const double mean = map.mean(i, k);
      const size_t column = first_column + k * place.columns_of_cell;
      sheet.wide(row, column, place.columns_of_cell, Cell{{}, mean}, plain, &look);
      if (!formulas || !isfinite(mean)) continue;

      sheet.formula(
          row, column,
          fmt::format("=AVERAGEIFS({},{},{},{},{})", range_of(summary.measures[measure], summary),
                      range_of(summary.parameters[map.down], summary), cell_name(row, place.first_column, false),
                      range_of(summary.parameters[map.across], summary), cell_name(place.head_row, column, true)),
          mean, plain, &look);
    }
  }

  add_scale(sheet, first_row, first_column, map.rows.size(), map.columns.size() * place.columns_of_cell);
  return first_row + map.rows.size();
}

void write_pivot(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                 const Outcomes& outcomes, pair<size_t, size_t> parameters, const SummaryPlace& summary) {
  const size_t blocks = min(measures.size(), most_blocks);
  vector<HeatMap> maps;
  for (size_t k = 0; k < blocks; ++k) maps.push_back(heat_map(outcomes, parameters, k, most_labels));

  // Formulas on all blocks or on none.
  SummaryPlace place = summary;
  if (maps.empty() || blocks * maps[0].means.size() > most_formulas) place.rows = 0;
  const bool formulas = !maps.empty() && has_formulas(outcomes, maps[0], place);
  const size_t width = maps.empty() ? 0 : maps[0].columns.size();
  const bool all = !maps.empty() && maps[0].rows.size() == outcomes.varied()[parameters.first].values.size() &&
                   width == outcomes.varied()[parameters.second].values.size();

  sheet.text(0, 0, "Means of the runs by two parameters", CellStyle::title);
  sheet.note(
      1, max<size_t>(width + 1, 2),
      fmt::format("down: {}; across: {}{}{}{}", label_of(plan.parameters[parameters.first]),
                  label_of(plan.parameters[parameters.second]), formulas ? "; formulas over the sheet Summary" : "",
                  all ? "" : fmt::format("; only {} values of each, evenly spaced", most_labels),
                  blocks < measures.size() ? fmt::format("; only the first {} measures", most_blocks) : ""),
      10 * double(max<size_t>(width + 1, 2)));

  // A block for each measure.
  size_t row = 3;
  vector<size_t> pages;
  for (size_t block = 0; block < blocks; ++block) {
    if (block > 0) pages.push_back(row);
    sheet.text(row, 0, label_of(measures[block].name), CellStyle::title);
    row = write_heat_map(sheet, plan, outcomes, maps[block], block, {row + 1, 0}, place) + 1;
  }

  sheet.fit_all(8, 50);
  sheet.freeze(0, 1);
  if (!maps.empty() && maps[0].rows.size() > 15)
    sheet.print_pages(pages);
  else
    sheet.print_wide();
}

}  // namespace carom
