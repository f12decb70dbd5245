// The first zero of a distance under linear drag. Its second derivative is a sum of two exponentials, which changes
// sign once at most. That divides the horizon into a convex and a concave piece. On each, Newton's method with
// bisection finds the zero or shows that there is none.
#include "geometry/fading_descent.h"

#include "std.h"

namespace carom {

namespace {

/// The point at which `value` falls through zero between `from`, where it is positive, and `to`, where it is not.
/// The method is Newton's with the given slope. Bisection replaces a step that leaves the bracket.
template <typename Value, typename Slope>
double fall_between(const Value& value, const Slope& slope, double from, double to, double guess) {
  double t = guess;
  for (int pass = 0; pass < 200; ++pass) {
    const double at = value(t), rate = slope(t);
    (at > 0 ? from : to) = t;
    double next = rate < 0 ? t - at / rate : from;
    if (!(next > from && next < to)) next = 0.5 * (from + to);
    if (next == t || next <= from || next >= to || std::abs(next - t) <= 0x1p-53 * t) return next;
    t = next;
  }
  return t;
}

/// The descent of f on [from, to], where its second derivative does not change sign.
double descent_on(const FadingDistance& f, double from, double to) {
  const auto value = [&](double t) { return f(t); };
  const auto slope = [&](double t) { return f.slope(t); };
  const double at_from = f(from), slope_from = f.slope(from);
  if (at_from <= 0 && slope_from < 0) return from;

  const double middle = 0.5 * (from + to);
  if (f.bend_sign(middle) < 0) {
    if (at_from <= 0 && slope_from == 0) return from;
    if (f(to) > 0) return never;

    // f falls from there on.
    double top = from;
    if (slope_from > 0)
      top = fall_between(
          slope, [&](double t) { return f.curve(t); }, from, to, middle);
    return f(top) > 0 ? fall_between(value, slope, top, to, to) : top;
  }

  if (slope_from >= 0) return never;
  // f falls up to there.
  double bottom = to;
  if (f.slope(to) > 0)
    bottom =
        fall_between([&](double t) { return -f.slope(t); }, [&](double t) { return -f.curve(t); }, from, to, middle);
  return f(bottom) <= 0 ? fall_between(value, slope, from, bottom, from) : never;
}

}  // namespace

double FadingDistance::operator()(double t) const {
  double sum = 0;
  for (const Term& term : terms)
    if (term.a != 0) sum += term.a * fading(term.fade * t).bend;
  return start + t * (rate + t * sum);
}

double FadingDistance::slope(double t) const {
  double sum = rate;
  for (const Term& term : terms)
    if (term.a != 0) sum += term.a * (term.fade == 0 ? t : fading(term.fade * t).gone / term.fade);
  return sum;
}

double FadingDistance::curve(double t) const {
  double sum = 0;
  for (const Term& term : terms)
    if (term.a != 0) sum += term.a * (1 - fading(term.fade * t).gone);
  return sum;
}

int FadingDistance::bend_sign(double t) const {
  const bool second = terms[0].a == 0 || (terms[1].a != 0 && terms[1].fade < terms[0].fade);
  const Term &slow = terms[second], &fast = terms[!second];
  const double sum = slow.a + (fast.a == 0 ? 0 : fast.a * (1 - fading((fast.fade - slow.fade) * t).gone));
  return (sum > 0) - (sum < 0);
}

double first_descent(const FadingDistance& f, double horizon) {
  if (!(horizon > 0)) return f.start <= 0 && f.slope(0) < 0 ? 0 : never;

  // The time at which the terms cancel. There is at most one, because one of them fades more slowly.
  double turn = horizon;
  if (f.bend_sign(0) * f.bend_sign(horizon) < 0) {
    double low = 0, high = horizon;
    while (high - low > 0x1p-50 * high) {
      const double t = 0.5 * (low + high);
      (f.bend_sign(t) * f.bend_sign(0) > 0 ? low : high) = t;
    }
    turn = high;
  }

  const double first = descent_on(f, 0, turn);
  return first < never || turn == horizon ? first : descent_on(f, turn, horizon);
}

}  // namespace carom
