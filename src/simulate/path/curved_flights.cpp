// Flights under forces that bend paths, in steps of each body's own. A step's polynomial gives the path for impacts.
// Where a closed form exists, every step starts from it, so that no error adds up. Otherwise DOP853 takes steps by its
// error estimate. Radau's collocation takes over where forces brake so strongly that they would hold up an explicit
// method. A common step for all bodies would be the shortest of all.
#include "simulate/path/curved_flights.h"

#include <fmt/format.h>

#include "numerics/dormand_prince.h"
#include "numerics/gauss.h"
#include "numerics/whole.h"
#include "physics/force.h"
#include "physics/implicit_step.h"
#include "physics/integrator.h"
#include "physics/springs_in_line.h"
#include "physics/world.h"
#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// A value in place of a number of steps: the last step was implicit.
constexpr uint8_t implicit_method = 255;

PolynomialPath::Point point(const ClosedMotion::Point& of) {
  return {of.velocity, of.acceleration, of.jerk};
}

}  // namespace

/// The first step length (s), from the rate at which forces change, or from the time in which the body moves by its
/// size.
double CurvedFlights::first_length(Entity i, const Vec3& x, const Vec3& v) const {
  const World& world = bodies_.world;
  const double rate = force_rate(world, i, x, v);
  const double fall = sqrt(world.radius[i] / max(bodies_.force_at(i, x, v).norm(), 0x1p-900));
  return rate > 0 ? tol::first_step / rate : tol::first_step * fall;
}

PolynomialPath CurvedFlights::step_of_its_own(Entity i, const Vec3& x, const Vec3& v) {
  const bool may_close = bodies_.options.closed_forms && bodies_.merged.parts_of(i).empty();
  const optional<ClosedForces> closed = may_close ? closed_forces(bodies_.world, i, bodies_.now.hi) : nullopt;
  return closed ? closed_step(i, *closed, x, v) : numerical_step(i, x, v);
}

/// Throws SimulationError if a step of so many seconds does not move the clock.
void CurvedFlights::check_clock(Entity i, double length) const {
  if (bodies_.now < bodies_.now + length) return;
  throw SimulationError(fmt::format("at t = {} s the forces on ", bodies_.now.hi), i,
                        " change faster than the clock resolves: soften an attractor, or weaken a stiff force");
}

/// The longest step (s): within the requested step, the run, and `reach` (m), the distance in which forces are smooth.
double CurvedFlights::longest_step(double reach, const Vec3& v, const Vec3& a) const {
  const double now = bodies_.now.hi;
  const double within_reach = step_within(reach, v.norm(), a.norm());
  const double longest =
      min(bodies_.options.step, max(2 * (bodies_.options.duration - now), tol::clock_rounding * now));
  return within_reach > 0 ? min(within_reach, longest) : longest;
}

/// Interpolates the velocity at the step's start, middle and end. Positions differ by less than their rounding in a
/// short step, and the polynomial would waver. The polynomial is compared with the motion where its error is greatest.
PolynomialPath CurvedFlights::closed_step(Entity i, const ClosedForces& forces, const Vec3& x, const Vec3& v) {
  if (closed_.empty()) closed_.resize(bodies_.body.size());
  Closed& closed = closed_[i];
  const Instant now = bodies_.now;

  // A flight that does not continue the last one starts a motion of its own.
  if (closed.next != now || closed.forces != forces || closed.end.x != x || closed.end.v != v) {
    closed.forces = forces;
    closed.motion = ClosedMotion(forces, x, v, free_acceleration(bodies_.world, i, now.hi, x, Vec3::Zero()));
    closed.start = now;
  }

  const ClosedMotion& motion = closed.motion;
  const DoubleDouble since = seconds(closed.start, now);
  const ClosedMotion::Point start = motion.at(since);
  const double radius = bodies_.world.radius[i];
  const double room = tol::closed_place * max({radius, x.cwiseAbs().maxCoeff(), start.place.cwiseAbs().maxCoeff()});

  // Outputs and impacts start from the motion itself. Polynomials only serve to find the times of impacts.
  const double speed = max({tol::closed_speed * start.velocity.norm(), room * motion.rate(start), 0x1p-900});

  // The longest step that is allowed, or the one that the last error suggests.
  double h = min(longest_step(force_reach(bodies_.world, i, x), start.velocity, start.acceleration),
                 motion.longest_step(start, room));
  if (next_[i] > 0) h = min(h, next_[i]);
  for (;;) {
    check_clock(i, h);
    const Instant next = now + h;
    const ClosedMotion::Point end = motion.at(seconds(closed.start, next));
    const PolynomialPath path =
        PolynomialPath::through(h, point(start), point(motion.at(since + DoubleDouble{0.5 * h, 0})), point(end));

    // The velocity's error is greatest at a quarter of the step. The displacement's error at the end is 0.4816 of that,
    // times the whole step.
    const Vec3 quarter = motion.at(since + DoubleDouble{0.25 * h, 0}).velocity;
    const double off = (start.velocity + path.change_at(0.25 * h) - quarter).norm();
    const double error = max(off / speed, 0.4816 * h * off / room);
    const double eighth_root = sqrt(sqrt(sqrt(error)));
    next_.write(i) = h * clamp(0.9 / max(eighth_root, 0x1p-10), 0.2, 4.0);

    if (error <= 1) {
      closed.next = next;
      closed.end = {motion.origin() + end.place, end.velocity};
      return path;
    }
    h = next_[i];
  }
}

CurvedFlights::Reached CurvedFlights::closed_place(Entity i, const Instant& at) const {
  const Closed& closed = closed_[i];
  const ClosedMotion::Point there = closed.motion.at(seconds(closed.start, at));
  return {closed.motion.origin() + there.place, there.velocity};
}

/// Whether the next step, of `length` (s) by the method before, is to be implicit.
/// It is if an implicit step is no shorter. It is too if a braking force holds dop853 to a share of its time (1 /
/// damping), step after step.
bool CurvedFlights::is_implicit(Entity i, double length, double damping) const {
  const double damped = length * damping;
  if (method_[i] == implicit_method) return damped >= 0.5;
  return damped > 2 || (method_[i] >= tol::many_explicit_steps && damped > 0.1);
}

void CurvedFlights::note_method(Entity i, bool implicit) {
  const uint8_t before = method_[i];
  const int explicit_steps = before == implicit_method ? 0 : min(before + 1, int{tol::many_explicit_steps});
  method_.write(i) = implicit ? implicit_method : uint8_t(explicit_steps);
}

namespace {

/// Shortens the path to its first `length` (s).
void cut(PolynomialPath& path, double length) {
  path.displacement = PolynomialPath::shifted(path.displacement, 0, length / path.length);
  path.length = length;
}

}  // namespace

PolynomialPath CurvedFlights::numerical_step(Entity i, const Vec3& x, const Vec3& v) {
  const World& world = bodies_.world;
  const double now = bodies_.now.hi;
  const double radius = world.radius[i];
  const double share = bodies_.options.step_error;
  const Vec3 whole = bodies_.merged.acceleration(i, now, x, v);
  const SpringsInLine springs(world, i, now, x, v, whole);

  // The accelerations and slopes that the two methods evaluate.
  const auto acceleration = [&](const Vec3& at, const Vec3& speed) {
    const Vec3 there = bodies_.merged.acceleration(i, now, at, speed);
    return springs.any() ? springs.without_turn(at, there) : there;
  };
  const auto accelerations = [&](const vector<Vec3>& at, const vector<Vec3>& speed) {
    return vector<Vec3>{acceleration(at[0], speed[0])};
  };
  const auto jacobian = [&](const Vec3& at, const Vec3& speed) { return force_jacobian(world, i, now, at, speed); };

  const Vec3 a = springs.any() ? springs.without_turn(x, whole) : whole;
  const ForceJacobian slopes = jacobian(x, v);
  const double damping = slopes.by_velocity.norm();
  const double reach = force_reach(world, i, x);
  const double longest = longest_step(reach, v, a);

  // The allowed error of a position: a share of the radius, or of a smaller distance in which forces change. It is
  // never below the rounding of positions.
  const double width = min(radius, reach);
  const double left = left_of_speed(world, i, now, x, v);
  const double place = max(share * left * width, tol::position_rounding * x.cwiseAbs().maxCoeff());

  // The allowed error of a velocity: a share of itself, of the speed gained over a width, or of that at which drag
  // balances forces. It is never below the speed of a swing as wide as a position's error or rounding, because forces
  // that balance are rounding.
  const double swing = max(share * width, 0x1p-51 * x.cwiseAbs().maxCoeff());
  const double gained = min(sqrt(a.norm() * width), a.norm() / max(damping, 0x1p-900));

  // Across a spring that is nearly at its anchor the slope is unbounded. Damping is not a swing.
  const double swings = min(sqrt(slopes.by_position.norm()), force_rate(world, i, x, v));
  const double fine = max(share * left, tol::velocity_rounding);
  const double speed = max({fine * v.norm(), fine * gained, left * swing * swings, 0x1p-900});

  // The first length to try, and its method.
  double h = next_[i] > 0 ? next_[i] : first_length(i, x, v);
  bool implicit = is_implicit(i, h, damping);
  h = min(h, longest);
  for (;;) {
    check_clock(i, h);

    PolynomialPath path;
    double error;

    if (implicit) {
      ImplicitStep motion;
      error = motion.step(h, x, v, acceleration, jacobian, place, speed);
      if (error <= 1) path = motion.path();
    } else {
      DormandPrince motion({x}, {v}, {a});
      error = motion.step(h, accelerations, place, speed);
      if (error <= 1) {
        motion.interpolate(accelerations);
        path = motion.path(0);
      }
    }

    // A step that is accurate enough is taken.
    const double next = DormandPrince::next_length(h, error);
    if (error <= 1) {
      next_.write(i) = next;
      note_method(i, implicit);
      if (const double arrival = springs.arrival(x, path); arrival < path.length) cut(path, arrival);
      return path;
    }

    if (implicit && next * damping < 0.1) implicit = false;
    h = next;
  }
}

/// The time (s) to the next multiple of the step, or to the run's end.
/// Multiples are computed and not summed up, so that a long run loses no digits.
double CurvedFlights::step_length() const {
  const double step = bodies_.options.step, duration = bodies_.options.duration;
  const Instant& now = bodies_.now;
  if (!(now.hi + step > now.hi))
    throw SimulationError(
        fmt::format("at t = {} s steps of {} s no longer advance the clock: use a longer simulate.step", now.hi, step));
  auto steps = double(whole_below(now.hi / step));
  while (!(now < Instant{steps * step, 0})) ++steps;
  const double next = steps * step;
  return Instant{next < duration || !(now.hi < duration) ? next : duration, 0} - now;
}

PolynomialPath CurvedFlights::step(Entity i, const Vec3& x, Vec3& v, bool next) {
  const Integrator method = bodies_.options.integrator;
  if (method == Integrator::dop853) return step_of_its_own(i, x, v);

  const double h = step_length();
  const auto acceleration = [&](const Vec3& at, const Vec3& speed) {
    return free_acceleration(bodies_.world, i, bodies_.now.hi, at, speed);
  };

  // The body's own velocity is without that by which the method is ahead.
  const PolynomialPath* const last = bodies_.flights.curve(i);
  Vec3 ahead = last == nullptr ? Vec3(Vec3::Zero()) : last->ahead;
  const Vec3 own = v - ahead;
  const Vec3 a = acceleration(x, own);
  if (bodies_.bent[i] || bodies_.fade[i] != 0)
    bodies_.log.note_step({h * force_rate(bodies_.world, i, x, own), h, bodies_.now.hi, i, x, own});

  if (method == Integrator::rk4) {
    const auto [bend, change] = runge_kutta(h, x, v, a, acceleration);
    return PolynomialPath::through(h, v, a, bend, change, acceleration(Vec3(x + (h * v + bend)), Vec3(v + change)));
  }
  if (next && method == Integrator::euler) {
    ahead = (0.5 * h) * a;
    v = own + ahead;
  }

  PolynomialPath path = PolynomialPath::parabola(h, v, a);
  path.ahead = ahead;
  return path;
}

double CurvedFlights::squared_speed(const Flight& flight, double length) {
  double sum = 0;
  for (const GaussPoint& node : gauss_10) sum += node.weight * flight.velocity(node.at * length).squaredNorm();
  return length * sum;
}

double CurvedFlights::book_work(Entity i, const Flight& flight, double length) {
  const World& world = bodies_.world;
  const bool joint = !bodies_.merged.parts_of(i).empty();
  double all = 0;
  for (size_t k = 0; k < world.forces.size(); ++k) {
    const Force& force = world.forces[k];
    const double start = flight.start.hi;
    if (!joint && !acts(force, i, start)) continue;

    // The mean power for each unit of mass. It is a velocity to the second or third power, which may fall by decades
    // within a step.
    double sum = 0;
    for (const GaussPoint& node : gauss_10) {
      const double t = node.at * length;
      const Vec3 v = flight.velocity(t);
      sum += node.weight * bodies_.merged.working_acceleration(force, i, start, flight.position(t), v).dot(v);
    }

    const double work = world.mass[i] * length * sum;
    if (work != 0) bodies_.log.add_work(k, work);
    all += work;
  }
  return all;
}

}  // namespace carom
