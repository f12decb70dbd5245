#pragma once
// The sheet with the collisions of all runs, one run below the other.
#include "compare/compared_run.h"
#include "compare/workbook.h"

namespace carom {

class CollisionSheet {
 public:
  static constexpr std::size_t most = 100'000;  // rows

  explicit CollisionSheet(Worksheet& sheet);
  /// Appends the run's collisions as far as rows are left.
  void add(const RunRecord& run);
  void finish();

  std::size_t rows() const { return rows_; }
  bool full() const { return full_; }  // whether some were left out

 private:
  Worksheet& sheet_;
  std::size_t rows_ = 0;
  bool full_ = false;
};

}  // namespace carom
