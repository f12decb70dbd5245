// Elementary functions from + - * / and the square root alone. Tables and minimax polynomials would be faster, but
// series can be checked by reading. Sine, cosine and exponential are Taylor's series. Cody & Waite's method reduces the
// argument to two doubles (Software Manual for the Elementary Functions, 1980, chapters 6 and 8). Logarithm and angle
// start from a guess g by a short series. One step with exp(-g), or with sin(g) and cos(g), then makes them right to
// the rounding of those.
#include "numerics/elementary.h"

#include "std.h"

namespace carom {

namespace {

constexpr double pi = 0x1.921fb54442d18p+1;
constexpr double half_pi_parts[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110};
// It has 32 bits, so that its multiples by numbers below 2^21 are exact.
constexpr double ln2_hi = 0x1.62e42fee00000p-1;
constexpr double ln2_lo = 0x1.a39ef35793c76p-33;

/// sin(r) and cos(r) for |r| a little above pi/4 at most.
SinCos sin_cos_reduced(DoubleDouble r) {
  const double square = r.hi * r.hi;
  // sin(r) = r - r^3 s and cos(r) = 1 - r^2/2 + r^4 c.
  double s = 0, c = 0;
  for (size_t n = 17; n >= 3; n -= 2) s = inverse_factorial[n] - square * s;
  for (size_t n = 18; n >= 4; n -= 2) c = inverse_factorial[n] - square * c;
  // The lower part of r enters by the derivative. 1 - r^2/2 is rounded once, and the rounding error is added again.
  const double sine = r.hi - (r.hi * square * s - r.lo * (1 - 0.5 * square));
  const double half = 0.5 * square, w = 1 - half;
  return {sine, w + ((1 - w - half) + (square * square * c - r.hi * r.lo))};
}

/// exp(-r) - 1 for |r| a little above ln(2)/2 at most.
double exp_change_reduced(double r) {
  // exp(-r) = 1 - r + r^2 p.
  double p = 0;
  for (size_t n = 14; n >= 2; --n) p = inverse_factorial[n] - r * p;
  return r * r * p - r;
}

struct Halvings {
  int count;
  double rest;
};
/// z = count ln 2 + rest, |rest| <= ln(2)/2, for 0 <= z < 1e5.
Halvings halvings(double z) {
  const double count = floor(z * (1 / (ln2_hi + ln2_lo)) + 0.5);
  return {int(count), (z - count * ln2_hi) - count * ln2_lo};
}

/// log(1 + y) to a relative error of 1e-7, for y >= 0. With y = 2 w / (1 - w) it is 2 atanh(w) = 2 (w + w^3/3 + ...).
double log_one_plus_guess(double y) {
  int exponent = 0;
  double w = y / (2 + y);
  if (y > 0.41) {
    // In [1/sqrt(2), sqrt(2)).
    const double m = std::frexp(1 + y, &exponent) * sqrt(2.0);
    w = (m - 1) / (m + 1);
  }
  const double square = w * w;
  return (exponent == 0 ? 0 : (exponent - 0.5) * ln2_hi) +
         2 * w * (1 + square * (1.0 / 3 + square * (0.2 + square * (1.0 / 7 + square / 9))));
}

/// The angle to a relative error of 1e-5. It is twice the angle with tangent u = y / (1 + sqrt(1 + y^2)), by the series
/// u - u^3/3 + ...
double arc_tangent_guess(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  const double slope = min(ax, ay) / max(ax, ay), u = slope / (1 + sqrt(1 + slope * slope));
  const double square = u * u;
  double angle =
      2 * u * (1 - square * (1.0 / 3 - square * (0.2 - square * (1.0 / 7 - square * (1.0 / 9 - square / 11)))));
  if (ay > ax) angle = 0.5 * pi - angle;
  if (x < 0) angle = pi - angle;
  return std::copysign(angle, y);
}

}  // namespace

SinCos sin_cos(DoubleDouble z) {
  if (!(std::abs(z.hi) < 0x1p52)) return {0, 1};
  const double sign = std::copysign(1.0, z.hi);
  DoubleDouble r = {sign * z.hi, sign * z.lo};

  // Whole quarters of a turn are taken away in three parts.
  const double quarters = floor(r.hi * (2 / pi) + 0.5);
  if (quarters != 0) {
    r = r - two_product(quarters, half_pi_parts[0]) - two_product(quarters, half_pi_parts[1]);
    r = r - DoubleDouble{quarters * half_pi_parts[2], 0};
  }

  // Each of them exchanges sine and cosine, and changes a sign.
  const SinCos of = sin_cos_reduced(r);
  const double quarter = quarters - 4 * floor(0.25 * quarters);
  if (quarter == 0) return {sign * of.sin, of.cos};
  if (quarter == 1) return {sign * of.cos, -of.sin};
  if (quarter == 2) return {-sign * of.sin, -of.cos};
  return {-sign * of.cos, of.sin};
}

double exponential(double z) {
  if (z <= 0) return exp_minus(-z);
  if (!(z < 710)) return z + infinity;
  const Halvings h = halvings(z);
  return std::ldexp(1 + exp_change_reduced(-h.rest), h.count);
}

double exp_minus(double z) {
  if (!(z < 746)) return 0;
  const Halvings h = halvings(z);
  return std::ldexp(1 + exp_change_reduced(h.rest), -h.count);
}

double exp_loss(double z) {
  if (!(z < 64)) return 1;
  const Halvings h = halvings(z);
  if (h.count == 0) return -exp_change_reduced(z);
  const double share = std::ldexp(1.0, -h.count);
  return (1 - share) - share * exp_change_reduced(h.rest);
}

double log_one_plus(double y) {
  if (!(y < 0x1p900)) return y < INFINITY ? log_one_plus(std::ldexp(y, -512)) + 512 * (ln2_hi + ln2_lo) : INFINITY;
  const double guess = log_one_plus_guess(y);
  // (1 + y) exp(-guess) - 1
  const double rest = (two_product(exp_minus(guess), y) - DoubleDouble{exp_loss(guess), 0}).value();
  return guess + rest * (1 - 0.5 * rest);
}

double logarithm(double x) {
  // The reciprocal of a lesser x has no double.
  if (x < 0x1p-1000) return logarithm(std::ldexp(x, 512)) - 512 * (ln2_hi + ln2_lo);
  // x - 1 and 1 - x are exact where they are small.
  return x >= 1 ? log_one_plus(x - 1) : -log_one_plus((1 - x) / x);
}

double arc_sinh(double y) {
  const double a = std::abs(y);
  if (a > 0x1p500) return std::copysign(log_one_plus(2 * min(a, 0x1p1022)), y);
  return std::copysign(log_one_plus(a + a * (a / (1 + sqrt(1 + a * a)))), y);
}

double arc_tangent(double y, double x) {
  if (x == 0 && y == 0) return 0;
  const double guess = arc_tangent_guess(y, x);
  const SinCos of = sin_cos(guess);
  // The tangent of the angle that the guess lacks.
  const double rest = difference_of_products(y, of.cos, x, of.sin).value() / (x * of.cos + y * of.sin);
  return guess + rest * (1 - rest * rest / 3);
}

}  // namespace carom
