#pragma once
// A smooth path through points in space. No coordinate leaves the range of two neighbouring points.

#include "numerics/monotone_cubic.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

class MonotonePath {
 public:
  /// `at` ascends strictly. `point` belongs to it. There is at least one.
  MonotonePath(const vector<double>& at, const vector<Vec3>& point);

  /// Before the first point and after the last one, these.
  Vec3 operator()(double t) const { return Vec3(x_(t), y_(t), z_(t)); }
  /// The coordinates from point i to point i + 1 (MonotoneCubic::piece).
  array<array<double, 4>, 3> piece(size_t i) const { return {x_.piece(i), y_.piece(i), z_.piece(i)}; }

 private:
  MonotoneCubic x_, y_, z_;
};

}  // namespace carom
