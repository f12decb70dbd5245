#pragma once
// When what changes under linear drag comes down through zero.
#include <array>

#include "numerics/polynomial.h"
#include "physics/fading_path.h"

namespace carom {

/// f(t) = start + rate t + the sum of (bend of fade t) a t^2 over two terms: f'' is the sum of a exp(-fade t).
struct FadingDistance {
  struct Term {
    double a;     // m/s^2
    double fade;  // 1/s
  };
  double start, rate;  // m, m/s
  std::array<Term, 2> terms;

  double operator()(double t) const;
  double slope(double t) const;   // m/s
  double curve(double t) const;   // m/s^2
  int bend_sign(double t) const;  // of curve(t), also where that is too small for a number
};

/// The first t in [0, horizon] at which f comes down through zero, or `never`. From start = 0 on it does so at once if
/// it falls from there. f'' changes its sign once at most, so that f is a convex and a concave piece: no root is
/// missed.
double first_descent(const FadingDistance& f, double horizon);

}  // namespace carom
