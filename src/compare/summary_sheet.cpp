// Writes summary.csv run by run, and then the sheet Summary from it. Only then is it known which columns are the same
// for all runs, and how many digits a column needs. A table needs its rows in memory, so more runs than most_in_table
// are streamed with filters instead.
#include "compare/summary_sheet.h"

#include <fmt/format.h>

#include "files/csv.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "files/summary_columns.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

/// The maximum length of a table's column names.
constexpr size_t longest_name = 255;

CellStyle head_of(CellStyle style) {
  return style == CellStyle::varied ? CellStyle::varied_header : CellStyle::header;
}

}  // namespace

vector<SummarySheet::Column> SummarySheet::make_columns(const ComparisonPlan& plan, const vector<Measure>& measures) {
  vector<Column> columns;
  for (size_t k = 0; k < summary_columns().size(); ++k) {
    const SummaryColumn& summary = summary_columns()[k];
    columns.push_back({string(summary.name), label_of(summary.name), CellStyle::plain, summary.is_text(), k, {}, {}});
  }

  for (size_t k = 0; k < plan.parameters.size(); ++k)
    columns.push_back({plan.parameters[k].path, label_of(plan.parameters[k]), CellStyle::varied, false, {}, k, {}});
  for (size_t k = 0; k < measures.size(); ++k)
    if (measures[k].column == nullptr)
      columns.push_back({measures[k].name, label_of(measures[k].name), CellStyle::plain, false, {}, {}, k});

  if (columns.size() > most_columns)
    throw ExportError(
        fmt::format("a comparison of {} columns exceeds the {} of a spreadsheet: compare fewer parameters",
                    columns.size(), most_columns));
  return columns;
}

SummarySheet::SummarySheet(const FilePlace& place, Workbook& book, const ComparisonPlan& plan,
                           const vector<Measure>& measures, size_t count, bool unrelated)
    : count_(count),
      parameters_(plan.parameters.size()),
      unrelated_(unrelated),
      place_(place),
      measures_(measures),
      columns_(make_columns(plan, measures)),
      sheet_(book.add("Summary", !is_table(count))),
      table_(make_unique<OutputFile>(place, summary_name, plan.dialect)) {}

void SummarySheet::write_heads() {
  CsvRow row(*table_);
  for (const Column& column : columns_) row.text(column.name);
  row.end();
}

void SummarySheet::add(size_t number, const RunRecord& run) {
  CsvRow row(*table_);
  for (Column& column : columns_) {
    Cell cell;

    // Measures have all their digits. Other cells are the run's own texts.
    if (column.measure && !run.texts[*column.measure].empty()) {
      cell.text = run.texts[*column.measure];
      row.text(cell.text);
    } else if (column.measure) {
      cell.number = run.measures[*column.measure];
      row.number(cell.number);
      cell.text = number_cell(cell.number);
    } else {
      cell.text = column.parameter ? run.run.values[*column.parameter] : run.summary[*column.summary];
      if (column.name == "run") cell.text = run.run.id;
      if (column.name == "status" && !run.done) cell.text = "failed";
      if (!column.is_text) cell = cell_of(cell.text);
      cell.is_number() ? row.number(cell.number) : row.text(cell.text);
    }

    // What the sheet needs to know of the column.
    column.look.add(cell.number);
    if (number == 0) column.first = cell.text;
    column.is_constant = column.is_constant && column.first == cell.text;
  }

  row.end();
}

/// Parameters, measures, and then, not printed, the others that differ. Of unrelated runs, parameters that some of them
/// lack are left out.
void SummarySheet::choose_columns() {
  const auto add = [&](const auto& belongs) {
    for (size_t k = 0; k < columns_.size(); ++k)
      if (!contains(shown_, k) && belongs(columns_[k])) shown_.push_back(k);
  };
  add([](const Column& column) { return column.name == "run"; });
  if (!unrelated_) add([](const Column& column) { return column.parameter.has_value(); });
  for (const Measure& measure : measures_)
    add([&](const Column& column) { return !column.parameter && column.name == measure.name; });
  printed_ = shown_.size();
  add([&](const Column& column) { return !column.parameter && (count_ < 2 || !column.is_constant); });
}

/// "title: Two balls; engine: exact". Empty: no column is folded.
string SummarySheet::folded() const {
  string text;
  for (size_t k = 0; k < columns_.size(); ++k) {
    const Column& column = columns_[k];
    if (column.parameter || column.first.empty() || contains(shown_, k)) continue;
    const Cell cell = column.is_text ? Cell{column.first} : cell_of(column.first);
    text += fmt::format("{}{}: {}", text.empty() ? "The same in all runs: " : "; ", column.label,
                        cell.is_number() ? fmt::format("{:.5g}", cell.number) : cell.text);
  }
  return text;
}

void SummarySheet::write_sheet_heads() {
  constexpr size_t columns_of_note = 8;
  constexpr double width_of_note = 100;  // characters
  if (const string text = folded(); !text.empty()) {
    sheet_.note(0, min(shown_.size(), columns_of_note), text, width_of_note);
    head_row_ = 1;
  }

  sheet_.set_head_row(head_row_);
  // The column names of a table must differ in more than the case of letters, and must not be long.
  map<string, int> taken;
  for (size_t k = 0; k < shown_.size(); ++k) {
    const Column& column = columns_[shown_[k]];
    string head = column.label.substr(0, longest_name - 8);
    if (const int before = taken[in_lower_case(head)]++; before > 0) head += fmt::format(" ({})", before + 1);
    heads_.push_back(head);
    sheet_.head(head_row_, k, head, head_of(column.style));
  }
}

void SummarySheet::write_rows() {
  Descriptor file = open_stored(place_.folder, part_name(summary_name));
  if (!file) fail("read", place_, summary_name);
  StoredTable table(std::move(file));

  size_t row = first_row();
  while (const auto* cells = table.next()) {
    if (row == most_rows) return;
    for (size_t k = 0; k < shown_.size(); ++k) {
      if (shown_[k] >= cells->size()) continue;
      const Column& column = columns_[shown_[k]];
      const string_view text = (*cells)[shown_[k]];
      sheet_.cell(row, k, column.is_text ? Cell{string(text)} : cell_of(text), column.style, &column.look);
    }
    ++row;
  }
}

void SummarySheet::finish() {
  table_->complete();
  choose_columns();
  write_sheet_heads();
  write_rows();

  const size_t rows = min(count_, most_rows - first_row());
  const auto last_row = to_row(head_row_ + rows);
  const auto last_column = to_column(shown_.size() - 1);

  if (is_table() && rows > 0) {
    make_table(last_row, last_column);
  } else if (rows > 0) {
    worksheet_autofilter(sheet_.get(), to_row(head_row_), 0, last_row, last_column);
  }
  if (rows > 0) mark_rows(last_row, last_column);

  sheet_.fit_table();
  sheet_.freeze(first_row(), 1);
  sheet_.print_table(head_row_);
  sheet_.print_columns(printed_);
}

/// Tints rows that are not `done`, in any order of sorting.
void SummarySheet::mark_rows(lxw_row_t last_row, lxw_col_t last_column) {
  const auto status = ranges::find_if(shown_, [&](auto k) { return columns_[k].name == "status"; });
  if (status == shown_.end()) return;

  char column[LXW_MAX_COL_NAME_LENGTH];
  lxw_col_to_name(column, to_column(status - shown_.begin()), 1);
  for (const auto& [text, style] : {pair("doubtful", CellStyle::doubtful), pair("failed", CellStyle::failed)}) {
    string formula = fmt::format("={}{}=\"{}\"", column, first_row() + 1, text);

    lxw_conditional_format rule{};
    rule.type = LXW_CONDITIONAL_TYPE_FORMULA;
    rule.value_string = formula.data();
    rule.format = sheet_.format(style);
    worksheet_conditional_format_range(sheet_.get(), to_row(first_row()), 0, last_row, last_column, &rule);
  }
}

void SummarySheet::make_table(lxw_row_t last_row, lxw_col_t last_column) {
  vector<lxw_table_column> columns(shown_.size());
  vector<lxw_table_column*> pointers;

  for (size_t k = 0; k < shown_.size(); ++k) {
    columns[k].header = const_cast<char*>(heads_[k].c_str());
    columns[k].header_format = sheet_.format(head_of(columns_[shown_[k]].style));
    pointers.push_back(&columns[k]);
  }
  pointers.push_back(nullptr);

  lxw_table_options options{};
  options.name = const_cast<char*>("Runs");
  options.style_type = LXW_TABLE_STYLE_TYPE_LIGHT;
  options.style_type_number = 1;
  options.columns = pointers.data();
  worksheet_add_table(sheet_.get(), to_row(head_row_), 0, last_row, last_column, &options);
}

unique_ptr<OutputFile> SummarySheet::take_table() {
  return std::move(table_);
}

size_t SummarySheet::place_of(size_t column) const {
  const auto found = ranges::find(shown_, column);
  return found == shown_.end() ? 0 : size_t(found - shown_.begin());
}

vector<size_t> SummarySheet::parameter_columns() const {
  vector<size_t> places(parameters_);
  for (size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].parameter) places[*columns_[k].parameter] = place_of(k);
  return places;
}

vector<size_t> SummarySheet::measure_columns() const {
  vector<size_t> places(measures_.size());
  for (size_t k = 0; k < columns_.size(); ++k) {
    if (columns_[k].measure) places[*columns_[k].measure] = place_of(k);
    for (size_t m = 0; m < measures_.size(); ++m)
      if (columns_[k].summary && measures_[m].name == columns_[k].name) places[m] = place_of(k);
  }
  return places;
}

}  // namespace carom
