#pragma once
// The columns of summary.csv as data: what each means, and its number.
#include <span>
#include <string_view>

#include "files/summary.h"

namespace carom {

struct SummaryColumn {
  std::string_view name;                  // as in summary.csv
  std::string_view meaning;               // a phrase
  double (*number)(const Summary&) = {};  // in the unit that the name ends in; null: the column is text
};

/// In the order of the file.
std::span<const SummaryColumn> summary_columns();

/// The column of this name; null: none.
const SummaryColumn* find_summary_column(std::string_view name);

}  // namespace carom
