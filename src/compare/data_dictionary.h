#pragma once
// Descriptions of the columns of a comparison.

#include "compare/comparison_plan.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

struct ColumnText {
  string_view name, meaning;
};

/// In the order of collisions.csv.
span<const ColumnText> collision_columns();

/// The sheet About: how to read the workbook, and a row for each column of it: name, unit, meaning.
/// `remarks`: what is left out, and why.
void write_about(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                 const vector<string>& remarks);

}  // namespace carom
