#pragma once
// Roots of a polynomial of any degree in [0, 1] by its Bernstein coefficients.
// Their changes of sign bound the number of roots, and halving an interval splits them (Lane & Riesenfeld, BIT 21
// (1981) 112). No root can be missed.
#include <span>
#include <vector>

namespace carom {

/// Every root of c[0] + c[1] s + ... in (0, 1), in ascending order, to rounding of s.
/// Roots closer together than that count once. A point that rounding does not tell from a root may be among them.
/// The zero polynomial has none.
std::vector<double> roots_in_unit(std::span<const double> coefficients);

}  // namespace carom
