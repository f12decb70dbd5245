#pragma once
// The sheet Summary with a row for each run, and summary.csv with the same columns.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/compared_run.h"
#include "compare/workbook.h"
#include "files/output_file.h"

namespace carom {

class SummarySheet {
 public:
  /// The maximum number of runs for which the sheet is a table. With more runs it is streamed, with filters.
  static constexpr std::size_t most_in_table = 2000;
  static bool is_table(std::size_t count) { return count <= most_in_table; }

  /// For `count` runs. Adds the sheet to `book` and opens summary.csv in `place`.
  /// Throws ExportError if there are more columns than a sheet can hold.
  SummarySheet(const FilePlace& place, Workbook& book, const ComparisonPlan& plan, const std::vector<Measure>& measures,
               std::size_t count);

  /// Writes the first row of both. To be called before the first run.
  void write_heads();
  /// Writes the row of run `number`, from 0 on. Runs must come in order.
  void add(std::size_t number, const RunRecord& run);
  /// To be called after the last run. summary.csv is complete without it.
  void finish();
  /// Passes the ownership of summary.csv to the caller.
  std::unique_ptr<OutputFile> take_table();

  bool is_table() const { return is_table(count_); }
  /// The columns of the plan's parameters, in their order.
  std::vector<std::size_t> parameter_columns() const;
  /// The columns of the measures, in their order.
  std::vector<std::size_t> measure_columns() const;

 private:
  /// A column and the source of its cells: one of `summary`, `parameter`, `measure`.
  struct Column {
    std::string name;
    CellStyle style = CellStyle::plain;
    bool is_text = false;
    std::optional<std::size_t> summary, parameter, measure;
  };
  static std::vector<Column> make_columns(const ComparisonPlan& plan, const std::vector<Measure>& measures);
  void mark_rows(lxw_row_t last_row, lxw_col_t last_column);
  void make_table(lxw_row_t last_row, lxw_col_t last_column);

  const std::size_t count_, parameters_;  // how many
  const std::vector<Measure>& measures_;
  const std::vector<Column> columns_;
  std::vector<std::string> heads_;  // of the table, by column
  Worksheet& sheet_;
  std::unique_ptr<OutputFile> table_;
};

}  // namespace carom
