#include "physics/polynomial.h"

#include <cmath>

namespace carom {

double Polynomial::operator()(double t) const {
  double value = c[static_cast<std::size_t>(degree)];
  for (int k = degree - 1; k >= 0; --k) value = value * t + c[static_cast<std::size_t>(k)];
  return value;
}

Polynomial Polynomial::derivative() const {
  Polynomial d;
  for (int k = 1; k <= degree; ++k) d.c[static_cast<std::size_t>(k - 1)] = k * c[static_cast<std::size_t>(k)];
  d.degree = degree > 0 ? degree - 1 : 0;
  return d;
}

namespace {

/// The root of f between l and r, where f is monotone and f(l), f(r) differ in sign. Newton's steps, and bisection
/// wherever such a step would leave the bracket or shrinks it too slowly.
double refine(const Polynomial& f, const Polynomial& df, double l, double r, bool falling) {
  double t = l + 0.5 * (r - l);
  double step = r - l;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double value = f(t);
    if (value == 0) return t;
    ((value > 0) == falling ? l : r) = t;
    const double newton = t - value / df(t);
    double next = newton;
    if (!(newton > l && newton < r) || std::abs(newton - t) > 0.5 * std::abs(step)) next = l + 0.5 * (r - l);
    step = next - t;
    if (next == t || next == l || next == r) return next;
    t = next;
  }
  return t;
}

int true_degree(const Polynomial& f) {
  int degree = f.degree;
  while (degree > 0 && f.c[static_cast<std::size_t>(degree)] == 0) --degree;
  return degree;
}

}  // namespace

Roots roots_between(const Polynomial& polynomial, double low, double high) {
  Polynomial f = polynomial;
  f.degree = true_degree(f);
  Roots roots;
  if (f.degree == 0) return roots;
  if (f.degree == 1) {
    const double t = -f.c[0] / f.c[1];
    if (t > low && t < high) roots.at[static_cast<std::size_t>(roots.count++)] = t;
    return roots;
  }
  const Polynomial df = f.derivative();
  const Roots turning = roots_between(df, low, high);
  double l = low;
  double f_l = f(l);
  for (int k = 0; k <= turning.count; ++k) {
    const double r = k < turning.count ? turning.at[static_cast<std::size_t>(k)] : high;
    const double f_r = f(r);
    if (f_r == 0 && r < high) {
      roots.at[static_cast<std::size_t>(roots.count++)] = r;
    } else if ((f_l > 0 && f_r < 0) || (f_l < 0 && f_r > 0)) {
      roots.at[static_cast<std::size_t>(roots.count++)] = refine(f, df, l, r, f_l > 0);
    }
    l = r;
    f_l = f_r;
  }
  return roots;
}

double first_descent(const Polynomial& polynomial, double horizon) {
  Polynomial f = polynomial;
  f.degree = true_degree(f);
  if (f.degree == 0 || !(horizon >= 0)) return never;
  const Polynomial df = f.derivative();
  const Roots turning = roots_between(df, 0, horizon);
  double l = 0;
  double f_l = f(l);
  for (int k = 0; k <= turning.count; ++k) {
    const double r = k < turning.count ? turning.at[static_cast<std::size_t>(k)] : horizon;
    const double f_r = f(r);
    if (f_r < f_l) {  // this piece falls
      if (f_l <= 0) return l;
      if (f_r < 0) return refine(f, df, l, r, true);
      if (f_r == 0 && r == horizon && k == turning.count) return r;
    }
    l = r;
    f_l = f_r;
  }
  return never;
}

}  // namespace carom
