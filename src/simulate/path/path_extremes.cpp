// Extremes of one flight. A coordinate turns where its velocity is zero, a speed where velocity and acceleration are
// perpendicular. Parabolas have one such point, in closed form. Elsewhere the flight is a polynomial, and all roots of
// its derivative are found (bernstein.h).
//
// Where a flight continues the one before, its start is no extreme: with it, the first of two values that differ by
// rounding would lie beside the turn and not at it. A period later the same value returns with the path's error, so
// each body has a bound of its errors so far, and a later value must exceed the first by more.
#include "simulate/path/path_extremes.h"

#include "numerics/bernstein.h"
#include "numerics/gauss.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

/// A polynomial in s, from the constant term on.
using Coefficients = vector<double>;

Coefficients slope_of(const Coefficients& of) {
  Coefficients slope;
  for (size_t k = 1; k < of.size(); ++k) slope.push_back(double(k) * of[k]);
  return slope;
}

void add_product(const Coefficients& p, const Coefficients& q, Coefficients& sum) {
  sum.resize(max(sum.size(), p.size() + q.size() - 1));
  for (size_t i = 0; i < p.size(); ++i)
    for (size_t j = 0; j < q.size(); ++j) sum[i + j] += p[i] * q[j];
}

/// A part of a flight, with t in s from its start on.
struct Part {
  const Flight& flight;
  VelocityBeyond more;

  Vec3 velocity(double t) const { return flight.velocity(t) + more.at(t); }
  PathPoint point(double t) const {
    return {flight.position(t), velocity(t), flight.velocity(t), flight.acceleration(t) + more.slope(t)};
  }

  /// The velocity from t on as polynomials in s = (time - t) / length, by axis (m/s).
  array<Coefficients, 3> velocities(double t, double length) const {
    const PolynomialPath::Terms terms = flight.displacement_from(t, length);
    const array<Vec3, 3> beyond = {more.at(t), length * more.slope(t), length * length * more.terms[2]};
    array<Coefficients, 3> v;
    for (int axis = 0; axis < 3; ++axis) {
      auto& of = v[size_t(axis)];
      for (size_t k = 0; k < terms.size(); ++k)
        of.push_back(double(k + 1) * terms[k][axis] / length + (k < 3 ? beyond[k][axis] : 0));
    }
    return v;
  }
};

/// The polynomial in s that is zero where the quantity turns.
Coefficients turning(Quantity quantity, const array<Coefficients, 3>& v) {
  const auto axis = size_t(quantity);
  if (is_place(quantity)) return v[axis];
  if (quantity <= Quantity::vz) return slope_of(v[axis - size_t(Quantity::vx)]);
  Coefficients power;
  for (const Coefficients& of : v) add_product(of, slope_of(of), power);
  return power;
}

/// Calls take(t) where the quantity of a parabola turns between `from` and `to` (s).
template <typename Take>
void turns_of_parabola(const Flight& f, Quantity quantity, double from, double to, const Take& take) {
  if (quantity >= Quantity::vx && quantity <= Quantity::vz) return;
  const int axis = is_place(quantity) ? int(quantity) : 0;
  const double slope = is_place(quantity) ? f.v[axis] : f.v.dot(f.a);
  const double bend = is_place(quantity) ? f.a[axis] : f.a.squaredNorm();
  const double t = -slope / bend;
  if (t > from && t < to) take(t);
}

template <typename Take>
void turns_of(const Part& part, Quantity quantity, double from, double to, const Take& take) {
  if (part.flight.is_straight() && (part.more.is_zero() || is_place(quantity)))
    return turns_of_parabola(part.flight, quantity, from, to, take);
  // A position follows the flight's own velocity.
  const Part path{part.flight, is_place(quantity) ? VelocityBeyond{} : part.more};
  for (double t = from; t < to;) {
    const double length = min(to - t, part.flight.span_of_fade(t));
    if (!(t + length > t)) return;
    for (const double s : roots_in_unit(turning(quantity, path.velocities(t, length)))) take(t + s * length);
    t += length;
    if (t < to) take(t);
  }
}

/// The value at s = 1 of the integral of a polynomial from s = 0 on.
double integral_of(const Coefficients& of) {
  double sum = 0;
  for (size_t k = of.size(); k-- > 0;) sum += of[k] / double(k + 1);
  return sum;
}

/// The integral of a speed over s from `from` to `to`, by bisection until halves add nothing. It is smooth between its
/// turns, and sharp at one where it almost vanishes. `scale`: m/s, what counts as rounding follows from it.
///
/// The rule's order is 20: where a speed is smooth, halves are a million times as exact as their difference shows.
double integral_of_speed(const array<Coefficients, 3>& v, double from, double to, double scale, int depth) {
  constexpr double close = 0x1p-44;
  const auto rule = [&](double a, double b) {
    double sum = 0;
    for (const GaussPoint& point : gauss_10) {
      const double s = a + point.at * (b - a);

      double squared = 0;  // m^2/s^2
      for (const Coefficients& of : v) {
        double speed = 0;
        for (size_t k = of.size(); k-- > 0;) speed = speed * s + of[k];
        squared += speed * speed;
      }
      sum += point.weight * sqrt(squared);
    }
    return (b - a) * sum;
  };

  const double middle = 0.5 * (from + to);
  const double halves = rule(from, middle) + rule(middle, to);
  if (depth == 0 || std::abs(halves - rule(from, to)) <= close * scale * (to - from)) return halves;
  return integral_of_speed(v, from, middle, scale, depth - 1) + integral_of_speed(v, middle, to, scale, depth - 1);
}

/// The same for a whole piece, between its turns.
double integral_of_speed(const array<Coefficients, 3>& v) {
  constexpr int most_bisections = 48;
  double scale = 0;
  for (const Coefficients& of : v)
    for (const double coefficient : of) scale = max(scale, std::abs(coefficient));

  double sum = 0, from = 0;
  vector<double> turns = roots_in_unit(turning(Quantity::speed, v));
  turns.push_back(1);
  for (const double to : turns) {
    sum += integral_of_speed(v, from, to, scale, most_bisections);
    from = to;
  }
  return sum;
}

/// The mean of a velocity, a speed or an energy over a piece of a flight, with its velocities as polynomials.
double mean_of(const array<Coefficients, 3>& v, Quantity quantity, double mass) {
  if (quantity <= Quantity::vz) return integral_of(v[size_t(quantity) - size_t(Quantity::vx)]);
  if (quantity == Quantity::speed) return integral_of_speed(v);
  Coefficients squared;
  for (const Coefficients& of : v) add_product(of, of, squared);
  return 0.5 * mass * integral_of(squared);
}

/// The mean of a coordinate over `length` (s) of a flight from t on, less the one at t (m).
double mean_way(const Flight& flight, int axis, double t, double length) {
  const PolynomialPath::Terms terms = flight.displacement_from(t, length);
  double sum = 0;
  for (size_t k = terms.size(); k-- > 0;) sum += terms[k][axis] / double(k + 2);
  return sum;
}

/// The integral of a quantity over the time from `from` to `to` (s) of a flight.
double integral_of(const Part& part, Quantity quantity, double mass, double from, double to) {
  Sum sum;
  for (double t = from; t < to;) {
    const double length = min(to - t, part.flight.span_of_fade(t));
    if (!(t + length > t)) break;

    if (is_place(quantity)) {
      sum.add(length * part.flight.position(t)[int(quantity)]);
      sum.add(length * mean_way(part.flight, int(quantity), t, length));
    } else {
      sum.add(length * mean_of(part.velocities(t, length), quantity, mass));
    }
    t += length;
  }
  return sum.value();
}

/// The rate of change of the quantity, or for energies one of the same sign.
double slope_of(Quantity quantity, const PathPoint& p) {
  const int axis = int(quantity);
  if (is_place(quantity)) return p.way[axis];
  if (quantity <= Quantity::vz) return p.a[axis - int(Quantity::vx)];
  return p.v.dot(p.a);
}

}  // namespace

PathExtremes::PathExtremes(const BodyPaths& bodies)
    : bodies_(bodies), found_(bodies.options.watch.size()), seen_(found_.empty() ? 0 : bodies.body.size()) {}

void PathExtremes::note(Entity i) {
  seen_[i] = take(i, bodies_.now, found_);
}

vector<Extremes> PathExtremes::up_to(double time) const {
  vector<Extremes> found = found_;
  for (Entity i = 0; i < seen_.size(); ++i) {
    // An impact at the double of the end has its other side, too.
    const Instant start = bodies_.flights[i].start;
    const Seen seen = take(i, start.hi == time ? max(start, Instant{time, 0}) : Instant{time, 0}, found);
    for (size_t k = 0; k < found.size() && seen.any; ++k) {
      const WatchedQuantity& watched = bodies_.options.watch[k];
      if (watched.has(i) && !watched.mean && watched.window.has(seen.until.hi))
        offer(k, i, seen.end, seen.until.hi, seen, found[k]);
    }
  }
  return found;
}

/// Offers the value at a point of body i's path, at `time` (s), with the errors so far.
void PathExtremes::offer(size_t k, Entity i, const PathPoint& at, double time, const Seen& errors,
                         Extremes& found) const {
  const Quantity quantity = bodies_.options.watch[k].quantity;
  const double mass = bodies_.world.mass[i];
  found.take(quantity_of(quantity, at.x, at.v, mass), time, rounding_of(quantity, at, mass, errors));
}

/// The error of a quantity at a point of a path with these errors.
double PathExtremes::rounding_of(Quantity quantity, const PathPoint& at, double mass, const Seen& errors) {
  if (is_place(quantity)) return errors.place;
  return quantity == Quantity::kinetic ? mass * at.v.norm() * errors.speed : errors.speed;
}

/// Adds the errors of a flight from `from` to `to`. Of a flight on a curve it is that of a step, but where the scene
/// chose the step.
void PathExtremes::add_errors(Entity i, const Flight& f, const PathPoint& from, const PathPoint& to, Seen& seen) const {
  const double place = max(from.x.cwiseAbs().maxCoeff(), to.x.cwiseAbs().maxCoeff());
  const double speed = max(from.v.norm(), to.v.norm()), radius = bodies_.world.radius[i];
  seen.place += exact_tolerance::position_rounding * place;
  seen.speed += exact_tolerance::velocity_rounding * speed;
  if (f.curve == nullptr || (bodies_.options.integrator != Integrator::dop853 && bodies_.flies_on_curve(i))) return;
  const double share = max(bodies_.options.step_error, exact_tolerance::step_error);
  seen.place += share * radius;
  seen.speed += share * (speed + sqrt(bodies_.applied[i].norm() * radius));
}

/// Takes the values of body i from the last instant taken to `until`, on its present flight. The value at its end
/// counts only where the next flight does not continue it. Returns what has been taken then.
PathExtremes::Seen PathExtremes::take(Entity i, const Instant& until, vector<Extremes>& found) const {
  const Seen before = seen_[i];
  if (before.any && until < before.until) return before;
  const Flight f = bodies_.flights[i];
  const Instant since = max(before.until, f.start);
  if (until < since || !is_in_world(bodies_.mode(i))) return before;

  // The velocity by the method, up to this instant.
  const double from = since - f.start;
  const double to = until - f.start;
  const double mass = bodies_.world.mass[i];
  Part part{f, {}};
  if (is_kicked(bodies_.mode(i)) && !bodies_.kick[i].a.isZero(0)) {
    part.more.terms[0] = -bodies_.kick[i].rest(f.start);
    part.more.terms[1] = bodies_.kick[i].a;
  } else if (f.curve != nullptr) {
    part.more = bodies_.beyond_curve(i, f, to);
  }

  const PathPoint start = part.point(from);
  Seen seen{true, until, part.point(to), before.place, before.speed};
  add_errors(i, f, start, seen.end, seen);

  for (size_t k = 0; k < found.size(); ++k) {
    const WatchedQuantity& watched = bodies_.options.watch[k];
    if (!watched.has(i)) continue;
    const Quantity quantity = watched.quantity;

    // The part of the flight that is in the window. Of an instant between two flights each has its own side.
    const Instant first = max(since, Instant{watched.window.from, 0}),
                  last = min(until, Instant{watched.window.until, 0});
    // An impact at the double of its end is in the window.
    const bool ends_here = since.hi == watched.window.until && since < until;
    if (!ends_here && (last < first || (last == first && since < until))) continue;
    const double enters = first - f.start, leaves = last - f.start;
    if (watched.mean) {
      if (last < first) continue;
      found[k].integral.add(integral_of(part, quantity, mass, enters, leaves));
      found[k].seconds.add(last - first);
      continue;
    }
    if (since < first) offer(k, i, part.point(enters), first.hi, seen, found[k]);
    if (last < until && !ends_here) offer(k, i, part.point(leaves), last.hi, seen, found[k]);

    // Whether the flight continues the one before.
    const double here = quantity_of(quantity, start.x, start.v, mass);
    const double rises = slope_of(quantity, start);
    const bool known = before.any && watched.window.has(before.until.hi);
    const double rose = known ? slope_of(quantity, before.end) : 0;
    const bool goes_on = ((rises > 0 && rose > 0) || (rises < 0 && rose < 0)) &&
                         std::abs(here - quantity_of(quantity, before.end.x, before.end.v, mass)) <=
                             rounding_of(quantity, start, mass, seen);
    // A window that begins or ends between two flights has both sides. One that ends there has nothing of the second
    // flight beyond its start.
    if (!goes_on || ends_here || since == Instant{watched.window.from, 0}) {
      if (known) offer(k, i, before.end, before.until.hi, before, found[k]);
      if (!(since < first)) offer(k, i, start, since.hi, seen, found[k]);
    }

    if (ends_here) continue;
    turns_of(part, quantity, enters, leaves,
             [&](double t) { offer(k, i, part.point(t), (f.start + t).hi, seen, found[k]); });
  }
  return seen;
}

}  // namespace carom
