#pragma once
// Whether one quantity rises or falls with another, whatever the curve.

#include "std.h"

namespace carom {

/// Spearman's rank correlation of pairs, from -1 (one falls as the other rises) to 1 (both rise): the correlation of
/// their ranks, where equal values share the mean of their ranks (Kendall and Gibbons, Rank Correlation Methods, 5th
/// ed., 1990, section 3.8). Pairs with a value that is not finite do not count. NaN: fewer than two pairs, or all of
/// one quantity are equal. `x` and `y` have the same size.
double rank_correlation(span<const double> x, span<const double> y);

}  // namespace carom
