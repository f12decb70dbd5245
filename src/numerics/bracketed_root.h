#pragma once
// The root of a function in an interval that holds exactly one.

#include "std.h"

namespace carom {

/// The root of f in (l, r), by Newton's method, with bisection where it leaves the bracket or converges slowly.
/// df: the derivative of f. falling: f is above zero before the root, and below after it.
template <typename F, typename Slope>
double bracketed_root(const F& f, const Slope& df, double l, double r, bool falling) {
  double t = l + 0.5 * (r - l);
  double step = r - l;

  for (int iteration = 0; iteration < 200; ++iteration) {
    const double value = f(t);
    if (value == 0) return t;
    ((value > 0) == falling ? l : r) = t;

    // Newton's step, or the middle of the bracket.
    const double newton = t - value / df(t);
    double next = newton;
    if (!(newton > l && newton < r) || std::abs(newton - t) > 0.5 * std::abs(step)) next = l + 0.5 * (r - l);

    step = next - t;
    if (next == t || next == l || next == r) return next;
    t = next;
  }
  return t;
}

}  // namespace carom
