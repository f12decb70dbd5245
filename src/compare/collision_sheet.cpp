// Reads collisions.csv of each run row by row, so that no file is held in memory. A limit on rows keeps the workbook
// small.
#include "compare/collision_sheet.h"

#include <algorithm>

#include "compare/data_dictionary.h"

namespace carom {

CollisionSheet::CollisionSheet(Worksheet& sheet) : sheet_(sheet) {
  sheet_.text(0, 0, "run", CellStyle::header);
  std::size_t column = 1;
  for (const ColumnText& text : collision_columns()) sheet_.text(0, column++, text.name, CellStyle::header);
}

void CollisionSheet::add(const RunRecord& run) {
  if (!run.done || full_ || !has_file(run, "collisions.csv")) return;
  StoredTable table = open_table(run, "collisions.csv");
  std::vector<std::size_t> from;
  for (const ColumnText& text : collision_columns())
    from.push_back(table.find(text.name).value_or(table.columns().size()));
  while (const auto* cells = table.next()) {
    if (rows_ == most) {
      full_ = true;
      return;
    }
    ++rows_;
    sheet_.text(rows_, 0, run.run.id);
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] < cells->size()) sheet_.cell(rows_, 1 + k, cell_of((*cells)[from[k]]));
  }
}

void CollisionSheet::finish() {
  if (rows_ == 0) sheet_.text(1, 0, "No run has collisions in a collisions.csv.", CellStyle::note);
  sheet_.fit_all(9, 30, 2);
  sheet_.freeze(1, 1);
  worksheet_autofilter(sheet_.get(), 0, 0, static_cast<lxw_row_t>(std::max<std::size_t>(rows_, 1)),
                       static_cast<lxw_col_t>(collision_columns().size()));
  sheet_.print_table();
}

}  // namespace carom
