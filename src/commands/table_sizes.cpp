// The limits are those of sheets. What is larger is cut, or refused, by the programs that open it, often without a
// word.
#include "commands/table_sizes.h"

#include <fmt/format.h>

#include "commands/text.h"
#include "export/tables_book.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {
namespace {

/// What makes the table smaller, by its keys.
string remedy_of(const TableSize& size, const Output& output) {
  vector<string> keys;
  const bool motions = size.name == "trajectory";
  const bool is_wide = size.columns > most_columns;
  if (is_wide) keys.emplace_back("`layout: long`");
  if (motions || size.name == "energy" || size.name == "contacts")
    if (!is_wide || size.rows >= most_rows) keys.push_back(fmt::format("a longer `{}.every`", size.name));
  if (motions && (is_wide || !output.trajectory->wide)) keys.emplace_back("fewer bodies by `trajectory.on`");
  if (output.tables.format != TablesOutput::Format::gzip)
    keys.emplace_back("`tables: csv.gz`, for pandas and the like");
  return listed(vector<string_view>(keys.begin(), keys.end()));
}

}  // namespace

const TableSize* find_size(span<const TableSize> tables, string_view name) {
  const auto found = ranges::find(tables, name, &TableSize::name);
  return found == tables.end() ? nullptr : &*found;
}

string trajectory_rows_text(span<const TableSize> tables) {
  const TableSize* const size = find_size(tables, "trajectory");
  if (size == nullptr) return "0 trajectory rows";
  return fmt::format("{}{}", size->is_bound ? "at most " : "",
                     counted(size->rows, "trajectory row", "trajectory rows"));
}

vector<string> large_tables(span<const TableSize> tables, const Output& output, bool ahead) {
  vector<string> sentences;
  for (const TableSize& size : tables) {
    const string beyond = beyond_sheets(size);
    if (beyond.empty()) continue;

    const string limits = size.rows < most_rows ? grouped(most_columns)
                          : size.columns > most_columns
                              ? fmt::format("{} and {}", grouped(most_rows), grouped(most_columns))
                              : grouped(most_rows);
    string text = fmt::format("{} {} {}{}, and a spreadsheet shows {}", table_file(output.tables, size.name + ".csv"),
                              ahead ? "will have" : "has", size.is_bound ? "up to " : "", beyond, limits);

    if (output.tables.format == TablesOutput::Format::xlsx)
      text += fmt::format(", so that {} {} only the first ones", tables_workbook, ahead ? "will have" : "has");
    if (const string remedy = remedy_of(size, output); !remedy.empty()) text += "; smaller by " + remedy;
    sentences.push_back(std::move(text));
  }
  return sentences;
}

nlohmann::ordered_json sizes_json(span<const TableSize> tables) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const TableSize& size : tables) {
    json[size.name] = {{"rows", size.rows}, {"columns", size.columns}};
    if (size.is_bound) json[size.name]["at_most"] = true;
  }
  return json;
}

}  // namespace carom
