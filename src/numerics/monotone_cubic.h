#pragma once
// A smooth curve through points in order: a cubic between each two, with one slope at each point.
// Between two points the curve never leaves the range of their values, so that it adds no turn of its own.

#include "std.h"

namespace carom {

class MonotoneCubic {
 public:
  /// `at` ascends strictly. `value` belongs to it. There is at least one point.
  MonotoneCubic(vector<double> at, vector<double> value);

  /// Before the first point and after the last one, their values.
  double operator()(double t) const;
  /// The piece from point i to point i + 1 as c[0] + c[1] s + c[2] s^2 + c[3] s^3, with s from 0 to 1.
  array<double, 4> piece(size_t i) const;

 private:
  vector<double> at_, value_, slope_;
};

}  // namespace carom
