// Writes summary.csv and the sheet Summary together, one row for each run.
// A table needs its rows in memory, so more runs than most_in_table are streamed with filters instead.
#include "compare/summary_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "files/csv.h"
#include "files/run_folder.h"
#include "run/summary_columns.h"

namespace carom {
namespace {

/// The maximum length of a table's column names.
constexpr std::size_t longest_name = 255;

CellStyle head_of(CellStyle style) {
  return style == CellStyle::swept ? CellStyle::swept_header : CellStyle::header;
}

}  // namespace

std::vector<SummarySheet::Column> SummarySheet::make_columns(const ComparisonPlan& plan,
                                                             const std::vector<Measure>& measures) {
  std::vector<Column> columns;
  for (std::size_t k = 0; k < summary_columns().size(); ++k) {
    const SummaryColumn& summary = summary_columns()[k];
    Column column{std::string(summary.name), CellStyle::plain, summary.number == nullptr, k, {}, {}};
    for (const char* name : {"energy_residual_J", "momentum_drift_kg_m_per_s", "max_overlap_m"})
      if (column.name == name) column.style = CellStyle::rounding;
    if (!column.is_text && unit_of(summary.name).empty()) column.style = CellStyle::whole;
    columns.push_back(std::move(column));
  }
  for (std::size_t k = 0; k < plan.parameters.size(); ++k)
    columns.push_back({plan.parameters[k].path, CellStyle::swept, false, {}, k, {}});
  for (std::size_t k = 0; k < measures.size(); ++k)
    if (measures[k].column == nullptr) columns.push_back({measures[k].name, CellStyle::plain, false, {}, {}, k});
  if (columns.size() > most_columns)
    throw ExportError(
        fmt::format("a comparison of {} columns exceeds the {} of a spreadsheet: compare fewer parameters",
                    columns.size(), most_columns));
  return columns;
}

SummarySheet::SummarySheet(const FilePlace& place, Workbook& book, const ComparisonPlan& plan,
                           const std::vector<Measure>& measures, std::size_t count)
    : count_(count),
      parameters_(plan.parameters.size()),
      measures_(measures),
      columns_(make_columns(plan, measures)),
      sheet_(book.add("Summary", !is_table(count))),
      table_(std::make_unique<OutputFile>(place, summary_name)) {}

void SummarySheet::write_heads() {
  CsvRow row(*table_);
  // The column names of a table must differ in more than the case of letters, and must not be long.
  std::map<std::string, int> taken;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    row.text(columns_[k].name);
    std::string head = columns_[k].name.substr(0, longest_name - 8), lower = head;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    if (const int before = taken[lower]++; before > 0) head += fmt::format(" ({})", before + 1);
    heads_.push_back(head);
    sheet_.text(0, k, head, head_of(columns_[k].style));
  }
  row.end();
}

void SummarySheet::add(std::size_t number, const RunRecord& run) {
  CsvRow row(*table_);
  const bool room = number + 1 < most_rows;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Column& column = columns_[k];
    if (column.measure && !run.texts[*column.measure].empty()) {
      row.text(run.texts[*column.measure]);
      if (room) sheet_.text(number + 1, k, run.texts[*column.measure]);
      continue;
    }
    if (column.measure) {
      row.number(run.measures[*column.measure]);
      if (room) sheet_.number(number + 1, k, run.measures[*column.measure], column.style);
      continue;
    }
    std::string text = column.parameter ? run.run.values[*column.parameter] : run.summary[*column.summary];
    if (column.name == "run") text = run.run.id;
    if (column.name == "status" && !run.done) text = "failed";
    Cell cell{text};
    if (!column.is_text) cell = cell_of(text);
    cell.is_number() ? row.number(cell.number) : row.text(text);
    if (room) sheet_.cell(number + 1, k, cell, column.style);
  }
  row.end();
}

void SummarySheet::finish() {
  const std::size_t rows = std::min(count_, most_rows - 1);
  const auto last_row = static_cast<lxw_row_t>(rows);
  const auto last_column = static_cast<lxw_col_t>(columns_.size() - 1);
  if (is_table() && rows > 0) {
    make_table(last_row, last_column);
  } else if (rows > 0) {
    worksheet_autofilter(sheet_.get(), 0, 0, last_row, last_column);
  }
  if (rows > 0) mark_rows(last_row, last_column);
  // With room for the filters' buttons.
  sheet_.fit_all(9, 60, 3);
  sheet_.freeze(1, 1);
  sheet_.print_table();
}

/// Tints rows that are not `done`, in any order of sorting.
void SummarySheet::mark_rows(lxw_row_t last_row, lxw_col_t last_column) {
  const auto status =
      std::find_if(columns_.begin(), columns_.end(), [](const Column& c) { return c.name == "status"; });
  char column[LXW_MAX_COL_NAME_LENGTH];
  lxw_col_to_name(column, static_cast<lxw_col_t>(status - columns_.begin()), 1);
  for (const auto& [text, style] :
       {std::pair("doubtful", CellStyle::doubtful), std::pair("failed", CellStyle::failed)}) {
    std::string formula = fmt::format("={}2=\"{}\"", column, text);
    lxw_conditional_format rule{};
    rule.type = LXW_CONDITIONAL_TYPE_FORMULA;
    rule.value_string = formula.data();
    rule.format = sheet_.format(style);
    worksheet_conditional_format_range(sheet_.get(), 1, 0, last_row, last_column, &rule);
  }
}

void SummarySheet::make_table(lxw_row_t last_row, lxw_col_t last_column) {
  std::vector<lxw_table_column> columns(columns_.size());
  std::vector<lxw_table_column*> pointers;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    columns[k].header = const_cast<char*>(heads_[k].c_str());
    columns[k].header_format = sheet_.format(head_of(columns_[k].style));
    pointers.push_back(&columns[k]);
  }
  pointers.push_back(nullptr);
  lxw_table_options options{};
  options.name = const_cast<char*>("Runs");
  options.style_type = LXW_TABLE_STYLE_TYPE_LIGHT;
  options.style_type_number = 1;
  options.columns = pointers.data();
  worksheet_add_table(sheet_.get(), 0, 0, last_row, last_column, &options);
}

std::unique_ptr<OutputFile> SummarySheet::take_table() {
  return std::move(table_);
}

std::vector<std::size_t> SummarySheet::parameter_columns() const {
  std::vector<std::size_t> places(parameters_);
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].parameter) places[*columns_[k].parameter] = k;
  return places;
}

std::vector<std::size_t> SummarySheet::measure_columns() const {
  std::vector<std::size_t> places(measures_.size());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (columns_[k].measure) places[*columns_[k].measure] = k;
    for (std::size_t m = 0; m < measures_.size(); ++m)
      if (columns_[k].summary && measures_[m].name == columns_[k].name) places[m] = k;
  }
  return places;
}

}  // namespace carom
