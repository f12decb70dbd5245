// Isolates roots by halving until one change of sign is left, then bisects. An interval of 2^-52 counts as a root.
#include "numerics/bernstein.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr int most_halvings = 52;

/// The Bernstein coefficients on [0, 1] of a polynomial in powers of s.
std::vector<double> bernstein_form(std::span<const double> power) {
  const std::size_t n = power.size();
  std::vector<double> form(power.begin(), power.end());
  // b_i = sum_k C(i, k) / C(n, k) c_k, by differences: first c_k / C(n, k), then sums.
  double choose = 1;
  for (std::size_t k = 0; k < n; ++k) {
    form[k] /= choose;
    choose = choose * static_cast<double>(n - 1 - k) / static_cast<double>(k + 1);
  }
  for (std::size_t round = 1; round < n; ++round)
    for (std::size_t i = n; i-- > round;) form[i] += form[i - 1];
  return form;
}

int changes_of_sign(const std::vector<double>& form) {
  int changes = 0;
  double last = 0;
  for (const double b : form) {
    if (b == 0) continue;
    changes += last != 0 && (b < 0) != (last < 0);
    last = b;
  }
  return changes;
}

/// The two halves of an interval (de Casteljau).
void halve(const std::vector<double>& form, std::vector<double>& left, std::vector<double>& right) {
  const std::size_t n = form.size();
  right = form;
  left.resize(n);
  for (std::size_t round = 0; round < n; ++round) {
    left[round] = right[0];
    for (std::size_t i = 0; i + 1 + round < n; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
}

void isolate(const std::vector<double>& form, double from, double length, int halvings, std::vector<double>& roots) {
  if (changes_of_sign(form) == 0) return;
  if (halvings == most_halvings) {
    roots.push_back(from);
    return;
  }
  std::vector<double> left, right;
  halve(form, left, right);
  isolate(left, from, 0.5 * length, halvings + 1, roots);
  if (right.front() == 0) roots.push_back(from + 0.5 * length);
  isolate(right, from + 0.5 * length, 0.5 * length, halvings + 1, roots);
}

}  // namespace

std::vector<double> roots_in_unit(std::span<const double> coefficients) {
  std::vector<double> roots;
  if (coefficients.size() > 1) isolate(bernstein_form(coefficients), 0, 1, 0, roots);
  std::erase_if(roots, [](double s) { return !(s > 0 && s < 1); });
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

}  // namespace carom
