// The damped oscillator (Landau & Lifshitz, Mechanics, section 25), by its response S = (exp(-q t) - exp(-p t)) / (p -
// q). Here p and q are the roots of z^2 - fade z + stiffness = 0. S' and the integral of S have similar forms. These
// are divided differences of the exponential function. Rounding destroys them where the roots, or a root and 0, are
// close in units of 1/t. Each case has a form without that: complex roots sin(w t) / w, real roots 1 - exp(-(p - q) t),
// and small roots the power series. (p - q)^2 and the phase w t have two doubles.
#include "physics/oscillation.h"

#include "numerics/elementary.h"
#include "std.h"

namespace carom {

namespace {

/// The roots. Real ones are large >= small > 0, complex ones fade / 2 +- i half_gap.
struct CharacteristicRoots {
  bool real;
  double large, small;    // 1/s, if real
  DoubleDouble half_gap;  // 1/s: half of their difference
};

CharacteristicRoots roots(double fade, double stiffness) {
  const double mean = 0.5 * fade;
  const DoubleDouble square = two_product(mean, mean) - DoubleDouble{stiffness, 0};
  if (square.hi < 0) return {false, 0, 0, square_root(-square)};
  const DoubleDouble half_gap = square_root(square);
  const double large = (half_gap + DoubleDouble{mean, 0}).value();
  return {true, large, stiffness / large, half_gap};
}

/// S and S' for complex roots: exp(-fade t / 2) sin(w t) / w and its derivative.
Response sines(double fade, double t, DoubleDouble w) {
  const double decay = exp_minus(0.5 * fade * t);
  const SinCos of = sin_cos(w * DoubleDouble{t, 0});
  const double displaced = decay * (of.sin / w.hi);
  return {displaced, decay * of.cos - 0.5 * fade * displaced, 0};
}

/// S and S' for real roots.
Response exponentials(const CharacteristicRoots& of, double t) {
  const double gap = 2 * of.half_gap.hi, z = gap * t;
  const double displaced = exp_minus(of.small * t) * (z > 0 ? exp_loss(z) / gap : t);
  return {displaced, exp_minus(of.large * t) - of.small * displaced, 0};
}

/// Power series in t, right to rounding for |root| t <= 3/4.
/// S = t (1 + s_1 + ...), (n + 1) n s_n = -fade t n s_(n - 1) - stiffness t^2 s_(n - 2).
Response series(double fade, double stiffness, double t) {
  constexpr int terms = 17;
  const double f = fade * t, k = stiffness * t * t;
  // With s_n = h_n / (n + 1)!, the recurrence is h_n = -f h_(n - 1) - k h_(n - 2).
  double before = 0, h = 1, displaced = 1, bent = 0.5;
  for (size_t n = 1; n <= terms; ++n) {
    const double next = -f * h - k * before;
    before = h;
    h = next;
    displaced += h * inverse_factorial[n + 1];
    bent += h * inverse_factorial[n + 2];
  }
  return {t * displaced, 0, t * t * bent};
}

/// The integral of S, from the series at t / 2^n by repeated doubling of the angle. All terms have one sign.
double bent_by_series(double fade, double stiffness, double t, double size) {
  constexpr double reach = 0.75;
  int doublings = 0;
  for (; size > reach; size *= 0.5) ++doublings;
  Response r = series(fade, stiffness, std::ldexp(t, -doublings));
  for (int n = 0; n < doublings; ++n) {
    const double gone = stiffness * r.bent;
    r.bent = r.bent * (2 - gone) + r.displaced * r.displaced;
    r.displaced *= 2 * (1 - gone) - fade * r.displaced;
  }
  return r.bent;
}

/// (1 - exp(-z)) / z
double mean_decay(double z) {
  return z > 0 ? exp_loss(z) / z : 1;
}

}  // namespace

Response response(double fade, double stiffness, double t) {
  const CharacteristicRoots of = roots(fade, stiffness);
  Response r = of.real ? exponentials(of, t) : sines(fade, t, of.half_gap);
  const double angle = sqrt(stiffness) * t, gap = of.real ? 2 * of.half_gap.hi : 0;

  // Limits between the forms. Each form keeps all but two bits of the result within its own.
  constexpr double many = 1.5, far = 2, close = 0.75;
  if (angle >= many && (!of.real || of.small * t >= close)) {
    r.bent = (1 - r.kept - fade * r.displaced) / stiffness;
  } else if (gap * t >= far) {
    r.bent = (mean_decay(of.small * t) - mean_decay(of.large * t)) / gap * t;
  } else {
    r.bent = bent_by_series(fade, stiffness, t, of.real ? of.large * t : angle);
  }

  return r;
}

void Oscillation::at(double t, Vec3& position, Vec3& velocity) const {
  const Response r = response(fade, stiffness, t);
  position = x + (r.displaced * v + r.bent * a);
  velocity = r.kept * v + r.displaced * a;
}

void Oscillation::bend(double t, Vec3& acceleration, Vec3& jerk) const {
  const CharacteristicRoots of = roots(fade, stiffness);
  if (!of.real || of.large < 2 * of.small) {
    const Response r = response(fade, stiffness, t);
    const Vec3 velocity = r.kept * v + r.displaced * a;
    acceleration = r.kept * a - (fade * r.kept + stiffness * r.displaced) * v;
    jerk = -stiffness * velocity - fade * acceleration;
    return;
  }

  // The velocity is the sum of two exponentials: a slow one by springs against the drag, and a fast one that the drag
  // takes.
  const double gap = of.large - of.small;
  const Vec3 slow = exp_minus(of.small * t) / gap * (a - of.small * v);
  const Vec3 fast = exp_minus(of.large * t) / gap * (of.large * v - a);

  acceleration = -of.large * fast - of.small * slow;
  jerk = of.large * of.large * fast + of.small * of.small * slow;
}

}  // namespace carom
