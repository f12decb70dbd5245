#pragma once
// Error-free sums and products, and the few double-double operations that contact times need.
// Sources: Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971); Ogita,
// Rump & Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005).
// No fused multiply-add is used, so that every processor gives the same bits.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// An unevaluated sum hi + lo with |lo| at most half a unit in the last place of hi.
struct DoubleDouble {
  double hi, lo;
  double value() const { return hi + lo; }
};

/// a + b = hi + lo exactly.
inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b;
  const double b_part = s - a;
  return {s, (a - (s - b_part)) + (b - b_part)};
}

/// a + b = hi + lo exactly, for |a| >= |b|.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a b = hi + lo exactly. The splitting overflows beyond 1e300, and tiny products underflow.
inline DoubleDouble two_product(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double p = a * b;
  const double ca = splitter * a, ah = ca - (ca - a), al = a - ah;
  const double cb = splitter * b, bh = cb - (cb - b), bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
  const DoubleDouble u = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(u.hi, u.lo + t.lo);
}
inline DoubleDouble operator-(DoubleDouble a) {
  return {-a.hi, -a.lo};
}
inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) {
  return a + -b;
}
inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// Right to about 1e-31, as is the square root below.
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * DoubleDouble{first, 0};
  const double second = rest.hi / b.hi;
  const double third = (rest - b * DoubleDouble{second, 0}).hi / b.hi;
  return fast_two_sum(first, second) + DoubleDouble{third, 0};
}
/// One step of Newton's method from the rounded root. The result is 0 for x <= 0 and for NaN.
inline DoubleDouble square_root(DoubleDouble x) {
  if (!(x.hi > 0)) return {0, 0};
  const double root = sqrt(x.hi);
  return fast_two_sum(root, (x - two_product(root, root)).value() / (2 * root));
}

/// a b - c d, as if rounded once or twice.
inline DoubleDouble difference_of_products(double a, double b, double c, double d) {
  return two_product(a, b) - two_product(c, d);
}

/// a . b in double-double.
inline DoubleDouble dot_compensated(const Vec3& a, const Vec3& b) {
  return two_product(a.x(), b.x()) + two_product(a.y(), b.y()) + two_product(a.z(), b.z());
}

/// |d|^2 - s^2 without cancellation: the exact value for the given doubles, rounded.
inline double squared_gap(const Vec3& d, double s) {
  const double plain = d.squaredNorm() - s * s;
  if (std::abs(plain) >= 1e-3 * s * s) return plain;
  return (dot_compensated(d, d) - two_product(s, s)).value();
}

/// A running sum with compensation (Neumaier, ZAMM 54, 1974).
class Sum {
 public:
  void add(double x) {
    const DoubleDouble s = two_sum(sum_, x);
    sum_ = s.hi;
    lost_ += s.lo;
  }
  double value() const { return sum_ + lost_; }

  void keep(auto& archive) { archive(sum_, lost_); }

 private:
  double sum_ = 0, lost_ = 0;
};

}  // namespace carom
