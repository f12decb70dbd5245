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

/// Each mean is a sum of its own, so that rounding errors do not add up, and a constant stays what it is. Many sums
/// grow at a time, each in the order of its terms: a processor adds them side by side, where one waits for each
/// addition.
vector<double> averaged(const vector<double>& values, size_t half) {
  if (values.empty()) return {};
  const double shift = values.front();
  vector<double> terms(values.size() + 2 * half, values.back() - shift);
  for (size_t i = 0; i < half; ++i) terms[i] = 0;
  for (size_t i = 0; i < values.size(); ++i) terms[half + i] = values[i] - shift;

  vector<double> means(values.size());
  array<double, 64> sums;
  for (size_t first = 0; first < means.size(); first += sums.size()) {
    const size_t count = min(sums.size(), means.size() - first);
    sums.fill(0);
    for (size_t k = 0; k <= 2 * half; ++k) {
      const double* term = &terms[first + k];
      for (size_t i = 0; i < count; ++i) sums[i] += term[i];
    }
    for (size_t i = 0; i < count; ++i) means[first + i] = shift + sums[i] / double(2 * half + 1);
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
