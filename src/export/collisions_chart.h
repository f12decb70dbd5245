#pragma once
// The chart of collisions per second over time, by kind.

#include "export/histogram.h"
#include "physics/collision.h"
#include "std.h"

namespace carom {

struct Scene;

class CollisionsChart {
 public:
  explicit CollisionsChart(const Scene& scene) : scene_(scene) {}
  /// At a time (s). The end of bounces (CollisionKind::rest) is no collision and is not counted.
  void add(double time, CollisionKind kind);
  /// The collisions of one kind over time (s).
  Histogram histogram(CollisionKind kind) const;
  Plot plot() const;

  void keep(auto& archive) { archive(counts_); }

 private:
  /// Collisions are counted in so many intervals, and joined afterwards, when their number is known.
  static constexpr size_t intervals = 120;
  using Counts = array<uint64_t, intervals>;
  struct Row {
    CollisionKind kind;
    string_view name;
    size_t style;
  };
  static const array<Row, 4> rows;
  uint64_t total() const;
  int joined() const;

  const Scene& scene_;
  array<Counts, 4> counts_{};  // by row
};

}  // namespace carom
