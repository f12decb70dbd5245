#pragma once
// Whether two pieces are the same to the last bit.
#include <bit>

#include "physics/path_piece.h"
#include "std.h"

namespace carom::testing_export {

inline bool same_bits(double a, double b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}
inline bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}
inline bool same_bits(const DoubleDouble& a, const DoubleDouble& b) {
  return same_bits(a.hi, b.hi) && same_bits(a.lo, b.lo);
}

inline bool same_bits(const PolynomialPath& a, const PolynomialPath& b) {
  bool same = same_bits(a.length, b.length) && a.is_parabola == b.is_parabola && same_bits(a.ahead, b.ahead);
  for (size_t k = 0; k < PolynomialPath::terms; ++k) same = same && same_bits(a.displacement[k], b.displacement[k]);
  return same;
}

inline bool same_bits(const PathPiece& a, const PathPiece& b) {
  if (a.body != b.body || a.law != b.law || a.kicked != b.kicked || a.part_of != b.part_of || a.removed != b.removed ||
      a.joint != b.joint || (a.curve == nullptr) != (b.curve == nullptr))
    return false;
  if (a.curve && !same_bits(*a.curve, *b.curve)) return false;
  if (a.joint && !(same_bits(a.mass, b.mass) && same_bits(a.radius, b.radius) && same_bits(a.half, b.half)))
    return false;
  return same_bits(a.from, b.from) && same_bits(a.start, b.start) && same_bits(a.x, b.x) && same_bits(a.v, b.v) &&
         same_bits(a.a, b.a) && same_bits(a.fade, b.fade) && same_bits(a.rounding, b.rounding) &&
         same_bits(a.until, b.until) && same_bits(a.kick, b.kick);
}

}  // namespace carom::testing_export
