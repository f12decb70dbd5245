#pragma once
// Descriptions of the columns of a comparison.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/comparison.h"
#include "compare/workbook.h"

namespace carom {

struct ColumnText {
  std::string_view name, meaning;
};

/// In the order of collisions.csv.
std::span<const ColumnText> collision_columns();

/// The sheet About: how to read the workbook, and a row for each column of it: name, unit, meaning.
/// `remarks`: what is left out, and why.
void write_about(Worksheet& sheet, const ComparisonPlan& plan, const std::vector<Measure>& measures,
                 const std::vector<std::string>& remarks);

}  // namespace carom
