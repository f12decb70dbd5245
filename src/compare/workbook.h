#pragma once
// A workbook written with libxlsxwriter. The same cells give the same bytes.
// Streamed sheets take no memory for their rows.
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

/// A value in a table.
struct Cell {
  std::string text;
  double number = std::numeric_limits<double>::quiet_NaN();  // finite: the text is this number
  bool is_number() const { return number == number; }
};

/// A number if the text is one that a double represents, else text.
Cell cell_of(std::string_view text);
/// Removes the apostrophe that protects text in CSV. A workbook never evaluates a cell that is written as text.
std::string without_guard(std::string_view text);

/// The format of a cell.
enum class CellStyle {
  plain,
  whole,     // digits in groups
  rounding,  // powers of ten
  swept,     // tinted: a varied value
  header,
  swept_header,
  title,
  note,
  wrapped,
  doubtful,  // of a row with doubtful results
  failed,    // of a row without results
  number_of_styles
};

/// The limits of a sheet.
inline constexpr std::size_t most_rows = 1'048'576, most_columns = 16'384;

class Worksheet {
 public:
  Worksheet(lxw_worksheet* sheet, const std::vector<lxw_format*>& formats) : sheet_(sheet), formats_(formats) {}

  /// Rows count from 0. On a streamed sheet they must come in order. Text is never a formula.
  /// Text longer than a cell is cut. A number that is not finite gives an empty cell.
  void text(std::size_t row, std::size_t column, std::string_view text, CellStyle style = CellStyle::plain);
  void number(std::size_t row, std::size_t column, double value, CellStyle style = CellStyle::plain);
  void cell(std::size_t row, std::size_t column, const Cell& cell, CellStyle style = CellStyle::plain);
  /// `value`: the present result of the formula.
  void formula(std::size_t row, std::size_t column, const std::string& formula, double value,
               CellStyle style = CellStyle::plain);

  /// Sets a column's width to what its cells need, from `least` to `most` characters. Titles and notes do not count.
  void fit(std::size_t column, double least = 9, double most = 60, double more = 0);
  void fit_all(double least = 9, double most = 60, double more = 0);
  void freeze(std::size_t rows, std::size_t columns);
  /// Fits the width of the sheet to one page.
  void print_wide();
  /// Prints on as many pages as needed, each with the first row and column.
  void print_table();

  lxw_worksheet* get() const { return sheet_; }
  lxw_format* format(CellStyle style) const { return formats_[static_cast<std::size_t>(style)]; }

 private:
  void widen(std::size_t column, std::size_t characters, CellStyle style);

  lxw_worksheet* sheet_;
  const std::vector<lxw_format*>& formats_;
  std::vector<std::size_t> widths_;  // characters, by column
};

class Workbook {
 public:
  /// Temporary parts are unnamed files in the file system of `place`. Throws ExportError.
  Workbook(const FilePlace& place, std::string name, const std::string& title);
  ~Workbook();
  Workbook(const Workbook&) = delete;
  Workbook& operator=(const Workbook&) = delete;

  /// `name`: at most 31 characters, without []:*?/\ . The first sheet is the one shown at opening.
  Worksheet& add(const char* name, bool streamed = false);
  lxw_chart* add_chart(lxw_chart_type type);

  /// Writes the whole workbook into `file`, after comparing it with what was written to it. May be called once.
  /// Throws ExportError.
  void write(OutputFile& file);

 private:
  FilePlace place_;
  std::string name_;
  WorkbookFiles files_;
  /// The file in which libxlsxwriter assembles it.
  Descriptor scratch_;
  lxw_workbook* book_ = nullptr;
  std::vector<lxw_format*> formats_;  // by CellStyle
  std::list<Worksheet> sheets_;
};

}  // namespace carom
