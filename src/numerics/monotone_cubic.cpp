// Piecewise cubic Hermite interpolation. The slope at a point is the weighted harmonic mean of the slopes of the chords
// beside it (Fritsch and Butland 1984), and zero where these differ in sign. It then is at most three times either of
// them, which keeps each piece monotone (Fritsch and Carlson 1980). Splines of continuous curvature overshoot. The
// slopes at both ends are zero, so that the constant values outside continue the curve smoothly.
#include "numerics/monotone_cubic.h"

#include "std.h"

namespace carom {

MonotoneCubic::MonotoneCubic(vector<double> at, vector<double> value)
    : at_(std::move(at)), value_(std::move(value)), slope_(at_.size(), 0) {
  for (size_t i = 1; i + 1 < at_.size(); ++i) {
    const double before = at_[i] - at_[i - 1], after = at_[i + 1] - at_[i];
    const double left = (value_[i] - value_[i - 1]) / before, right = (value_[i + 1] - value_[i]) / after;
    if (!(left * right > 0)) continue;
    const double a = 2 * after + before, b = after + 2 * before;
    slope_[i] = (a + b) / (a / left + b / right);
  }
}

array<double, 4> MonotoneCubic::piece(size_t i) const {
  const double length = at_[i + 1] - at_[i], rise = value_[i + 1] - value_[i];
  const double start = length * slope_[i], end = length * slope_[i + 1];
  return {value_[i], start, 3 * rise - 2 * start - end, start + end - 2 * rise};
}

double MonotoneCubic::operator()(double t) const {
  if (!(t > at_.front())) return value_.front();
  const auto next = size_t(std::upper_bound(at_.begin(), at_.end(), t) - at_.begin());
  if (next == at_.size()) return value_.back();
  const array<double, 4> c = piece(next - 1);
  const double s = (t - at_[next - 1]) / (at_[next] - at_[next - 1]);
  const auto [low, high] = std::minmax(value_[next - 1], value_[next]);
  // Rounding alone could leave the range.
  return clamp(c[0] + s * (c[1] + s * (c[2] + s * c[3])), low, high);
}

}  // namespace carom
