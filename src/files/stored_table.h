#pragma once
// CSV tables that stand in a folder already, as this tool writes them: row by row from the start, or from the end.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.h"

namespace carom {

/// Rows in order, with one piece of the file in memory.
class StoredTable {
 public:
  /// Of an open file; the first row is read as the columns' names. An empty file has none.
  explicit StoredTable(Descriptor file);

  const std::vector<std::string>& columns() const { return columns_; }
  /// The number of a column; none if there is no such.
  std::optional<std::size_t> find(std::string_view column) const;

  /// The cells of the next row, valid until the next call; null at the end. A row may have fewer cells than columns.
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

/// Calls `look` for the lines of a file from the last on, the first line excepted, until it gives false. For tables
/// without quotes, such as the trajectory's: of gigabytes only the end is read.
void lines_from_end(int file, const std::function<bool(std::string_view line)>& look);

/// Splits a line into cells. `unquoted` holds the text of those in quotes, and must outlive the cells.
void split_cells(std::string_view line, std::vector<std::string_view>& cells, std::string& unquoted);

/// The number that a cell is: all of its text; none else.
std::optional<double> number_in(std::string_view cell);

}  // namespace carom
