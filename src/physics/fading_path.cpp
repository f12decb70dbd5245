// Flight under constant forces and linear drag. Its factors are differences of exp(-z) from its first terms, and would
// lose digits for small z. A power series up to z = 1/2 and repeated doubling avoid that. They need no exponential
// function of a library, so that the bits are the same everywhere.
#include "physics/fading_path.h"

#include "std.h"

namespace carom {

Fading fading(double z) {
  // Beyond this, exp(-z) is below the rounding of 1.
  constexpr double all = 64;
  // Terms of the series: right to rounding up to 1/2.
  constexpr int terms = 13;

  // The series, for an argument of 1/2 at most.
  double part = min(z, all);
  int doublings = 0;
  for (; part > 0.5; part *= 0.5) ++doublings;
  double third = 0;
  for (int n = terms; n >= 0; --n) third = (1 - part * third) / (n + 3);
  third *= 0.5;
  double bend = 0.5 - part * third, gone = part * (1 - part * bend);

  if (doublings == 0) return {gone, bend, third};
  for (int k = 0; k < doublings; ++k) gone *= 2 - gone;
  bend = (z - gone) / (z * z);
  return {gone, bend, (0.5 - bend) / z};
}

Vec3 FadingPath::acceleration(double t) const {
  return fade == 0 ? a : Vec3((1 - fading(fade * t).gone) * a);
}

FadingPath FadingPath::from(double t) const {
  return t == 0 ? *this : FadingPath{position(t), velocity(t), acceleration(t), fade};
}

// The Taylor series. Its terms fall fast within the span.
PolynomialPath::Terms FadingPath::displacement_from(double t, double length) const {
  PolynomialPath::Terms terms;
  terms.fill(Vec3::Zero());
  terms[0] = length * velocity(t);
  terms[1] = (0.5 * length * length) * acceleration(t);
  // In the second case the acceleration has decayed.
  if (fade == 0 || !(fade * length < 1)) return terms;
  for (size_t k = 2; k < terms.size(); ++k) terms[k] = (-fade * length / double(k + 1)) * terms[k - 1];
  return terms;
}

double FadingPath::squared_speed(double t) const {
  // s is here the integral of the velocity's share of a: s' = 1 - fade s. Hence fade times the integral of s^2 is t^2
  // bend - s^2/2. Integrals of s and of s^2 over [0, t], here without drag. Their units are s^2 and s^3.
  double once = 0.5 * t * t, twice = t * t * t / 3;
  if (fade > 0) {
    const double z = fade * t;
    const Fading f = fading(z);
    once = t * t * f.bend;
    twice = t * t * t * (f.bend - f.third - 0.5 * z * f.bend * f.bend);
  }
  return t * v.squaredNorm() + 2 * once * v.dot(a) + twice * a.squaredNorm();
}

}  // namespace carom
