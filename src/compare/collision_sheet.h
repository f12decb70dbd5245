#pragma once
// The sheet with the first collisions of each run, one run below the other.
#include <cstdint>
#include <string>
#include <vector>

#include "compare/compared_run.h"
#include "compare/workbook.h"

namespace carom {

class CollisionSheet {
 public:
  static constexpr std::size_t most = 20'000;  // rows

  /// For `runs` runs, each with the same share of rows.
  CollisionSheet(Worksheet& sheet, std::size_t runs);
  /// Takes the run's first collisions.
  void add(const RunRecord& run);
  void finish();

  /// The share of a run. None: all collisions have room.
  std::size_t share() const { return share_; }
  bool full() const { return full_; }  // whether some were left out

 private:
  struct Row {
    std::uint32_t run;
    std::vector<std::string> cells;
  };

  Worksheet& sheet_;
  std::size_t share_;
  bool full_ = false;
  std::vector<std::string> ids_;
  std::vector<Row> rows_;
};

}  // namespace carom
