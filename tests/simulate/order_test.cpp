// How fast errors fall as steps get shorter: impacts inside steps keep the order of each method.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/exact.h"
#include "simulate/references.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

constexpr Integrator methods[] = {Integrator::euler, Integrator::verlet, Integrator::rk4};
constexpr double orders[] = {1, 2, 4};
constexpr const char* names[] = {"euler", "verlet", "rk4"};

struct KnownEnd {
  Vec3 x, v;
};

KnownEnd run(const Problem& problem, Integrator method, double step) {
  ExactOptions options;
  options.duration = problem.options.duration;
  options.step = step;
  options.integrator = method;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, options);
  const Outcome outcome = run_to_end(*simulator, options.duration);
  return {outcome.end.position[0], outcome.end.velocity[0]};
}

///
/// dx
///  and
/// dv
///  together, in units of 1 m and 1 m/s. It is the geometric mean over twelve numbers of steps, so that impacts fall on
/// all parts of a step.
double error(const Problem& problem, Integrator method, double steps, const KnownEnd& known_end) {
  double sum = 0;
  constexpr int numbers = 12;
  for (int k = 0; k < numbers; ++k) {
    const double n = std::round((1 + 0.017 * k) * steps);
    const KnownEnd got = run(problem, method, problem.options.duration / n);
    sum += log((got.x - known_end.x).norm() + (got.v - known_end.v).norm());
  }
  return std::exp(sum / numbers);
}

/// The slope of log error over log step, fitted through all.
double fitted_order(const Problem& problem, Integrator method, const vector<double>& steps, const KnownEnd& known_end) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const double n : steps) {
    const double x = -log(n), y = log(error(problem, method, n, known_end));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto count = static_cast<double>(steps.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

void expect_orders(const Problem& problem, const KnownEnd& known_end, double first, const char* measured) {
  for (int m = 0; m < 3; ++m) {
    const vector<double> steps = {first, 2 * first, 4 * first, 8 * first};
    const double order = fitted_order(problem, methods[m], steps, known_end);
    EXPECT_GT(order, orders[m] - 0.15) << names[m] << "; measured: " << measured;
    // Impacts may reverse the velocity error of Euler's method, which then cancels.
    if (m > 0) {
      EXPECT_LT(order, orders[m] + 0.15) << names[m];
    }
    ::testing::Test::RecordProperty(names[m], to_string(order));
  }
}

/// An oscillator that strikes a wall: x'' = -w^2 x for x >= wall, speed times e at each impact.
KnownEnd impact_oscillator(double w, double wall, double e, double x, double time) {
  double amplitude = x, phase = 0, t = 0;  // x = amplitude cos(w (t - t0) + phase)
  for (;;) {
    const double down = std::acos(wall / amplitude);  // the phase at the wall
    const double until = t + (down - phase) / w;
    if (until > time) {
      const double now = phase + w * (time - t);
      return {{amplitude * std::cos(now), 0, 0}, {-amplitude * w * std::sin(now), 0, 0}};
    }

    const double speed = e * amplitude * w * std::sin(down);
    t = until;
    amplitude = sqrt(wall * wall + speed / w * speed / w);
    phase = -std::acos(wall / amplitude);
  }
}

TEST(Order, IsTheMethodsForAnOscillatorThatStrikesAWall) {
  SLOW_WITH_SANITIZERS();
  Problem problem;
  problem.ball({1, 0, 0}, {0, 0, 0}, 2, 0.1, 0.9);
  problem.plane({-0.6, 0, 0}, {1, 0, 0});
  problem.world.forces = {{Spring{Vec3::Zero(), 8, 0, 0}}};
  problem.options.duration = 11;
  expect_orders(problem, impact_oscillator(2, -0.5, 0.9, 1, 11), 800, "0.99, 2.00, 4.04");
}

/// Linear drag: v = vt + (v0 - vt) exp(-k t), on a floor at 0, from rest at height h.
KnownEnd drag_bounce(double k, double g, double e, double h, const vector<double>& impacts, double time) {
  double y = h, v = 0, t = 0;
  const double vt = -g / k;

  const auto fly = [&](double length) {
    const double fade = std::exp(-k * length);
    y += vt * length + (v - vt) * (1 - fade) / k;
    v = vt + (v - vt) * fade;
  };

  for (const double impact : impacts) {
    if (impact > time) break;
    fly(impact - t);
    t = impact;
    y = 0;
    v *= -e;
  }

  fly(time - t);
  return {{0, y, 0}, {0, v, 0}};
}

TEST(Order, IsTheMethodsForABallThatBouncesInAThickMedium) {
  SLOW_WITH_SANITIZERS();
  const nlohmann::json reference = carom::reference("forces")["linear_drag_bounce"];
  const nlohmann::json& bounce = reference["cases"][1];
  Problem problem;
  const double mass = 3, k = bounce["k"], e = bounce["e"], h = bounce["h"], g = reference["g"];

  problem.world.gravity = {0, -g, 0};
  problem.ball({0, h + 0.25, 0}, {0, 0, 0}, mass, 0.25, e);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.world.forces = {{Drag{k * mass, 0, Vec3::Zero()}}};
  problem.options.duration = 2.2;  // between the third and the fourth impact

  vector<double> impacts;
  for (int n = 0; n < 3; ++n) impacts.push_back(bounce["impacts"][n]["t"]);

  KnownEnd known_end = drag_bounce(k, g, e, h, impacts, 2.2);
  known_end.x.y() += 0.25;
  expect_orders(problem, known_end, 100, "1.01, 2.00, 4.03");
}

/// The finest run is the reference: steps 64 times shorter.
KnownEnd finest(const Problem& problem, double steps) {
  return run(problem, Integrator::rk4, problem.options.duration / (64 * steps));
}

TEST(Order, IsTheMethodsForABallOnADampedSpringAmongWalls) {
  SLOW_WITH_SANITIZERS();
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.ball({0.8, 0.6, 0.1}, {0.5, 1, -0.7}, 0.7, 0.15, 0.8);
  problem.room({-1, -1, -1}, {1.2, 1.1, 1.3});
  problem.world.forces = {{Spring{{0.1, 0.2, 0.3}, 40, 0.4, 0.3}}};
  problem.options.duration = 2.03;
  expect_orders(problem, finest(problem, 3200), 400, "1.0, 2.0, 4.0");
}

TEST(Order, IsTheMethodsForTwoBallsThatMeetInTheWind) {
  SLOW_WITH_SANITIZERS();
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.ball({-1, 0.5, 0}, {3, 2, 0.1}, 0.4, 0.2, 0.7);
  problem.ball({1, 0.45, 0.05}, {-2, 2.5, -0.1}, 0.9, 0.25, 0.7);
  problem.plane({0, -0.6, 0}, {0, 1, 0.1});
  problem.world.forces = {{Drag{0.2, 0.15, {1, 0.3, -2}}}, {Attractor{{0, 1, 3}, 5, 0.1}}};
  problem.options.duration = 1.1;
  expect_orders(problem, finest(problem, 1600), 200, "1.0, 2.0, 4.0");
}

}  // namespace
}  // namespace carom
