#pragma once
// The sheet with the first collisions of each run, one run below the other.

#include "compare/compared_run.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

class CollisionSheet {
 public:
  static constexpr size_t most = 20'000;  // rows

  /// For `runs` runs, each with the same share of rows.
  CollisionSheet(Worksheet& sheet, size_t runs);
  /// Takes the run's first collisions.
  void add(const RunRecord& run);
  void finish();

  /// The share of a run. None: all collisions have room.
  size_t share() const { return share_; }
  bool full() const { return full_; }  // whether some were left out

 private:
  struct Row {
    uint32_t run;
    vector<string> cells;
  };

  Worksheet& sheet_;
  size_t share_;
  bool full_ = false;
  vector<string> ids_;
  vector<Row> rows_;
};

}  // namespace carom
