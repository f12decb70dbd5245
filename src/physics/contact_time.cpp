#include "physics/contact_time.h"

#include <algorithm>
#include <cmath>

#include "physics/compensated.h"
#include "physics/exact_path.h"

namespace carom {

namespace {

/// Rounding of a relative velocity, in units of the speeds that it is the difference of.
constexpr double velocity_noise = 16 * 0x1p-53;

/// t = c / (-b + sqrt(b^2 - a c)), with the discriminant as a s^2 - |d x w|^2 (Lagrange), so that a long way does not
/// swamp a small miss distance.
double straight_contact_time(const RelativeMotion& m, double s, double horizon) {
  const double b = m.d.dot(m.w);
  if (b >= 0) return never;
  const double c = m.just_separated ? 0 : squared_gap(m.d, s);
  if (c <= 0) return -b > velocity_noise * m.speeds * s ? 0 : never;
  const double a = m.w.squaredNorm();
  const Vec3 cross = m.d.cross(m.w);
  double disc = a * s * s - cross.squaredNorm();
  if (std::abs(disc) < 1e-3 * a * s * s) {
    const DoubleDouble x = difference_of_products(m.d.y(), m.w.z(), m.d.z(), m.w.y());
    const DoubleDouble y = difference_of_products(m.d.z(), m.w.x(), m.d.x(), m.w.z());
    const DoubleDouble z = difference_of_products(m.d.x(), m.w.y(), m.d.y(), m.w.x());
    disc = (dot_compensated(m.w, m.w) * two_product(s, s) - (x * x + y * y + z * z)).value();
  }
  if (disc <= 0) return never;
  const double t = c / (std::sqrt(disc) - b);
  return t <= horizon ? t : never;
}

}  // namespace

Polynomial squared_gap_polynomial(const RelativeMotion& m, double s) {
  const double c = m.just_separated ? 0 : squared_gap(m.d, s);
  double b = m.d.dot(m.w);
  if (c <= 0 && std::abs(b) <= velocity_noise * m.speeds * s) b = 0;
  return {{c, 2 * b, m.w.squaredNorm() + m.d.dot(m.a), m.w.dot(m.a), 0.25 * m.a.squaredNorm()}, 4};
}

double sphere_contact_time(const RelativeMotion& m, double s, double horizon) {
  if (m.a.isZero(0)) return straight_contact_time(m, s, horizon);
  const Polynomial f = squared_gap_polynomial(m, s);
  if (!m.just_separated) return first_descent(f, horizon);
  // t = 0 is a root by definition; what is left is a cubic. Below zero there, the two approach again (something else
  // has changed their velocities in the same instant).
  if (f.c[1] < 0) return 0;
  return first_descent({{f.c[1], f.c[2], f.c[3], f.c[4]}, 3}, horizon);
}

double sharpened_contact_time(const RelativeMotion& m, double s, double t, double horizon) {
  if (t == 0 || m.a.isZero(0)) return t;
  double last = never;
  for (int k = 0; k < 6; ++k) {
    DoubleDouble square = -two_product(s, s);
    for (const DoubleDouble& x : exact_position(m, t)) square = square + x * x;
    const double slope = 2 * (m.d + t * (m.w + 0.5 * t * m.a)).dot(m.w + t * m.a);
    const double step = -square.value() / slope;
    if (!(slope < 0 && std::abs(step) < 0.5 * last) || !(t + step > 0 && t + step <= horizon)) break;
    last = std::abs(step);
    t += step;
  }
  return t;
}

double plane_contact_time(double gap, double speed, double acceleration, double noise, bool just_separated,
                          double horizon) {
  if (just_separated) gap = 0;
  double t = never;
  if (gap <= 0 && std::abs(speed) <= noise) speed = 0;
  if (gap <= 0 && speed < 0) {
    t = 0;
  } else if (gap <= 0 && speed == 0) {
    t = acceleration < 0 ? 0 : never;
  } else if (gap <= 0) {
    // Leaving from a gap that is closed but for rounding: it comes back as one that leaves from zero.
    if (acceleration < 0) t = 2 * speed / -acceleration;
  } else if (acceleration == 0) {
    if (speed < 0) t = gap / -speed;
  } else {
    const double disc = difference_of_products(speed, speed, 2 * acceleration, gap).value();
    if (acceleration < 0) {
      const double q = std::sqrt(disc);
      t = speed > 0 ? (speed + q) / -acceleration : 2 * gap / (q - speed);
    } else if (speed < 0 && disc > 0) {
      t = 2 * gap / (std::sqrt(disc) - speed);
    }
  }
  return t <= horizon ? t : never;
}

double plane_gap(const Vec3& x, const Vec3& point, const Vec3& normal, double radius) {
  const double distance = (x - point).dot(normal);
  if (std::abs(distance - radius) > 1e-3 * radius) return distance - radius;
  const DoubleDouble exact = dot_compensated(x, normal) - dot_compensated(point, normal);
  return (exact - DoubleDouble{radius, 0}).value();
}

}  // namespace carom
