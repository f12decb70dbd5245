// Times of impact of spheres and planes in closed form where there is one, and by a bracketing search on quartics.
// Discriminants and gaps near zero are evaluated in double-double. A grazing contact is then as exact as its data.
#include "geometry/contact_time.h"

#include "geometry/exact_path.h"
#include "numerics/compensated.h"
#include "std.h"

namespace carom {

namespace {

/// Rounding of a relative velocity, in units of the speeds of which it is the difference.
constexpr double velocity_noise = 16 * 0x1p-53;

/// Relative rounding of a squared distance: a smaller gap cannot be distinguished from none.
constexpr double gap_noise = 0x1p-51;

/// t = c / (-b + sqrt(b^2 - a c)), with the discriminant as a s^2 - |d x w|^2 (Lagrange).
/// In that form a long path does not swamp a small miss distance.
double straight_contact_time(const RelativeMotion& m, double s, double horizon) {
  const double b = m.d.dot(m.w);
  if (b >= 0) return never;

  // Closed up to rounding, a slow approach is none.
  const double c = m.just_separated ? 0 : squared_gap(m.d, s);
  if (c <= gap_noise * s * s) {
    if (-b <= velocity_noise * m.speeds * s) return never;
    if (c <= 0) return 0;
  }

  const double a = m.w.squaredNorm();
  const Vec3 cross = m.d.cross(m.w);
  double disc = a * s * s - cross.squaredNorm();

  // The path may only graze.
  if (std::abs(disc) < 1e-3 * a * s * s) {
    const DoubleDouble x = difference_of_products(m.d.y(), m.w.z(), m.d.z(), m.w.y());
    const DoubleDouble y = difference_of_products(m.d.z(), m.w.x(), m.d.x(), m.w.z());
    const DoubleDouble z = difference_of_products(m.d.x(), m.w.y(), m.d.y(), m.w.x());
    disc = (dot_compensated(m.w, m.w) * two_product(s, s) - (x * x + y * y + z * z)).value();
  }

  if (disc <= 0) return never;
  const double t = c / (sqrt(disc) - b);
  return t <= horizon ? t : never;
}

}  // namespace

Polynomial squared_gap_polynomial(const RelativeMotion& m, double s, Side side) {
  const double sign = side == Side::outside ? 1 : -1;
  const double c = m.just_separated ? 0 : sign * squared_gap(m.d, s);
  double b = m.d.dot(m.w);
  if (c <= 0 && std::abs(b) <= velocity_noise * m.speeds * s) b = 0;
  return {{c, sign * (2 * b), sign * (m.w.squaredNorm() + m.d.dot(m.a)), sign * m.w.dot(m.a),
           sign * (0.25 * m.a.squaredNorm())},
          4};
}

Polynomial room_in_disc(const RelativeMotion& m, double s) {
  Polynomial room = squared_gap_polynomial(m, s);
  for (double& x : room.c) x = -x;
  return room;
}

Roots exit_times(const RelativeMotion& m, double s, double horizon) {
  const Polynomial room = room_in_disc(m, s), slope = room.derivative();
  Roots exits;
  const Roots all = roots_between(room, 0, horizon);
  for (int k = 0; k < all.count; ++k)
    if (const double t = all.at[size_t(k)]; slope(t) < 0) exits.at[size_t(exits.count++)] = t;
  return exits;
}

namespace {

/// The roots of this polynomial are the contacts. Where t = 0 is one by definition, a cubic is left.
Polynomial contact_polynomial(const RelativeMotion& m, double s, Side side) {
  const Polynomial f = squared_gap_polynomial(m, s, side);
  return m.just_separated ? Polynomial{{f.c[1], f.c[2], f.c[3], f.c[4]}, 3} : f;
}

/// The polynomial less the greatest rounding of each term, for a squared distance of at most (p + q t + r t^2)^2.
Polynomial lowered(Polynomial f, const RelativeMotion& m, double s) {
  constexpr double rounding = 0x1p-49;
  const double p = m.d.cwiseAbs().sum() + s, q = m.w.cwiseAbs().sum(), r = 0.5 * m.a.cwiseAbs().sum();
  const double bound[5] = {p * p, 2 * p * q, q * q + 2 * p * r, 2 * q * r, r * r};
  for (int k = 0; k <= f.degree; ++k) f.c[size_t(k)] -= rounding * bound[k + 4 - f.degree];
  return f;
}

}  // namespace

CurvedContacts::CurvedContacts(const RelativeMotion& motion, double s, double horizon, Side side)
    : m_(motion),
      s_(s),
      side_(side),
      f_(contact_polynomial(motion, s, side)),
      again_(motion.just_separated && f_.c[0] < 0),
      pieces_(lowered(f_, motion, s), horizon) {}

double CurvedContacts::next() {
  if (again_) {
    again_ = false;
    return 0;
  }
  for (Descents::Piece piece; pieces_.next(piece);) {
    const double t = piece.from > 0 ? within(piece.from, piece.to) : first_descent(f_, piece.to);
    if (t < never) return t;
  }
  return never;
}

/// |d + w t + a t^2/2|^2 - s^2 as the exact value rounds, or its negative. Just separated, it has |d|^2 for s^2.
double CurvedContacts::exact_gap(double t) const {
  DoubleDouble square = m_.just_separated ? DoubleDouble{0, 0} - dot_compensated(m_.d, m_.d) : -two_product(s_, s_);
  for (const DoubleDouble& x : exact_position(m_, t)) square = square + x * x;
  return side_ == Side::outside ? square.value() : -square.value();
}

/// The contact between two times where rounding allows one, most likely close to the first.
/// The method is Newton's. Bisection replaces a step that leaves the bracket or does not shrink.
double CurvedContacts::within(double from, double to) const {
  double l = from, r = to, t = from, last = never;
  // The gap at r is known to be below zero.
  bool deep = false;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double gap = exact_gap(t);
    if (gap == 0 || (gap < 0 && t == from)) return t;
    (gap > 0 ? l : r) = t;
    deep = deep || gap < 0;

    const Vec3 p = m_.d + t * (m_.w + 0.5 * t * m_.a), v = m_.w + t * m_.a;
    const double slope = side_ == Side::outside ? 2 * p.dot(v) : -2 * p.dot(v);
    const double curvature = 2 * (v.squaredNorm() + std::abs(p.dot(m_.a)));
    const double step = -gap / slope;
    if (t + step == t) return t;

    double next = t + step;
    const bool newton = slope < 0 && next > l && next < r && std::abs(step) <= 0.5 * last;
    if (newton && step * step * curvature <= -0x1p-54 * t * slope) return next;

    if (!newton) {
      deep = deep || exact_gap(r) < 0;
      // The path only comes near.
      if (!deep) return never;
      next = l + 0.5 * (r - l);
      if (next == l || next == r) return next;
    }

    last = std::abs(next - t);
    t = next;
  }
  return t;
}

double sphere_contact_time(const RelativeMotion& m, double s, double horizon) {
  if (m.a.isZero(0)) return straight_contact_time(m, s, horizon);
  return CurvedContacts(m, s, horizon).next();
}

namespace {

/// The same on a straight path: t = c / (b + sqrt(b^2 + c w^2)), with c = s^2 - |d|^2 and b = d . w.
double straight_taut_time(const RelativeMotion& m, double s, double horizon) {
  const double speed2 = m.w.squaredNorm();
  if (speed2 == 0) return never;
  double c = m.just_separated ? 0 : -squared_gap(m.d, s), b = m.d.dot(m.w);
  if (c <= gap_noise * s * s && std::abs(b) <= velocity_noise * m.speeds * s) b = c = 0;
  c = max(c, 0.0);
  if (c == 0 && b >= 0) return 0;
  const double root = sqrt(b * b + c * speed2);
  const double t = b > 0 ? c / (b + root) : (root - b) / speed2;
  return t <= horizon ? t : never;
}

}  // namespace

double taut_time(const RelativeMotion& m, double s, double horizon) {
  if (m.a.isZero(0)) return straight_taut_time(m, s, horizon);
  return CurvedContacts(m, s, horizon, Side::inside).next();
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
    // The body leaves from a gap that is closed up to rounding. It returns as one that leaves from zero.
    if (acceleration < 0) t = 2 * speed / -acceleration;
  } else if (acceleration == 0) {
    if (speed < 0) t = gap / -speed;
  } else {
    const double disc = difference_of_products(speed, speed, 2 * acceleration, gap).value();
    if (acceleration < 0) {
      const double q = sqrt(disc);
      t = speed > 0 ? (speed + q) / -acceleration : 2 * gap / (q - speed);
    } else if (speed < 0 && disc > 0) {
      t = 2 * gap / (sqrt(disc) - speed);
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
