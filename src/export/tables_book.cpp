// Each table is read twice: how many digits its columns need, and how many rows it has, must be known before its first
// row is written. Sheets are streamed, so that memory does not grow with the rows.
#include "export/tables_book.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "files/stored_file.h"
#include "files/stored_table.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {
namespace {

/// Sheets in their order, and the tables that they show.
constexpr pair<const char*, const char*> sheets[] = {
    {"Summary", "summary.csv"},   {"Energy", "energy.csv"},   {"Collisions", "collisions.csv"},
    {"Contacts", "contacts.csv"}, {"Regions", "regions.csv"}, {"Trajectory", "trajectory.csv"}};

/// As many as one sheet of the archive can hold, at 40 bytes each.
constexpr size_t most_cells = 60'000'000;

/// All first rows count for the looks of columns, and some of the others.
constexpr size_t first_rows = 10'000, row_step = 61;

/// Rows between two checks for an interrupt.
constexpr size_t rows_between = 1000;

/// Of a table that is cut.
constexpr size_t columns_of_note = 8;
constexpr double width_of_note = 100;  // characters

string with_commas(uint64_t number) {
  string text = fmt::format("{}", number);
  for (size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

/// What a first look at a table shows.
struct TableLook {
  size_t rows = 0;  // without heads
  vector<NumberLook> columns;
};

TableLook look_at(StoredTable& table) {
  TableLook look;
  look.columns.resize(min(table.columns().size(), most_columns));
  for (; const auto* cells = table.next(); ++look.rows) {
    if (look.rows % rows_between == 0) check_packing();
    if (look.rows >= first_rows && look.rows % row_step != 0) continue;
    for (size_t k = 0; k < min(cells->size(), look.columns.size()); ++k)
      if (const auto number = number_in((*cells)[k])) look.columns[k].add(*number);
  }
  return look;
}

void write_sheet(Worksheet& sheet, const char* name, Descriptor file) {
  StoredTable first(Descriptor(fcntl(file.get(), F_DUPFD_CLOEXEC, 0)));
  const TableLook look = look_at(first);
  if (lseek(file.get(), 0, SEEK_SET) != 0) fail("read", place_of(file.get()), name);
  StoredTable table(std::move(file));

  // What fits.
  const vector<string>& heads = table.columns();
  const size_t columns = look.columns.size();
  const size_t fit = min(most_rows - 2, most_cells / max<size_t>(columns, 1));
  const bool is_cut = look.rows > min(most_rows - 1, most_cells / max<size_t>(columns, 1)) || columns < heads.size();
  const size_t rows = is_cut ? min(look.rows, fit) : look.rows, head_row = is_cut ? 1 : 0;
  if (is_cut)
    sheet.note(0, min(columns, columns_of_note),
               fmt::format("The first {} of {} rows and {} of {} columns; {} has all.", with_commas(rows),
                           with_commas(look.rows), with_commas(columns), with_commas(heads.size()), name),
               width_of_note);

  sheet.set_head_row(head_row, 1);
  for (size_t k = 0; k < columns; ++k) sheet.head(head_row, k, heads[k]);
  const vector<ExactColumn> exact = sheet.exact_columns(look.columns);
  for (size_t row = 1; row <= rows; ++row) {
    if (row % rows_between == 0) check_packing();
    if (const auto* cells = table.next()) sheet.exact_row(head_row + row, *cells, exact);
  }

  sheet.fit_table();
  sheet.freeze(head_row + 1, 1);
  if (rows > 1) worksheet_autofilter(sheet.get(), to_row(head_row), 0, to_row(head_row + rows), to_column(columns - 1));
  sheet.print_table(head_row);
}

}  // namespace

string beyond_sheets(const TableSize& size) {
  string text;
  // The heads are a row too.
  if (size.rows >= most_rows) text = with_commas(size.rows) + " rows";
  if (size.columns > most_columns)
    text += fmt::format("{}{} columns", text.empty() ? "" : " and ", with_commas(size.columns));
  return text;
}

unique_ptr<OutputFile> write_tables_workbook(const FilePlace& place, const TablesOutput& tables, const string& title,
                                             const function<Descriptor(const string& name)>& open) {
  if (tables.format != TablesOutput::Format::xlsx) return nullptr;
  Workbook book(place, tables_workbook, title);
  for (const auto& [sheet, name] : sheets)
    if (Descriptor file = open(name)) write_sheet(book.add(sheet, true), name, std::move(file));

  auto file = make_unique<OutputFile>(place, tables_workbook);
  book.write(*file);
  file->complete();
  return file;
}

}  // namespace carom
