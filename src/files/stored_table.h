#pragma once
// Reads CSV tables as written by this program, row by row from the start or from the end. The first row tells the
// separator. Numbers are given with a decimal point, whatever mark they have in the file.

#include "files/output_file.h"
#include "std.h"

namespace carom {

/// The rows in order, with one piece of the file in memory.
class StoredTable {
 public:
  /// `file`: an open file. Its first row is read as the names of columns. An empty file has none.
  explicit StoredTable(Descriptor file);

  /// The open file, read up to somewhere.
  int file() const { return file_.get(); }
  char separator() const { return separator_; }
  const vector<string>& columns() const { return columns_; }
  /// The index of a column, or none.
  optional<size_t> find(string_view column) const;

  /// The cells of the next row, valid until the next call. Null: the end. A row may have fewer cells than columns.
  const vector<string_view>* next();
  /// A cell of that row. Empty: the row, or the table, has no such column.
  string_view cell(optional<size_t> column) const {
    return column && *column < cells_.size() ? cells_[*column] : string_view();
  }

 private:
  bool read_line(string_view& line);

  Descriptor file_;
  char separator_ = ',';
  vector<string> columns_;
  vector<string_view> cells_;
  string buffer_, changed_;
  size_t begin_ = 0;
  bool ended_ = false;
};

/// Calls `take` for the lines of a file, from the last one to the second one, until it returns false.
/// Works for tables without quotes, such as the trajectory. Only the end of a file of gigabytes is read.
void lines_from_end(int file, const function<bool(string_view line)>& take);

/// The separator of a table with this first line: what follows the name of its first column.
char separator_of(string_view head);

/// Splits a line into cells. `changed` holds the text of cells that had quotes or a decimal comma, and must outlive the
/// cells. Only where the separator is no comma, a comma without quotes is a decimal mark.
void split_cells(string_view line, char separator, vector<string_view>& cells, string& changed);

/// The number in a cell, if the whole cell is one.
optional<double> number_in(string_view cell);

}  // namespace carom
