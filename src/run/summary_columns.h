#pragma once
// The columns of summary.csv as data: name, meaning and number of each.

#include "files/summary.h"
#include "std.h"

namespace carom {

struct SummaryColumn {
  string_view name;     // as in summary.csv
  string_view meaning;  // a phrase
  /// The value, in the unit at the end of the name. Null: the column is text.
  double (*number)(const Summary&) = {};
};

/// In the order of the columns in the file.
span<const SummaryColumn> summary_columns();

/// The column of this name; null: none.
const SummaryColumn* find_summary_column(string_view name);

}  // namespace carom
