// Keeps the rows until all runs are read, because the form of a column's numbers follows from all of them. A limit on
// rows keeps memory and the workbook small.
#include "compare/collision_sheet.h"

#include "compare/data_dictionary.h"
#include "std.h"
#include "workbook/number_look.h"

namespace carom {

CollisionSheet::CollisionSheet(Worksheet& sheet, size_t runs)
    : sheet_(sheet), share_(max<size_t>(1, most / max<size_t>(runs, 1))) {}

void CollisionSheet::add(const RunRecord& run) {
  if (!run.done || rows_.size() >= most || !has_file(run, "collisions.csv")) return;
  StoredTable table = open_table(run, "collisions.csv");
  vector<optional<size_t>> from;
  for (const ColumnText& text : collision_columns()) from.push_back(table.find(text.name));

  ids_.push_back(run.run.id);
  size_t taken = 0;
  while (table.next() != nullptr) {
    if (taken++ == share_) {
      full_ = true;
      return;
    }
    Row& row = rows_.emplace_back(Row{uint32_t(ids_.size() - 1), {}});
    for (const auto& column : from) row.cells.emplace_back(table.cell(column));
  }
}

void CollisionSheet::finish() {
  vector<NumberLook> looks(collision_columns().size());
  for (const Row& row : rows_)
    for (size_t k = 0; k < looks.size(); ++k) looks[k].add(cell_of(row.cells[k]).number);

  sheet_.set_head_row(0);
  sheet_.head(0, 0, "run");
  size_t column = 1;
  for (const ColumnText& text : collision_columns()) sheet_.head(0, column++, label_of(text.name));

  for (size_t i = 0; i < rows_.size(); ++i) {
    sheet_.text(1 + i, 0, ids_[rows_[i].run]);
    for (size_t k = 0; k < looks.size(); ++k)
      sheet_.cell(1 + i, 1 + k, cell_of(rows_[i].cells[k]), CellStyle::plain, &looks[k]);
  }
  if (rows_.empty()) sheet_.text(1, 0, "No run has collisions in a collisions.csv.", CellStyle::note);

  sheet_.fit_table();
  sheet_.freeze(1, 1);
  worksheet_autofilter(sheet_.get(), 0, 0, to_row(max<size_t>(rows_.size(), 1)), to_column(collision_columns().size()));
  sheet_.print_first_page();
}

}  // namespace carom
