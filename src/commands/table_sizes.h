#pragma once
// What is said of the sizes of tables: counts, and which of them no sheet of a spreadsheet shows.
#include <nlohmann/json.hpp>

#include "files/summary.h"
#include "std.h"

namespace carom {

struct Output;

/// The size of this output's table. Null: unknown.
const TableSize* find_size(span<const TableSize> tables, string_view name);

/// "at most 33,000 trajectory rows"; of no trajectory 0.
string trajectory_rows_text(span<const TableSize> tables);

/// A sentence with the remedy for each table that is beyond the rows or columns of a spreadsheet. `ahead`: it is not
/// yet written.
vector<string> large_tables(span<const TableSize> tables, const Output& output, bool ahead);

nlohmann::ordered_json sizes_json(span<const TableSize> tables);

}  // namespace carom
