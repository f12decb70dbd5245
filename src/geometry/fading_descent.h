#pragma once
// The time at which a quantity under linear drag crosses zero downwards.

#include "numerics/polynomial.h"
#include "physics/fading_path.h"
#include "std.h"

namespace carom {

/// f(t) = start + rate t + the sum of (bend of fade t) a t^2 over two terms: f'' is the sum of a exp(-fade t).
struct FadingDistance {
  struct Term {
    double a;     // m/s^2
    double fade;  // 1/s
  };
  double start, rate;  // m, m/s
  array<Term, 2> terms;

  double operator()(double t) const;
  double slope(double t) const;  // m/s
  double curve(double t) const;  // m/s^2
  // The sign of curve(t), also where that underflows.
  int bend_sign(double t) const;
};

/// The first t in [0, horizon] at which f crosses zero downwards, or `never`. With start = 0 that is t = 0 if f falls
/// from there. The second derivative changes its sign once at most, so that f is a convex and a concave piece. No root
/// is missed.
double first_descent(const FadingDistance& f, double horizon);

}  // namespace carom
