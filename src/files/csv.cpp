// Writes cells by RFC 4180. A text that begins with =, +, -, @, a tab or a carriage return gets an apostrophe in front.
// A spreadsheet would run such a text as a formula.
#include "files/csv.h"

#include "std.h"

namespace carom {

string text_cell(string_view text, CsvDialect dialect) {
  string cell;
  if (!text.empty() && string_view("=+-@\t\r").find(text.front()) != string_view::npos) cell += '\'';
  cell += text;
  if (cell.find_first_of(",\"\r\n") == string::npos && cell.find(dialect.separator) == string::npos) return cell;
  string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void CsvRow::separate() {
  const char separator = file_.dialect().separator;
  if (!first_) file_.write({&separator, 1});
  first_ = false;
}

CsvRow& CsvRow::text(string_view text) {
  separate();
  file_.write(text_cell(text, file_.dialect()));
  return *this;
}

CsvRow& CsvRow::number(double value) {
  separate();
  file_.written(put_number(file_.room(number_size), value, file_.dialect()));
  return *this;
}

CsvRow& CsvRow::count(uint64_t value) {
  separate();
  file_.written(put_number(file_.room(number_size), value));
  return *this;
}

void CsvRow::end() {
  file_.write("\n");
  first_ = true;
}

}  // namespace carom
