#pragma once
// RFC 4180 cells: numbers with the shortest digits that read back to the same double,
// and text that no spreadsheet runs. The separator and the decimal mark are those of the file.
// Lines end in LF.
#include <charconv>

#include "files/output_file.h"
#include "std.h"

namespace carom {

/// The maximum number of characters in a number's cell: -1.7976931348623157e+308.
inline constexpr size_t number_size = 24;

/// Writes a number's cell and returns its end. Minus zero is written as 0, and a non-finite value as an empty cell.
inline char* put_number(char* to, double value) {
  if (!isfinite(value)) return to;
  return std::to_chars(to, to + number_size, value == 0 ? 0.0 : value).ptr;
}
inline char* put_number(char* to, uint64_t value) {
  return std::to_chars(to, to + number_size, value).ptr;
}

/// The same with the decimal mark of a dialect.
inline char* put_number(char* to, double value, CsvDialect dialect) {
  char* const end = put_number(to, value);
  if (dialect.decimal != '.') std::replace(to, end, '.', dialect.decimal);
  return end;
}

inline char* put_text(char* to, string_view text) {
  return to + text.copy(to, text.size());
}

/// The cell of a number.
inline string number_cell(double value) {
  char text[number_size];
  return {text, put_number(text, value)};
}

/// Any text as a cell, in quotes where needed: also where it has a comma that could be a decimal mark.
/// A text that a spreadsheet would take for a formula gets an apostrophe in front.
string text_cell(string_view text, CsvDialect dialect = {});

/// One row at a time, cell by cell, in the dialect of the file, for tables with few rows. The trajectory writes into
/// its file's buffer directly.
class CsvRow {
 public:
  explicit CsvRow(OutputFile& file) : file_(file) {}
  CsvRow& text(string_view text);
  CsvRow& number(double value);
  CsvRow& count(uint64_t value);
  void end();

 private:
  void separate();

  OutputFile& file_;
  bool first_ = true;
};

}  // namespace carom
