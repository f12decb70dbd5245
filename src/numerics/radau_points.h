#pragma once
// Radau's points in (0, 1], the last of which is 1. There Legendre's polynomials of the two highest degrees are equal
// (Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, IV.5).

#include "numerics/gauss.h"
#include "std.h"

namespace carom {

/// Legendre's polynomials up to degree `count`, for s in [0, 1] in place of x in [-1, 1].
template <size_t count>
array<double, count + 1> legendre(double s) {
  const double x = 2 * s - 1;
  array<double, count + 1> p{1, x};
  for (size_t n = 2; n <= count; ++n) {
    const auto degree = double(n);
    p[n] = ((2 * degree - 1) * x * p[n - 1] - (degree - 1) * p[n - 2]) / degree;
  }
  return p;
}

template <size_t count>
array<double, count> radau_points() {
  const auto f = [](double s) {
    const auto p = legendre<count>(s);
    return p[count - 1] - p[count];
  };

  // A fine grid separates the roots, and bisection finds them.
  constexpr int intervals = 1000;
  array<double, count> points{};
  size_t found = 0;
  for (int k = 0; k < intervals - 1; ++k) {
    double low = double(k) / intervals, high = (k + 1.0) / intervals;
    if (f(low) * f(high) > 0) continue;

    for (int pass = 0; pass < 60; ++pass) {
      const double middle = 0.5 * (low + high);
      (f(low) * f(middle) <= 0 ? high : low) = middle;
    }
    points[found++] = 0.5 * (low + high);
  }

  points[count - 1] = 1;
  return points;
}

/// The collocation matrix of points c: integrals of Lagrange's polynomials through them, from 0 up to each point.
template <size_t count, size_t size>
array<array<double, count>, count> collocation_matrix(const array<double, count>& c,
                                                      const array<GaussPoint, size>& rule) {
  array<array<double, count>, count> a{};
  for (size_t i = 0; i < count; ++i)
    for (const GaussPoint& node : rule)
      for (size_t j = 0; j < count; ++j) {
        double product = c[i] * node.weight;
        for (size_t l = 0; l < count; ++l)
          if (l != j) product *= (c[i] * node.at - c[l]) / (c[j] - c[l]);
        a[i][j] += product;
      }
  return a;
}

}  // namespace carom
