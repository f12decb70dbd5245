// Writes cells by RFC 4180. A text that begins with =, +, -, @, a tab or a carriage return gets an apostrophe in front.
// A spreadsheet would run such a text as a formula.
#include "files/csv.h"

namespace carom {

std::string text_cell(std::string_view text) {
  std::string cell;
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos) cell += '\'';
  cell += text;
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void CsvRow::separate() {
  if (!first_) file_.write(",");
  first_ = false;
}

CsvRow& CsvRow::text(std::string_view text) {
  separate();
  file_.write(text_cell(text));
  return *this;
}

CsvRow& CsvRow::number(double value) {
  separate();
  file_.written(put_number(file_.room(number_size), value));
  return *this;
}

CsvRow& CsvRow::count(std::uint64_t value) {
  separate();
  file_.written(put_number(file_.room(number_size), value));
  return *this;
}

void CsvRow::end() {
  file_.write("\n");
  first_ = true;
}

}  // namespace carom
