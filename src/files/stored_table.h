#pragma once
// Reads CSV tables as written by this program, row by row from the start or from the end.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.h"

namespace carom {

/// The rows in order, with one piece of the file in memory.
class StoredTable {
 public:
  /// `file`: an open file. Its first row is read as the names of columns. An empty file has none.
  explicit StoredTable(Descriptor file);

  const std::vector<std::string>& columns() const { return columns_; }
  /// The index of a column, or none.
  std::optional<std::size_t> find(std::string_view column) const;

  /// The cells of the next row, valid until the next call. Null: the end. A row may have fewer cells than columns.
  const std::vector<std::string_view>* next();

 private:
  bool read_line(std::string_view& line);

  Descriptor file_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> cells_;
  std::string buffer_, unquoted_;
  std::size_t begin_ = 0;
  bool ended_ = false;
};

/// Calls `take` for the lines of a file, from the last one to the second one, until it returns false.
/// Works for tables without quotes, such as the trajectory. Only the end of a file of gigabytes is read.
void lines_from_end(int file, const std::function<bool(std::string_view line)>& take);

/// Splits a line into cells. `unquoted` holds the text of quoted cells and must outlive the cells.
void split_cells(std::string_view line, std::vector<std::string_view>& cells, std::string& unquoted);

/// The number in a cell, if the whole cell is one.
std::optional<double> number_in(std::string_view cell);

}  // namespace carom
