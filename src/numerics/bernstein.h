#pragma once
// Polynomials on [0, 1] in Bernstein's basis. The changes of sign of the coefficients bound the number of roots, and
// halving an interval splits them, so that no root can be missed (Lane & Riesenfeld, BIT 21 (1981) 112).

#include "std.h"

namespace carom {

template <size_t most>
struct BernsteinUpTo {
  static constexpr size_t most_degree = most;
  array<double, most_degree + 1> b{};
  size_t degree = 0;

  /// From the coefficients of powers, a[0] + a[1] s + ... + a[degree] s^degree.
  static BernsteinUpTo of_powers(const array<double, most_degree + 1>& a, size_t degree);
  int changes() const;
  /// Leaves the left half, and returns the right half (de Casteljau).
  BernsteinUpTo split();
};

using Bernstein = BernsteinUpTo<16>;

/// Every root of c[0] + c[1] s + ... in (0, 1), in ascending order, to rounding of s. The degree is at most 32.
/// Roots closer together than that count once. A point that rounding does not tell from a root may be among them.
/// The zero polynomial has none.
vector<double> roots_in_unit(span<const double> coefficients);

}  // namespace carom
