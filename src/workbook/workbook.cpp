// Writes cells with libxlsxwriter and checks every error.
// The date of creation is fixed, and the archive is compared with the parts written to it before it is copied.
#include "workbook/workbook.h"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <new>
#include <numeric>

#include "files/manifest.h"
#include "files/run_folder.h"
#include "files/stored_table.h"
#include "std.h"
#include "version.h"
#include "yaml/letters.h"

namespace carom {
namespace {

constexpr size_t longest_text = 32'767;  // characters of a cell
constexpr size_t longest_foot = 80;      // characters of the title on printed pages
/// The number of digits that a spreadsheet shows by default.
constexpr size_t general_width = 11;
constexpr double line_height = 15;         // points
constexpr double characters_across = 190;  // of a printed page, at about two thirds of the size on the screen
constexpr lxw_color_t tint = 0xFFF2CC, header_tint = 0xD9E1F2, varied_header_tint = 0xF4B183, grey = 0x595959;
constexpr lxw_color_t doubtful_tint = 0xFFE699, failed_tint = 0xF8CBAD;

/// The library returns null when it is out of memory.
template <typename Made>
Made* made(Made* thing) {
  if (thing == nullptr) throw std::bad_alloc();
  return thing;
}

/// What a style has beyond the plain one.
struct StyleRow {
  CellStyle style;
  lxw_color_t fill = 0;  // 0: none
  bool bold = false, wraps = false, shrinks = false, underlined = false, turned = false;
  int aligned = LXW_ALIGN_NONE;
  double size = 0;          // points; 0: that of the others
  lxw_color_t letters = 0;  // black
  const char* numbers = nullptr;
};

constexpr int middle = LXW_ALIGN_VERTICAL_CENTER, top = LXW_ALIGN_VERTICAL_TOP, center = LXW_ALIGN_CENTER;
constexpr StyleRow style_rows[] = {
    {CellStyle::plain},
    {CellStyle::whole, 0, false, false, false, false, false, LXW_ALIGN_NONE, 0, 0, "#,##0"},
    {CellStyle::varied, tint},
    {CellStyle::header, header_tint, true, true, false, true, false, middle},
    {CellStyle::varied_header, varied_header_tint, true, true, false, true, false, middle},
    {CellStyle::title, 0, true, false, false, false, false, LXW_ALIGN_NONE, 14},
    {CellStyle::section, 0, true},
    {CellStyle::note, 0, false, false, false, false, false, LXW_ALIGN_NONE, 0, grey},
    {CellStyle::wrapped, 0, false, true, false, false, false, top},
    {CellStyle::fitted, 0, false, false, true},
    {CellStyle::fitted_name, 0, false, false, true, false, false, center},
    {CellStyle::fitted_varied, tint, false, false, true, false, false, center},
    {CellStyle::fitted_header, header_tint, true, false, true, true, false, center},
    {CellStyle::turned_header, varied_header_tint, true, false, true, true, true, center},
    {CellStyle::total, 0, true, false, true},
    {CellStyle::doubtful, doubtful_tint},
    {CellStyle::failed, failed_tint}};

lxw_format* make_format(lxw_workbook* book, CellStyle style) {
  lxw_format* format = made(workbook_add_format(book));
  const StyleRow& row = *ranges::find(style_rows, style, &StyleRow::style);
  if (row.fill != 0) format_set_bg_color(format, row.fill);
  if (row.letters != 0) format_set_font_color(format, row.letters);
  if (row.size > 0) format_set_font_size(format, row.size);
  if (row.bold) format_set_bold(format);

  if (row.wraps) format_set_text_wrap(format);
  if (row.shrinks) format_set_shrink(format);
  if (row.underlined) format_set_bottom(format, LXW_BORDER_THIN);
  if (row.turned) format_set_rotation(format, 90);
  if (row.aligned != LXW_ALIGN_NONE) format_set_align(format, uint8_t(row.aligned));
  if (row.numbers != nullptr) format_set_num_format(format, row.numbers);
  return format;
}

/// The width of a text's longest word.
size_t longest_word(string_view text) {
  size_t most = 0;
  while (!text.empty()) {
    const size_t end = min(text.find(' '), text.size());
    most = max(most, letters_of(text.substr(0, end)));
    text.remove_prefix(min(end + 1, text.size()));
  }
  return most;
}

/// A text between tags. XML has no control characters.
string in_xml(string_view text) {
  string xml;
  for (const char c : text) {
    if (c == '&')
      xml += "&amp;";
    else if (c == '<')
      xml += "&lt;";
    else if (c == '>')
      xml += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
      xml += c;
  }
  return xml;
}

/// A failed write of a cell must not go unnoticed.
void must(lxw_error error) {
  if (error == LXW_ERROR_MEMORY_MALLOC_FAILED) throw std::bad_alloc();
  if (error != LXW_NO_ERROR)
    throw ExportError(fmt::format("cannot write a cell of a workbook: {}", lxw_strerror(error)));
}

}  // namespace

Cell cell_of(string_view text) {
  Cell cell{string(text)};
  // A double has 53 bits. Longer whole numbers, such as seeds, stay text.
  const bool whole = text.find_first_not_of("-0123456789") == string_view::npos;
  constexpr size_t exact = 16;  // digits and sign
  if (const auto number = number_in(text); number && !(whole && text.size() > exact)) cell.number = *number;
  return cell;
}

string without_guard(string_view text) {
  const bool guarded = text.size() > 1 && text[0] == '\'' && string_view("=+-@\t\r").find(text[1]) != text.npos;
  return string(text.substr(guarded ? 1 : 0));
}

lxw_format* CellFormats::get(CellStyle style, const string& numbers) {
  lxw_format*& format = made_[{style, numbers}];
  if (format != nullptr) return format;
  format = make_format(book_, style);
  if (!numbers.empty()) format_set_num_format(format, numbers.c_str());
  return format;
}

lxw_format* Worksheet::format(CellStyle style, const NumberLook* look) const {
  return formats_.get(style, look == nullptr ? "" : look->format());
}

void Worksheet::widen(size_t column, size_t characters, CellStyle style) {
  if (style == CellStyle::title || style == CellStyle::section || style == CellStyle::note) return;
  if (widths_.size() <= column) widths_.resize(column + 1);
  widths_[column] = max(widths_[column], characters);
}

void Worksheet::text(size_t row, size_t column, string_view text, CellStyle style) {
  if (text.empty() && style == CellStyle::plain) return;
  const string shown = shortened(text, longest_text);
  widen(column, letters_of(shown), style);
  must(worksheet_write_string(sheet_, to_row(row), to_column(column), shown.c_str(),
                              style == CellStyle::plain ? nullptr : format(style)));
}

void Worksheet::number(size_t row, size_t column, double value, CellStyle style, const NumberLook* look) {
  lxw_format* const how = style == CellStyle::plain && look == nullptr ? nullptr : format(style, look);
  if (!isfinite(value)) {
    if (how != nullptr) must(worksheet_write_blank(sheet_, to_row(row), to_column(column), how));
    return;
  }
  widen(column, look == nullptr ? general_width : look->width(), style);
  must(worksheet_write_number(sheet_, to_row(row), to_column(column), value == 0 ? 0.0 : value, how));
}

void Worksheet::cell(size_t row, size_t column, const Cell& cell, CellStyle style, const NumberLook* look) {
  if (cell.is_number())
    number(row, column, cell.number, style, look);
  else
    text(row, column, without_guard(cell.text), style);
}

void Worksheet::wide(size_t row, size_t column, size_t columns, const Cell& value, CellStyle style,
                     const NumberLook* look) {
  // Merged cells take their content afterwards, as one cell.
  if (columns > 1)
    must(worksheet_merge_range(sheet_, to_row(row), to_column(column), to_row(row), to_column(column + columns - 1), "",
                               format(style, look)));
  cell(row, column, value, style, look);
}

void Worksheet::formula(size_t row, size_t column, const string& formula, double value, CellStyle style,
                        const NumberLook* look) {
  widen(column, look == nullptr ? general_width : look->width(), style);
  must(worksheet_write_formula_num(sheet_, to_row(row), to_column(column), formula.c_str(),
                                   style == CellStyle::plain && look == nullptr ? nullptr : format(style, look),
                                   value));
}

void Worksheet::head(size_t row, size_t column, string_view text, CellStyle style) {
  if (words_.size() <= column) words_.resize(column + 1);
  words_[column] = max(words_[column], longest_word(text));
  const string shown = shortened(text, longest_text);
  must(worksheet_write_string(sheet_, to_row(row), to_column(column), shown.c_str(), format(style)));
}

vector<ExactColumn> Worksheet::exact_columns(const vector<NumberLook>& looks) const {
  vector<ExactColumn> columns;
  for (const NumberLook& look : looks) {
    char letters[LXW_MAX_COL_NAME_LENGTH];
    lxw_col_to_name(letters, to_column(columns.size()), 0);
    columns.push_back({letters, lxw_format_get_xf_index(format(CellStyle::plain, &look)), look.width()});
  }
  return columns;
}

// The library has a stream for the rows of a streamed sheet, and the last one in memory. A row that is written to that
// stream, after the last one, is a row of the sheet as the library's own are.
void Worksheet::exact_row(size_t row, const vector<string_view>& cells, const vector<ExactColumn>& columns) {
  lxw_worksheet_write_single_row(sheet_);
  string xml = fmt::format("<row r=\"{}\">", row + 1);
  const auto out = std::back_inserter(xml);
  const size_t count = min(cells.size(), columns.size());

  for (size_t k = 0; k < count; ++k) {
    const ExactColumn& column = columns[k];
    if (cells[k].empty()) continue;
    if (number_in(cells[k])) {
      widen(k, column.width, CellStyle::plain);
      fmt::format_to(out, FMT_COMPILE("<c r=\"{}{}\" s=\"{}\"><v>{}</v></c>"), column.letters, row + 1, column.style,
                     cells[k]);
    } else {
      const string text = shortened(without_guard(cells[k]), longest_text);
      widen(k, letters_of(text), CellStyle::plain);
      fmt::format_to(out, FMT_COMPILE("<c r=\"{}{}\" t=\"inlineStr\"><is><t xml:space=\"preserve\">{}</t></is></c>"),
                     column.letters, row + 1, in_xml(text));
    }
  }

  xml += "</row>";
  // The stream keeps its errors (workbook_files.h).
  std::fwrite(xml.data(), 1, xml.size(), sheet_->file);
  sheet_->dim_rowmin = min(sheet_->dim_rowmin, to_row(row));
  sheet_->dim_rowmax = max(sheet_->dim_rowmax, to_row(row));
  sheet_->dim_colmin = 0;
  sheet_->dim_colmax = max(sheet_->dim_colmax, to_column(max<size_t>(count, 1) - 1));
}

void Worksheet::set_head_row(size_t row, size_t lines) {
  worksheet_set_row(sheet_, to_row(row), (double(lines) + 0.25) * line_height, nullptr);
}

void Worksheet::set_heights(size_t first, size_t end, double height) {
  for (size_t row = first; row < end; ++row) worksheet_set_row(sheet_, to_row(row), height, nullptr);
}

void Worksheet::note(size_t row, size_t columns, string_view text, double width) {
  const string shown = shortened(text, longest_text);
  const double lines = ceil(1.1 * double(letters_of(shown)) / max(width, 1.0));
  worksheet_set_row(sheet_, to_row(row), clamp(lines, 1.0, 25.0) * line_height, nullptr);
  if (columns < 2)
    must(worksheet_write_string(sheet_, to_row(row), 0, shown.c_str(), format(CellStyle::wrapped)));
  else
    must(worksheet_merge_range(sheet_, to_row(row), 0, to_row(row), to_column(columns - 1), shown.c_str(),
                               format(CellStyle::wrapped)));
}

void Worksheet::fit(size_t column, double least, double most, double more) {
  const double needed = column < widths_.size() ? double(widths_[column]) + 1 + more : least;
  set_width(column, clamp(needed, least, most));
}

void Worksheet::set_width(size_t column, double width) {
  worksheet_set_column(sheet_, to_column(column), to_column(column), width, nullptr);
  if (fitted_.size() <= column) fitted_.resize(column + 1);
  fitted_[column] = width;
}

/// Of the first columns together, in characters.
double Worksheet::width_of(size_t columns) const {
  return std::accumulate(fitted_.begin(), fitted_.begin() + ptrdiff_t(min(columns, fitted_.size())), 0.0);
}

void Worksheet::fit_all(double least, double most, double more) {
  for (size_t column = 0; column < widths_.size(); ++column) fit(column, least, most, more);
}

void Worksheet::fit_table(double least) {
  constexpr double most = 40, button = 3;
  const size_t columns = max(widths_.size(), words_.size());
  widths_.resize(columns);
  words_.resize(columns);
  for (size_t column = 0; column < columns; ++column) {
    const double needed = double(max(widths_[column] + 1, words_[column])) + button;
    set_width(column, clamp(needed, least, most));
  }
}

void Worksheet::freeze(size_t rows, size_t columns) {
  worksheet_freeze_panes(sheet_, to_row(rows), to_column(columns));
}

void Worksheet::set_paper() {
  worksheet_set_landscape(sheet_);
  worksheet_set_paper(sheet_, 9);           // A4
  constexpr double side = 0.5, end = 0.75;  // inches
  worksheet_set_margins(sheet_, side, side, end, end);
  // The name of the sheet, the title, the number of the page. An & has a meaning in this text.
  string title;
  for (const char c : shortened(formats_.title(), longest_foot)) title += c == '&' ? "&&" : string(1, c);
  worksheet_set_footer(sheet_, fmt::format("&L&A&C{}&RPage &P of &N", title).c_str());
}

void Worksheet::print_wide() {
  set_paper();
  const double pages = ceil(width_of(fitted_.size()) / characters_across);
  worksheet_fit_to_pages(sheet_, uint16_t(clamp(pages, 1.0, 1000.0)), 0);
}

void Worksheet::print_pages(const vector<size_t>& rows) {
  set_paper();
  worksheet_fit_to_pages(sheet_, 1, 0);
  vector<lxw_row_t> breaks(rows.begin(), rows.end());
  breaks.push_back(0);  // the end
  worksheet_set_h_pagebreaks(sheet_, breaks.data());
}

void Worksheet::print_first_page() {
  constexpr size_t rows = 45;
  size_t columns = 1;
  while (columns < fitted_.size() && width_of(columns + 1) < characters_across) ++columns;
  set_paper();
  worksheet_fit_to_pages(sheet_, 1, 1);
  worksheet_print_area(sheet_, 0, 0, to_row(rows - 1), to_column(columns - 1));
}

void Worksheet::print_table(size_t head_row) {
  print_wide();
  worksheet_repeat_rows(sheet_, to_row(head_row), to_row(head_row));
  worksheet_repeat_columns(sheet_, 0, 0);
}

void Worksheet::print_columns(size_t columns) {
  constexpr double characters_upright = 110;
  constexpr uint16_t percent = 70;
  if (width_of(columns) < characters_upright) {
    worksheet_set_portrait(sheet_);
    worksheet_set_print_scale(sheet_, percent);
  }
  worksheet_print_area(sheet_, 0, 0, sheet_->dim_rowmax, to_column(columns - 1));
}

Workbook::Workbook(const FilePlace& place, string name, const string& title)
    : place_(place), name_(std::move(name)), files_(place_, name_), scratch_(nameless_file(place_)) {
  const string file = fmt::format("/proc/self/fd/{}", scratch_.get());
  lxw_workbook_options options{};
  options.use_zip64 = LXW_FALSE;
  book_ = workbook_new_opt(file.c_str(), &options);
  if (book_ == nullptr) fail("write", place_, name_, "libxlsxwriter has no memory");

  const string subject = valid_utf8(title);
  lxw_doc_properties properties{};
  properties.title = const_cast<char*>(subject.c_str());
  properties.comments = const_cast<char*>(program_and_version);
  // 2000-01-01 and not the clock, so that the same runs give the same bytes.
  properties.created = 946'684'800;
  workbook_set_properties(book_, &properties);
  formats_ = make_unique<CellFormats>(book_, subject);
}

Workbook::~Workbook() {
  if (book_ != nullptr) lxw_workbook_free(book_);
}

Worksheet& Workbook::add(const char* name, bool streamed) {
  book_->options.constant_memory = streamed ? LXW_TRUE : LXW_FALSE;
  lxw_worksheet* sheet = workbook_add_worksheet(book_, name);
  if (sheet == nullptr) fail("write", place_, name_, fmt::format("no sheet {} can be made", name));
  if (sheets_.empty()) worksheet_activate(sheet);
  return sheets_.emplace_back(sheet, *formats_);
}

lxw_chart* Workbook::add_chart(lxw_chart_type type) {
  return made(workbook_add_chart(book_, uint8_t(type)));
}

void Workbook::write(OutputFile& file) {
  files_.begin_parts();
  errno = 0;
  const lxw_error error = workbook_close(book_);
  const int system_error = errno;

  // Closing frees it, even on failure.
  book_ = nullptr;
  files_.check();

  // The library's own text of this error does not have the system's reason.
  if (error == LXW_ERROR_ZIP_FILE_OPERATION && system_error != 0)
    fail("write", place_, name_, std::strerror(system_error));
  if (error != LXW_NO_ERROR) fail("write", place_, name_, lxw_strerror(error));
  files_.check_archive(scratch_.get());

  // Copy the archive.
  vector<char> piece(size_t{256} * 1024);
  off_t at = 0;
  for (;;) {
    const ssize_t n = pread(scratch_.get(), piece.data(), piece.size(), at);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", place_, name_);
    if (n == 0) break;
    file.write({piece.data(), size_t(n)});
    at += n;
  }
}

}  // namespace carom
