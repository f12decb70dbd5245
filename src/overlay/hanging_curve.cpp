// With the height z = a cosh(u) over the way a u, the length between u1 and u2 is a (sinh u2 - sinh u1). For ends that
// are h apart along the horizontal and v along the vertical, with x = h / (2 a):
//   sinh(x) / x = sqrt(length^2 - v^2) / h,  u = -x + w to x + w,  tanh(w) = v / length.
// A chord of du is off the curve by a du^2 / 8 all along it, so that equal steps of u are the best.
#include "overlay/hanging_curve.h"

#include "std.h"

namespace carom {
namespace {

constexpr double most_strokes = 64;
/// Of the length: ends so near to one vertical line that the rope hangs down double.
constexpr double least_gap = 1e-9;

/// x > 0 with sinh(x) / x = q > 1. The start lies above it, and Newton's method then descends to it.
double inverse_of_sinh_ratio(double q) {
  double x = min(sqrt(6 * (q - 1)), 2 * log(2 * q) + 1);
  for (int i = 0; i < 100; ++i) {
    const double slope = std::cosh(x) - q;
    const double step = (std::sinh(x) - q * x) / slope;
    if (!(step > 1e-15 * x)) break;
    x -= step;
  }
  return x;
}

}  // namespace

vector<Vec3> hanging_curve(const Vec3& from, const Vec3& to, double length, const Vec3& down, double error) {
  const Vec3 way = to - from;
  const double distance = way.norm();
  if (!(length > distance) || down.isZero(0)) return {to};

  // Its parts along `down` and across.
  const double rise = -way.dot(down);
  const Vec3 level = way + rise * down;
  const double width = level.norm();
  if (!(width > least_gap * length)) return {from + (length - rise) / 2 * down, to};

  // The catenary: its scale a, and the places of its ends.
  const double ratio = sqrt((length - rise) * (length + rise)) / width;
  if (!(ratio > 1)) return {to};
  const double x = inverse_of_sinh_ratio(ratio);
  const double a = width / (2 * x), middle = std::atanh(rise / length), first = middle - x;
  const double count = clamp(ceil(2 * x / sqrt(8 * error / a)), 1.0, most_strokes);

  vector<Vec3> points;
  for (double i = 1; i < count; ++i) {
    const double turn = 2 * x * i / count;
    const double height = 2 * a * std::sinh(first + turn / 2) * std::sinh(turn / 2);
    points.push_back(from + a * turn / width * level - height * down);
  }
  points.push_back(to);
  return points;
}

}  // namespace carom
