#pragma once
// A workbook written with libxlsxwriter. The same cells give the same bytes.
// Streamed sheets take no memory for their rows.
#include <xlsxwriter.h>

#include <list>

#include "files/output_file.h"
#include "std.h"
#include "workbook/number_look.h"
#include "workbook/workbook_files.h"

namespace carom {

/// A value in a table.
struct Cell {
  string text;
  double number = numeric_limits<double>::quiet_NaN();  // finite: the text is this number
  bool is_number() const { return number == number; }
};

/// A number if the text is one that a double represents, else text.
Cell cell_of(string_view text);
/// Removes the apostrophe that protects text in CSV. A workbook never evaluates a cell that is written as text.
string without_guard(string_view text);

/// The format of a cell.
enum class CellStyle {
  plain,
  whole,   // digits in groups
  varied,  // tinted: a varied value
  header,
  varied_header,
  title,
  section,  // the title of a part
  note,
  wrapped,
  // Shown smaller where a cell is too narrow:
  fitted,
  fitted_name,  // in the middle, as the next two
  fitted_varied,
  fitted_header,
  turned_header,  // read from below
  total,          // bold: what matters most of a row
  doubtful,       // of a row with doubtful results
  failed          // of a row without results
};

/// The limits of a sheet.
inline constexpr size_t most_rows = 1'048'576, most_columns = 16'384;

/// The library's types of rows and columns.
inline lxw_row_t to_row(size_t row) {
  return lxw_row_t(row);
}
inline lxw_col_t to_column(size_t column) {
  return lxw_col_t(column);
}

/// The formats of a workbook, each made once.
class CellFormats {
 public:
  /// `title`: of the workbook, for the foot of printed pages.
  CellFormats(lxw_workbook* book, string title) : title_(std::move(title)), book_(book) {}
  /// `numbers`: a format of numbers; empty: that of the style.
  lxw_format* get(CellStyle style, const string& numbers = {});
  const string& title() const { return title_; }

 private:
  string title_;
  lxw_workbook* book_;
  map<pair<CellStyle, string>, lxw_format*> made_;
};

/// A column of rows that keep all digits.
struct ExactColumn {
  string letters;     // "AB"
  int32_t style = 0;  // of numbers, in the library's table
  size_t width = 0;   // of numbers, in characters
};

class Worksheet {
 public:
  Worksheet(lxw_worksheet* sheet, CellFormats& formats) : sheet_(sheet), formats_(formats) {}

  /// Rows count from 0. On a streamed sheet they must come in order. Text is never a formula.
  /// Text longer than a cell is cut. A number that is not finite gives an empty cell.
  void text(size_t row, size_t column, string_view text, CellStyle style = CellStyle::plain);
  /// `look`: that of the column. Null: as the spreadsheet does.
  void number(size_t row, size_t column, double value, CellStyle style = CellStyle::plain,
              const NumberLook* look = nullptr);
  void cell(size_t row, size_t column, const Cell& cell, CellStyle style = CellStyle::plain,
            const NumberLook* look = nullptr);
  /// A cell over several columns, of a sheet that is not streamed.
  void wide(size_t row, size_t column, size_t columns, const Cell& cell, CellStyle style = CellStyle::plain,
            const NumberLook* look = nullptr);
  /// `value`: the present result of the formula.
  void formula(size_t row, size_t column, const string& formula, double value, CellStyle style = CellStyle::plain,
               const NumberLook* look = nullptr);
  /// The head of a column. Its text is broken between words.
  void head(size_t row, size_t column, string_view text, CellStyle style = CellStyle::header);
  /// Sets the height (points) of each row from `first` on, before `end`.
  void set_heights(size_t first, size_t end, double height);
  /// Writes a row of a streamed sheet from the cells of a CSV table. Numbers keep exactly these digits; the library
  /// would round them to 16, and read back they would be other doubles.
  void exact_row(size_t row, const vector<string_view>& cells, const vector<ExactColumn>& columns);
  /// The columns of such rows, by the looks of their numbers.
  vector<ExactColumn> exact_columns(const vector<NumberLook>& looks) const;
  /// Sets the height of a row of heads. To be called before its first cell.
  void set_head_row(size_t row, size_t lines = 3);
  /// A text over several columns, of together `width` characters, in as many lines as it needs.
  void note(size_t row, size_t columns, string_view text, double width);

  /// Sets a column's width to what its cells need, from `least` to `most` characters. Titles and notes do not count.
  void fit(size_t column, double least = 9, double most = 60, double more = 0);
  void fit_all(double least = 9, double most = 60, double more = 0);
  /// The same for a table with heads and filters.
  void fit_table(double least = 8);
  void freeze(size_t rows, size_t columns);
  /// Fits the width of the sheet to one page, or to as many as remain legible. To be called after fit() of its columns.
  void print_wide();
  /// Fits the width of the sheet to one page, with a page before each of these rows where the spreadsheet allows it.
  void print_pages(const vector<size_t>& rows);
  /// Prints the first page of a sheet of numbers that only charts and programs read.
  void print_first_page();
  /// The same as print_wide(), with the row of heads and the first column on each page.
  void print_table(size_t head_row);
  /// Prints these first columns alone. On upright paper, if they are narrow.
  void print_columns(size_t columns);

  lxw_worksheet* get() const { return sheet_; }
  lxw_format* format(CellStyle style, const NumberLook* look = nullptr) const;

 private:
  void widen(size_t column, size_t characters, CellStyle style);
  void set_paper();
  void set_width(size_t column, double width);
  double width_of(size_t columns) const;

  lxw_worksheet* sheet_;
  CellFormats& formats_;
  vector<size_t> widths_;  // characters, by column
  vector<size_t> words_;   // of the longest word in the head
  vector<double> fitted_;  // widths of the columns that were fitted
};

class Workbook {
 public:
  /// Temporary parts are unnamed files in the file system of `place`. Throws ExportError.
  Workbook(const FilePlace& place, string name, const string& title);
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
  string name_;
  WorkbookFiles files_;
  /// The file in which libxlsxwriter assembles it.
  Descriptor scratch_;
  lxw_workbook* book_ = nullptr;
  unique_ptr<CellFormats> formats_;
  std::list<Worksheet> sheets_;
};

}  // namespace carom
