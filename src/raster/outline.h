#pragma once
// The outline of a ball in the plane z = 1 before the eye.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The ellipse that a sphere is in the plane z = 1, as seen from the origin.
struct Outline {
  double x, y;    // centre
  double ax, ay;  // the longer half axis
  double bx, by;  // the shorter half axis
  double depth2;  // m^2, (half the chord of the ray through the centre)^2 x |ray|^2
};
/// Computes the outline of a sphere, m. False: the sphere reaches behind the plane z = 0, so that its outline is not an
/// ellipse.
inline bool outline_of(const Vec3& center, double radius, Outline& out) {
  // The tangent cone (x.k)^2 = cos^2(alpha) |x|^2, cut by z = 1. theta is the angle between k and z.
  const double distance2 = center.squaredNorm();
  const double sin2 = radius * radius / distance2, cos2 = 1 - sin2;
  const double lateral2 = center.x() * center.x() + center.y() * center.y();
  const double q = cos2 - lateral2 / distance2;
  if (!(center.z() > 0 && q > 1e-4)) return false;
  const double lateral = std::sqrt(lateral2);
  const double ex = lateral > 0 ? center.x() / lateral : 1, ey = lateral > 0 ? center.y() / lateral : 0;
  const double m = lateral * center.z() / (distance2 * q);
  const double a = std::sqrt(sin2 * cos2) / q, b = std::sqrt(sin2 / q);
  out = {m * ex, m * ey, a * ex, a * ey, -b * ey, b * ex, radius * radius * cos2 / q};
  return true;
}

}  // namespace carom
