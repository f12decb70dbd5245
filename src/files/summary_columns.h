#pragma once
// The columns of summary.csv as data: name, meaning and value of each.
#include <variant>

#include "files/summary.h"
#include "std.h"

namespace carom {

struct SummaryColumn {
  string_view name;     // as in summary.csv
  string_view meaning;  // a phrase
  /// In the unit at the end of the name.
  std::variant<string_view, uint64_t, double> (*value)(const Summary&);

  bool is_text() const { return value({}).index() == 0; }
  /// The value of a column that is no text.
  double number(const Summary& summary) const;
};

/// The end of a column's name that says its unit: "_m_per_s", "m/s".
struct UnitSuffix {
  string_view suffix, unit;
};
/// Null: the column has none.
const UnitSuffix* unit_suffix(string_view column);

/// In the order of the columns in the file.
span<const SummaryColumn> summary_columns();

/// The column of this name; null: none.
const SummaryColumn* find_summary_column(string_view name);

}  // namespace carom
