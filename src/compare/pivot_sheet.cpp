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

/// Over the points with both values. A point counts as often as it has runs.
struct Mean {
  double sum = 0;
  size_t count = 0;
};

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

void add_scale(Worksheet& sheet, size_t row, size_t rows, size_t columns) {
  lxw_conditional_format scale{};
  scale.type = LXW_CONDITIONAL_2_COLOR_SCALE;
  scale.min_color = 0xFFFFFF;
  scale.max_color = 0x8FBFE0;
  worksheet_conditional_format_range(sheet.get(), to_row(row), 1, to_row(row + rows - 1), to_column(columns), &scale);
}

}  // namespace

optional<pair<size_t, size_t>> pivot_parameters(const ComparisonPlan& plan, const Outcomes& outcomes) {
  const auto varies = [&](optional<size_t> p) {
    return p && p != plan.seed && outcomes.varied()[*p].values.size() > 1;
  };
  for (const Chart& chart : plan.charts) {
    const auto x = find_parameter(plan, chart.x), by = find_parameter(plan, chart.by);
    if (varies(x) && varies(by) && x != by) return pair(*x, *by);
  }
  const vector<size_t> independent = outcomes.independent();
  if (independent.size() < 2) return nullopt;
  return pair(independent[0], independent[1]);
}

void write_pivot(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                 const Outcomes& outcomes, pair<size_t, size_t> parameters, const SummaryPlace& summary) {
  const Varied &down = outcomes.varied()[parameters.first], &across = outcomes.varied()[parameters.second];
  const size_t height = min(down.values.size(), most_labels);
  const size_t width = min(across.values.size(), most_labels);
  const size_t blocks = min(measures.size(), most_blocks);

  // A formula takes its criteria from the cells of the heads.
  const bool literal = are_literal(down.values) && are_literal(across.values);
  const bool formulas = summary.rows > 0 && literal && blocks * height * width <= most_formulas;

  const vector<string> names =
      short_names({plan.parameters[parameters.first].path, plan.parameters[parameters.second].path});
  NumberLook down_look, across_look;
  for (const Cell& value : down.values) down_look.add(value.number);
  for (const Cell& value : across.values) across_look.add(value.number);

  sheet.text(0, 0, "Means of the runs by two parameters", CellStyle::title);
  sheet.note(
      1, max<size_t>(width + 1, 2),
      fmt::format("down: {}; across: {}{}{}{}", label_of(plan.parameters[parameters.first]),
                  label_of(plan.parameters[parameters.second]), formulas ? "; formulas over the sheet Summary" : "",
                  height < down.values.size() || width < across.values.size()
                      ? fmt::format("; only the first {} values of each", most_labels)
                      : "",
                  blocks < measures.size() ? fmt::format("; only the first {} measures", most_blocks) : ""),
      10 * double(max<size_t>(width + 1, 2)));

  // A block for each measure: its means, then their table.
  size_t row = 3;
  for (size_t block = 0; block < blocks; ++block) {
    vector<Mean> means(height * width);  // by row, then column
    for (size_t i = 0; i < outcomes.points(); ++i) {
      if (down.of_point[i] >= height || across.of_point[i] >= width) continue;
      const Spread spread = outcomes.spread(i, block);
      if (spread.count() == 0) continue;
      Mean& mean = means[down.of_point[i] * width + across.of_point[i]];
      mean.sum += spread.mean() * double(spread.count());
      mean.count += spread.count();
    }

    NumberLook look;
    for (const Mean& mean : means)
      if (mean.count > 0) look.add(mean.sum / double(mean.count));

    sheet.text(row++, 0, label_of(measures[block].name), CellStyle::title);
    const size_t head = row++;
    sheet.text(head, 0, fmt::format("{} \\ {}", names[0], names[1]), CellStyle::header);
    for (size_t k = 0; k < width; ++k)
      sheet.cell(head, 1 + k, across.values[k], CellStyle::varied_header, &across_look);

    for (size_t i = 0; i < height; ++i, ++row) {
      sheet.cell(row, 0, down.values[i], CellStyle::varied, &down_look);
      for (size_t k = 0; k < width; ++k) {
        const Mean& mean = means[i * width + k];
        if (mean.count == 0) continue;
        const double value = mean.sum / double(mean.count);

        if (!formulas) {
          sheet.number(row, 1 + k, value, CellStyle::plain, &look);
          continue;
        }

        sheet.formula(
            row, 1 + k,
            fmt::format("=AVERAGEIFS({},{},{},{},{})", range_of(summary.measures[block], summary),
                        range_of(summary.parameters[parameters.first], summary), cell_name(row, 0, false),
                        range_of(summary.parameters[parameters.second], summary), cell_name(head, 1 + k, true)),
            value, CellStyle::plain, &look);
      }
    }

    if (height > 0 && width > 0) add_scale(sheet, row - height, height, width);
    ++row;
  }

  sheet.fit_all(8, 50);
  sheet.freeze(0, 1);
  sheet.print_wide();
}

}  // namespace carom
