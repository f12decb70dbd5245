#pragma once
// The columns of summary.csv as data: name, meaning and number of each.
#include <span>
#include <string_view>

#include "files/summary.h"

namespace carom {

struct SummaryColumn {
  std::string_view name;     // as in summary.csv
  std::string_view meaning;  // a phrase
  /// The value, in the unit at the end of the name. Null: the column is text.
  double (*number)(const Summary&) = {};
};

/// In the order of the columns in the file.
std::span<const SummaryColumn> summary_columns();

/// The column of this name; null: none.
const SummaryColumn* find_summary_column(std::string_view name);

}  // namespace carom
