// The runs' values are on the sheet Summary. Of runs whose scenes have little in common, they are here instead, a row
// for each value: such scenes differ in more values than a table has room for columns.
#include "compare/parameter_sheet.h"

#include <fmt/format.h>

#include "scene/path_field.h"
#include "std.h"

namespace carom {
namespace {

void write_head(Worksheet& sheet, size_t row, const vector<string>& names) {
  for (size_t k = 0; k < names.size(); ++k) sheet.text(row, k, names[k], CellStyle::header);
}

}  // namespace

ParameterSheet::ParameterSheet(Worksheet& sheet, const ComparisonPlan& plan, bool unrelated)
    : sheet_(sheet), plan_(plan), unrelated_(unrelated) {
  for (size_t p = 0; unrelated && p < plan.parameters.size(); ++p) differences_.rows.push_back({p, {}});
}

void ParameterSheet::add(const ComparedRun& run) {
  if (!unrelated_ || ++differences_.all_runs > DifferenceList::runs_shown) return;
  differences_.runs.push_back(run.id);
  for (Difference& row : differences_.rows) row.values.push_back(run.values[row.parameter]);
}

size_t ParameterSheet::write_ranges(const Outcomes& outcomes, size_t row) {
  sheet_.text(row++, 0, "What varies", CellStyle::title);
  write_head(sheet_, row++, {"parameter", "unit", "values", "from", "to"});

  for (const Varied& varied : outcomes.varied()) {
    const Parameter& parameter = plan_.parameters[varied.parameter];
    sheet_.text(row, 0, parameter.path, CellStyle::varied);
    sheet_.text(row, 1, parameter.unit);

    if (varied.values.empty()) {
      sheet_.text(row++, 3, "distinguishes repeats", CellStyle::note);
      continue;
    }

    sheet_.number(row, 2, double(varied.values.size()), CellStyle::whole);
    sheet_.cell(row, 3, varied.values.front());
    sheet_.cell(row++, 4, varied.values.back());
  }
  return row;
}

size_t ParameterSheet::write_differences(size_t row) {
  // Values of the motion that all scenes have, then those that some lack, then cameras and colours.
  const auto rank = [&](const Difference& difference) {
    const bool lacks = any_of(difference.values, [](auto& v) { return v.empty(); });
    return (is_drawn(plan_.parameters[difference.parameter].path) ? 2 : 0) + (lacks ? 1 : 0);
  };
  ranges::stable_sort(differences_.rows, [&](const Difference& a, const Difference& b) { return rank(a) < rank(b); });

  sheet_.text(row++, 0, "What differs", CellStyle::title);
  if (differences_.all_runs > differences_.runs.size())
    sheet_.text(
        row++, 0,
        fmt::format("The first {} runs; summary.csv has all {}.", differences_.runs.size(), differences_.all_runs),
        CellStyle::note);

  vector<string> heads = {"value of the scene", "unit"};
  heads.insert(heads.end(), differences_.runs.begin(), differences_.runs.end());
  write_head(sheet_, row++, heads);

  for (const Difference& difference : differences_.rows) {
    if (row >= most_rows) break;
    sheet_.text(row, 0, plan_.parameters[difference.parameter].path, CellStyle::varied);
    sheet_.text(row, 1, plan_.parameters[difference.parameter].unit);
    for (size_t k = 0; k < difference.values.size(); ++k) sheet_.cell(row, 2 + k, cell_of(difference.values[k]));
    ++row;
  }
  return row;
}

void ParameterSheet::finish(const Outcomes& outcomes, const vector<SceneValue>& common) {
  size_t row = 0;
  if (!plan_.parameters.empty()) row = (unrelated_ ? write_differences(row) : write_ranges(outcomes, row)) + 1;
  sheet_.text(row++, 0, "Values that all runs share", CellStyle::title);
  write_head(sheet_, row++, {"value of the scene", "unit", "value"});
  for (const SceneValue& value : common) {
    if (find_parameter(plan_, value.path) || row >= most_rows) continue;
    sheet_.text(row, 0, value.path);
    sheet_.text(row, 1, value.unit);
    sheet_.cell(row++, 2, cell_of(value.text));
  }

  sheet_.fit_all(9, 40, 1);
  sheet_.print_wide();
  sheet_.print_columns(max<size_t>(5, 2 + differences_.runs.size()));
}

}  // namespace carom
