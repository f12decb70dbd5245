// Varied values stand on the left, a row for each run. Common values stand on the right, once, instead of in every row.
#include "compare/parameter_sheet.h"

#include <fmt/format.h>

#include "compare/charts.h"

namespace carom {
namespace {

constexpr std::size_t head_row = 1;

void write_head(Worksheet& sheet, std::size_t row, std::size_t column, std::initializer_list<const char*> names) {
  for (const char* name : names) sheet.text(row, column++, name, CellStyle::header);
}

}  // namespace

ParameterSheet::ParameterSheet(Worksheet& sheet, const ComparisonPlan& plan) : sheet_(sheet), plan_(plan) {
  sheet_.text(0, 0, "Varied values, run by run", CellStyle::title);
  sheet_.text(head_row, 0, "run", CellStyle::header);
  for (std::size_t p = 0; p < plan.parameters.size(); ++p)
    sheet_.text(head_row, 1 + p, label_of(plan.parameters[p]), CellStyle::swept_header);
}

void ParameterSheet::add(const ComparedRun& run) {
  ++runs_;
  const std::size_t row = head_row + runs_;
  if (runs_ == most + 1) sheet_.text(row, 0, "The sheet Summary has all of them.", CellStyle::note);
  if (runs_ > most) return;
  sheet_.text(row, 0, run.id);
  for (std::size_t p = 0; p < run.values.size(); ++p) sheet_.cell(row, 1 + p, cell_of(run.values[p]), CellStyle::swept);
}

std::size_t ParameterSheet::write_varied(const Outcomes& outcomes, std::size_t row, std::size_t first) {
  sheet_.text(row++, first, "Ranges", CellStyle::title);
  write_head(sheet_, row++, first, {"parameter", "unit", "values", "from", "to"});
  for (const Varied& varied : outcomes.varied()) {
    const Parameter& parameter = plan_.parameters[varied.parameter];
    sheet_.text(row, first, parameter.path, CellStyle::swept);
    sheet_.text(row, first + 1, parameter.unit);
    if (varied.values.empty()) {
      sheet_.text(row++, first + 3, "distinguishes repeats", CellStyle::note);
      continue;
    }
    sheet_.number(row, first + 2, static_cast<double>(varied.values.size()), CellStyle::whole);
    sheet_.cell(row, first + 3, varied.values.front());
    sheet_.cell(row++, first + 4, varied.values.back());
  }
  return row;
}

void ParameterSheet::finish(const Outcomes& outcomes, const std::vector<SceneValue>& common) {
  const std::size_t first = plan_.parameters.size() + 2;
  std::size_t row = 0;
  if (!plan_.parameters.empty()) row = write_varied(outcomes, row, first) + 1;
  sheet_.text(row++, first, "Values that all runs share", CellStyle::title);
  write_head(sheet_, row++, first, {"value of the scene", "unit", "value"});
  for (const SceneValue& value : common) {
    if (find_parameter(plan_, value.path) || row >= most_rows) continue;
    sheet_.text(row, first, value.path);
    sheet_.text(row, first + 1, value.unit);
    sheet_.cell(row++, first + 2, cell_of(value.text));
  }
  sheet_.fit_all(9, 60, 1);
  sheet_.freeze(head_row + 1, 1);
  sheet_.print_wide();
}

}  // namespace carom
