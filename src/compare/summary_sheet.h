#pragma once
// summary.csv with a row for each run, and the sheet Summary of it: parameters, measures, then what else differs.

#include "compare/compared_run.h"
#include "files/output_file.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

class SummarySheet {
 public:
  /// The maximum number of runs for which the sheet is a table. With more runs it is streamed, with filters.
  static constexpr size_t most_in_table = 2000;
  static bool is_table(size_t count) { return count <= most_in_table; }

  /// For `count` runs. Adds the sheet to `book` and opens summary.csv in `place`. `unrelated`: see Variation.
  /// Throws ExportError if there are more columns than a sheet can hold.
  SummarySheet(const FilePlace& place, Workbook& book, const ComparisonPlan& plan, const vector<Measure>& measures,
               size_t count, bool unrelated);

  /// Writes the first row of the table. To be called before the first run.
  void write_heads();
  /// Writes the row of run `number` to the table, from 0 on. Runs must come in order.
  void add(size_t number, const RunRecord& run);
  /// Completes the table and writes the sheet from it. To be called after the last run.
  void finish();
  /// Passes the ownership of summary.csv, complete, to the caller.
  unique_ptr<OutputFile> take_table();

  bool is_table() const { return is_table(count_); }
  // After finish():
  /// The columns of the sheet with the plan's parameters, in their order. A column that is left out counts as the
  /// first.
  vector<size_t> parameter_columns() const;
  /// The columns of the sheet with the measures, in their order.
  vector<size_t> measure_columns() const;
  /// The first row of the sheet with a run, from 0.
  size_t first_row() const { return head_row_ + 1; }

 private:
  /// A column and the source of its cells: one of `summary`, `parameter`, `measure`.
  struct Column {
    string name, label;
    CellStyle style = CellStyle::plain;
    bool is_text = false;
    optional<size_t> summary, parameter, measure;
    NumberLook look{};
    string first{};  // its first cell
    bool is_constant = true;
  };
  static vector<Column> make_columns(const ComparisonPlan& plan, const vector<Measure>& measures);
  void choose_columns();
  string folded() const;
  void write_sheet_heads();
  void write_rows();
  void mark_rows(lxw_row_t last_row, lxw_col_t last_column);
  void make_table(lxw_row_t last_row, lxw_col_t last_column);
  size_t place_of(size_t column) const;

  const size_t count_, parameters_;  // how many
  const bool unrelated_;
  const FilePlace place_;
  const vector<Measure>& measures_;
  vector<Column> columns_;  // of the table
  vector<size_t> shown_;    // of the sheet: indices of columns_
  vector<string> heads_;    // of the sheet
  size_t printed_ = 0;      // of the sheet: the first columns, which are printed
  size_t head_row_ = 0;
  Worksheet& sheet_;
  unique_ptr<OutputFile> table_;
};

}  // namespace carom
