#pragma once
// The collisions of all runs, one below the other.
#include "compare/compared_run.h"
#include "compare/workbook.h"

namespace carom {

class CollisionSheet {
 public:
  static constexpr std::size_t most = 100'000;  // rows

  explicit CollisionSheet(Worksheet& sheet);
  /// Appends the run's collisions, as far as there is room.
  void add(const RunRecord& run);
  void finish();

  std::size_t rows() const { return rows_; }
  bool full() const { return full_; }  // some had no room

 private:
  Worksheet& sheet_;
  std::size_t rows_ = 0;
  bool full_ = false;
};

}  // namespace carom
