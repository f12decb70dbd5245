#pragma once
// Sines, exponentials, logarithms and angles with the same bits on every machine, which <cmath> does not promise.
// Only + - * / and the square root reach a result. Each function is right to 2.5 units in the last place.

#include "numerics/compensated.h"
#include "std.h"

namespace carom {

struct SinCos {
  double sin, cos;
};

/// Sine and cosine of z (rad). Beyond 2^52 a double does not resolve a phase: the result is then that of 0, as for NaN.
SinCos sin_cos(DoubleDouble z);
inline SinCos sin_cos(double z) {
  return sin_cos(DoubleDouble{z, 0});
}

/// exp(z). The result is 0 where that is below the least double, and infinite where it is above the greatest.
double exponential(double z);

/// exp(-z) for z >= 0. The result is 0 where that is below the least double.
double exp_minus(double z);

/// 1 - exp(-z) for z >= 0, with full relative precision for every z.
double exp_loss(double z);

/// log(1 + y) for y >= 0, with full relative precision for every y.
double log_one_plus(double y);

/// The natural logarithm of x > 0, with full relative precision for every x.
double logarithm(double x);

/// The inverse hyperbolic sine: u with sinh(u) = y.
double arc_sinh(double y);

/// The angle of (x, y) with the x axis (rad), in [-pi, pi]. It is 0 at (0, 0).
double arc_tangent(double y, double x);

/// 1 / n!
inline constexpr array<double, 32> inverse_factorial = [] {
  array<double, 32> of{1};
  double factorial = 1;
  for (size_t n = 1; n < of.size(); ++n) of[n] = 1 / (factorial *= double(n));
  return of;
}();

}  // namespace carom
