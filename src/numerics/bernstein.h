#pragma once
// Polynomials on [0, 1] in Bernstein's basis. The changes of sign of the coefficients bound the number of roots, and
// halving an interval splits them, so that no root can be missed (Lane & Riesenfeld, BIT 21 (1981) 112).
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace carom {

struct Bernstein {
  static constexpr std::size_t most_degree = 16;
  std::array<double, most_degree + 1> b{};
  std::size_t degree = 0;

  /// From the coefficients of powers, a[0] + a[1] s + ... + a[degree] s^degree.
  static Bernstein of_powers(const std::array<double, most_degree + 1>& a, std::size_t degree);
  int changes() const;
  /// Leaves the left half, and returns the right half (de Casteljau).
  Bernstein split();
};

/// Every root of c[0] + c[1] s + ... in (0, 1), in ascending order, to rounding of s. The degree is at most 16.
/// Roots closer together than that count once. A point that rounding does not tell from a root may be among them.
/// The zero polynomial has none.
std::vector<double> roots_in_unit(std::span<const double> coefficients);

}  // namespace carom
