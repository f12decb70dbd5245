// The angle is reduced in degrees, where that is exact: a multiple of 90 is subtracted before the factor pi/180 enters.
// sin(z pi/180) by a plain product would give 6e-17 for the cosine of 90 degrees.
#include "numerics/degrees.h"

#include "std.h"

namespace carom {
namespace {

constexpr double nan = numeric_limits<double>::quiet_NaN();
/// pi / 180, the second double being the rounding error of the first.
constexpr DoubleDouble radians{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
constexpr double degrees = 0x1.ca5dc1a63c1f8p+5;  // 180 / pi

/// Of an angle from -45 to 45 degrees.
SinCos reduced(double angle) {
  if (std::abs(angle) == 30) return {std::copysign(0.5, angle), sqrt(0.75)};
  if (std::abs(angle) == 45) return {std::copysign(sqrt(0.5), angle), sqrt(0.5)};
  return sin_cos(two_product(angle, radians.hi) + DoubleDouble{angle * radians.lo, 0});
}

/// `angle`, or the whole number of degrees beside it for which `matches` holds.
template <typename Matches>
double whole_if(double angle, const Matches& matches) {
  const double whole = std::nearbyint(angle);
  return std::abs(angle - whole) < 1e-12 && matches(sin_cos_degrees(whole)) ? whole : angle;
}

}  // namespace

SinCos sin_cos_degrees(double angle) {
  if (!isfinite(angle)) return {nan, nan};
  const double turn = std::fmod(angle, 360);
  const double quarters = std::nearbyint(turn / 90);
  const SinCos of = reduced(turn - 90 * quarters);
  const int quarter = (int(quarters) + 8) % 4;
  if (quarter == 0) return {of.sin, of.cos};
  if (quarter == 1) return {of.cos, 0 - of.sin};
  if (quarter == 2) return {0 - of.sin, -of.cos};
  return {-of.cos, of.sin};
}

double arc_sine_degrees(double s) {
  if (!(std::abs(s) <= 1)) return nan;
  const double angle = arc_tangent(s, sqrt((1 - s) * (1 + s))) * degrees;
  return whole_if(angle, [&](const SinCos& of) { return of.sin == s; });
}

double arc_cosine_degrees(double c) {
  if (!(std::abs(c) <= 1)) return nan;
  const double angle = arc_tangent(sqrt((1 - c) * (1 + c)), c) * degrees;
  return whole_if(angle, [&](const SinCos& of) { return of.cos == c; });
}

double arc_tangent_degrees(double y, double x) {
  // Scaled by a power of two, so that no product overflows.
  const double largest = max(std::abs(x), std::abs(y));
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  const double sx = std::ldexp(x, -exponent), sy = std::ldexp(y, -exponent);
  return whole_if(arc_tangent(sy, sx) * degrees,
                  [&](const SinCos& of) { return sy * of.cos == sx * of.sin && sx * of.cos + sy * of.sin > 0; });
}

}  // namespace carom
