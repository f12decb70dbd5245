#include "simulate/curved_flights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/dormand_prince.h"
#include "physics/force.h"
#include "physics/integrator.h"
#include "physics/whole.h"
#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// Gauss's rule of five points on [0, 1], exact to degree 9.
struct GaussPoint {
  double at, weight;
};
constexpr GaussPoint gauss[] = {{0.04691007703066800, 0.11846344252809454},
                                {0.23076534494715845, 0.23931433524968324},
                                {0.5, 0.28444444444444444},
                                {0.76923465505284155, 0.23931433524968324},
                                {0.95308992296933200, 0.11846344252809454}};

}  // namespace

/// s: by how fast forces change, or how fast the body moves by its size.
double CurvedFlights::first_length(Entity i, const Vec3& x, const Vec3& v) const {
  const World& world = bodies_.world;
  const double rate = force_rate(world, i, x, v);
  const double fall = std::sqrt(world.radius[i] / std::max(bodies_.force_at(i, x, v).norm(), 0x1p-900));
  return rate > 0 ? tol::first_step / rate : tol::first_step * fall;
}

PolynomialPath CurvedFlights::step_of_its_own(Entity i, const Vec3& x, const Vec3& v) {
  const World& world = bodies_.world;
  const double now = bodies_.now.hi, radius = world.radius[i];
  const auto acceleration = [&](const std::vector<Vec3>& at, const std::vector<Vec3>& speed) {
    return std::vector<Vec3>{free_acceleration(world, i, now, at[0], speed[0])};
  };
  const Vec3 a = free_acceleration(world, i, now, x, v);
  DormandPrince motion({x}, {v}, {a});
  // A step's error, and no less than what rounding makes of a place.
  const double place = std::max(tol::step_error * radius, tol::position_rounding * x.cwiseAbs().maxCoeff());
  const double speed =
      std::max({v.norm(), std::sqrt(a.norm() * radius), radius * force_rate(world, i, x, v), 0x1p-900});
  double h = next_[i] > 0 ? next_[i] : first_length(i, x, v);
  h = std::min({h, bodies_.options.step, std::max(2 * (bodies_.options.duration - now), tol::clock_rounding * now)});
  for (;;) {
    if (!(now + h > now))
      throw SimulationError(fmt::format("at t = {} s the forces on ", now), i,
                            " change faster than the clock can tell: soften what attracts, or weaken a stiff force");
    const double error = motion.step(h, acceleration, place, tol::step_error * speed);
    const double next = DormandPrince::next_length(h, error);
    if (error <= 1) {
      next_.write(i) = next;
      break;
    }
    h = next;
  }
  motion.interpolate(acceleration);
  return motion.path(0);
}

/// s: to the next multiple of the step, or the run's end. Multiples are computed, not summed up, so that a long run
/// loses no digits.
double CurvedFlights::step_length() const {
  const double step = bodies_.options.step, duration = bodies_.options.duration;
  const Instant& now = bodies_.now;
  if (!(now.hi + step > now.hi))
    throw SimulationError(
        fmt::format("at t = {} s steps of {} s no longer move the clock: use a longer simulate.step", now.hi, step));
  auto steps = static_cast<double>(whole_below(now.hi / step));
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
  const PolynomialPath* const last = bodies_.flights.curve(i);
  Vec3 ahead = last == nullptr ? Vec3(Vec3::Zero()) : last->ahead;
  const Vec3 own = v - ahead, a = acceleration(x, own);
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

double CurvedFlights::work(Entity i, const Flight& flight, double length) const {
  double sum = 0;
  for (const GaussPoint& node : gauss) {
    const double t = node.at * length;
    const Vec3 x = flight.position(t), v = flight.velocity(t);
    sum += node.weight * working_acceleration(bodies_.world, i, flight.start.hi, x, v).dot(v);
  }
  return sum * length;
}

}  // namespace carom
