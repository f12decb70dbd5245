#pragma once
// A spreadsheet while it is written, by libxlsxwriter: the same cells give the same bytes, and sheets that are streamed
// take no memory for their rows.
#include <xlsxwriter.h>

#include <cstdint>
#include <limits>
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "compare/workbook_files.h"
#include "files/output_file.h"

namespace carom {

/// A value as a table has it.
struct Cell {
  std::string text;
  double number = std::numeric_limits<double>::quiet_NaN();  // finite: the text is this number
  bool is_number() const { return number == number; }
};

/// A number where the text is one that a double holds, else text.
Cell cell_of(std::string_view text);
/// Text without the apostrophe that makes it harmless in CSV: no cell of a workbook is run that is written as text.
std::string without_guard(std::string_view text);

/// How a cell looks.
enum class CellStyle {
  plain,
  whole,     // digits in groups
  rounding,  // powers of ten
  swept,     // tinted: what was varied
  header,
  swept_header,
  title,
  note,
  wrapped,
  doubtful,  // of a row whose figures may be wrong,
  failed,    // or of which there are none
  count_     // how many there are
};

/// What a sheet can hold.
inline constexpr std::size_t most_rows = 1'048'576, most_columns = 16'384;

class Worksheet {
 public:
  Worksheet(lxw_worksheet* sheet, const std::vector<lxw_format*>& formats) : sheet_(sheet), formats_(formats) {}

  /// Rows count from 0. Of a streamed sheet they come in order. Text is never a formula; what is longer than a cell
  /// takes is cut. A number that is not finite is an empty cell.
  void text(std::size_t row, std::size_t column, std::string_view text, CellStyle look = CellStyle::plain);
  void number(std::size_t row, std::size_t column, double value, CellStyle look = CellStyle::plain);
  void cell(std::size_t row, std::size_t column, const Cell& cell, CellStyle look = CellStyle::plain);
  /// `value`: what the formula gives now.
  void formula(std::size_t row, std::size_t column, const std::string& formula, double value,
               CellStyle look = CellStyle::plain);

  /// A column is as wide as its cells need, from `least` characters to `most`. Titles and notes do not count.
  void fit(std::size_t column, double least = 9, double most = 60, double more = 0);
  void fit_all(double least = 9, double most = 60, double more = 0);
  void freeze(std::size_t rows, std::size_t columns);
  /// One page wide on paper, across.
  void print_wide();
  /// As many pages as it takes, each with the first row and column.
  void print_table();

  lxw_worksheet* get() const { return sheet_; }
  lxw_format* format(CellStyle look) const { return formats_[static_cast<std::size_t>(look)]; }

 private:
  void widen(std::size_t column, std::size_t characters, CellStyle look);

  lxw_worksheet* sheet_;
  const std::vector<lxw_format*>& formats_;
  std::vector<std::size_t> widths_;  // characters, by column
};

class Workbook {
 public:
  /// Its parts are kept in files without a name, in `place`'s file system. Throws ExportError.
  Workbook(const FilePlace& place, std::string name, const std::string& title);
  ~Workbook();
  Workbook(const Workbook&) = delete;
  Workbook& operator=(const Workbook&) = delete;

  /// `name`: at most 31 characters, none of []:*?/\ . The first sheet opens first.
  Worksheet& add(const char* name, bool streamed = false);
  lxw_chart* add_chart(lxw_chart_type type);

  /// Puts it all together, once: the whole workbook, into `file`, held against what was written to it. Throws
  /// ExportError.
  void write(OutputFile& file);

 private:
  FilePlace place_;
  std::string name_;
  WorkbookFiles files_;
  Descriptor scratch_;  // where libxlsxwriter puts it together
  lxw_workbook* book_ = nullptr;
  std::vector<lxw_format*> formats_;  // by CellStyle
  std::list<Worksheet> sheets_;
};

}  // namespace carom
