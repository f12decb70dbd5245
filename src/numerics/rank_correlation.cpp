// Ranks are doubled, so that the mean of tied ranks is whole and equal inputs give equal sums in any order.
#include "numerics/rank_correlation.h"

#include <numeric>

#include "std.h"

namespace carom {
namespace {

/// Twice each value's rank, from which the mean of all is subtracted.
vector<double> centred_ranks(const vector<double>& values) {
  vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  ranges::sort(order, [&](size_t a, size_t b) { return values[a] < values[b]; });

  const double middle = double(values.size()) - 1;
  vector<double> ranks(values.size());
  for (size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (size_t k = first; k < end; ++k) ranks[order[k]] = double(first + end - 1) - middle;
  }
  return ranks;
}

}  // namespace

double rank_correlation(span<const double> x, span<const double> y) {
  vector<double> a, b;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!isfinite(x[i]) || !isfinite(y[i])) continue;
    a.push_back(x[i]);
    b.push_back(y[i]);
  }

  const vector<double> of_a = centred_ranks(a), of_b = centred_ranks(b);
  double aa = 0, bb = 0, ab = 0;
  for (size_t i = 0; i < of_a.size(); ++i) {
    aa += of_a[i] * of_a[i];
    bb += of_b[i] * of_b[i];
    ab += of_a[i] * of_b[i];
  }
  return aa > 0 && bb > 0 ? ab / (sqrt(aa) * sqrt(bb)) : numeric_limits<double>::quiet_NaN();
}

}  // namespace carom
