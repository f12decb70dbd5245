#include "numerics/smooth_minorant.h"

#include <deque>

#include "std.h"

namespace carom {
namespace {

/// The least of the values up to `reach` to either side of each.
vector<double> least_around(const vector<double>& values, size_t reach) {
  vector<double> least(values.size());
  std::deque<size_t> candidates;  // ascending in number and in value
  size_t next = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    for (; next < values.size() && next <= i + reach; ++next) {
      while (!candidates.empty() && values[candidates.back()] >= values[next]) candidates.pop_back();
      candidates.push_back(next);
    }
    while (candidates.front() + reach < i) candidates.pop_front();
    least[i] = values[candidates.front()];
  }
  return least;
}

/// Each mean is a sum of its own, so that rounding errors do not add up, and a constant stays what it is.
vector<double> averaged(const vector<double>& values, size_t half) {
  const auto last = ptrdiff_t(values.size()) - 1, reach = ptrdiff_t(half);
  const double shift = values.empty() ? 0 : values.front();
  vector<double> means(values.size());
  for (ptrdiff_t i = 0; i <= last; ++i) {
    double sum = 0;
    for (ptrdiff_t k = i - reach; k <= i + reach; ++k) sum += values[size_t(clamp<ptrdiff_t>(k, 0, last))] - shift;
    means[size_t(i)] = shift + sum / double(2 * half + 1);
  }
  return means;
}

}  // namespace

vector<double> smoothed(vector<double> values, size_t half) {
  for (int i = 0; i < 3; ++i) values = averaged(values, half);
  return values;
}

vector<double> smooth_minorant(const vector<double>& values, size_t half) {
  return smoothed(least_around(values, 3 * half), half);
}

}  // namespace carom
