// Orbits and oscillations of the exact engine: free, and with impacts that have closed forms too.
#include <gtest/gtest.h>

#include <complex>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/long_kepler.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// A ball about an attractor at `center`.
Problem orbit(double mu, const Vec3& center, const Vec3& x, const Vec3& v, double radius) {
  Problem problem;
  problem.ball(center + x, v, 1, radius);
  problem.world.gravity = Vec3::Zero();
  problem.world.forces = {{Attractor{center, mu, 0}}};
  return problem;
}

/// m: how far it is off at some times of `duration` (s). Where `mirror` is set, a plane through the centre, across y,
/// throws the ball back: its path is the free one's mirror image.
double worst(const Problem& given, double mu, double duration, bool mirror) {
  Problem problem = given;
  const Vec3 center = std::get<Attractor>(problem.world.forces[0].law).center;
  if (mirror) problem.plane(center - Vec3(0, problem.world.radius[0], 0), {0, 1, 0});

  const LongKepler kepler(mu, given.initial.position[0] - center, given.initial.velocity[0]);
  problem.options.duration = duration;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

  double most = 0;
  for (int k = 1; k <= 50; ++k) {
    const double t = k == 50 ? duration : duration * (k - 0.381966) / 50;
    go_to(*simulator, t);
    Vec3 there = kepler.at(t);
    if (mirror) there.y() = std::abs(there.y());
    most = std::max(most, (simulator->state().position[0] - center - there).norm());
  }

  EXPECT_TRUE(!mirror || simulator->tally().collisions() > 0);
  return most;
}

TEST(ClosedFlights, OfAHundredRevolutionsAreKeplers) {
  SLOW_WITH_SANITIZERS();
  for (const double e : {0.0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
    const Vec3 x(1 + e, 0, 0), v(0, sqrt((1 - e) / (1 + e)), 0);  // a = 1, from the far end
    const double duration = 100 * 2 * M_PI;
    // Effect of an error in the last digit on the period, at the greatest speed.
    const double bound = 4e-16 * 3 * duration * sqrt((1 + e) / (1 - e));
    EXPECT_LT(worst(orbit(1, {0, 0, 0}, x, v, 1e-5), 1, duration, false), bound) << e;
    EXPECT_LT(worst(orbit(1, {0, 0, 0}, x, v, 1e-5), 1, duration, true), 10 * bound) << e;
    EXPECT_LT(worst(orbit(1, {3, -2, 1}, x, v, 1e-5), 1, duration, false), 10 * bound) << e;  // rounded off the centre
  }
}

// The greatest speed lies between the ends of steps. measured: 3e-14
TEST(ClosedFlights, AreFastestAtThePericentre) {
  for (const double e : {0.3, 0.9, 0.99, 0.9999}) {
    const double fastest = sqrt((1 + e) / (1 - e));
    Problem problem = orbit(1, {0, 0, 0}, {1 + e, 0, 0}, {0, 1 / fastest, 0}, 1e-5);
    problem.options.duration = 6;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    go_to(*simulator, 6);
    EXPECT_NEAR(simulator->tally().fastest.speed / fastest, 1, 1e-12) << e;
  }
}

TEST(ClosedFlights, PastACentreAreHyperbolas) {
  for (const double b : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8})
    for (const double mu : {1.0, 1e-4})
      for (const double speed : {0.5, 1.0, 10.0}) {
        const Problem problem = orbit(mu, {0, 0, 0}, {-10, b, 0}, {speed, 0, 0}, 1e-9);
        EXPECT_LT(worst(problem, mu, 30 / speed, false), 1e-12) << b << ", " << mu << ", " << speed;
      }
}

TEST(ClosedFlights, OfABallThatFallsInEndWithARemedy) {
  const Problem problem = orbit(1, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, 0.01);
  ExactOptions options;
  options.duration = 5;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, options);
  EXPECT_THROW(go_to(*simulator, 5), SimulationError);
}

TEST(ClosedFlights, OntoAPlanetBounceThere) {
  Problem problem = orbit(1, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, 0.01);
  problem.world.obstacles.push_back({Vec3::Zero(), Volume::sphere(0.2), 1.0});
  problem.options.duration = 100;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 100);
  const State& state = simulator->state();
  EXPECT_NEAR(energy(problem, state), -1, 1e-11);
  EXPECT_EQ(state.position[0].y(), 0);
  EXPECT_GT(simulator->tally().collisions(), 40u);
}

/// A ball on a spring in a medium, off its equilibrium by Vec3(1, 0.3, 0).
Problem swing(double stiffness, double drag, double radius) {
  Problem problem;
  problem.ball({1, 0.3, 0}, {0, 0, 0.5}, 2, radius);
  problem.world.gravity = Vec3(0, -9.80665, 0);
  problem.world.forces = {{Spring{{0, 9.80665 * 2 / stiffness, 0}, stiffness, 0, 0}}};
  if (drag > 0) problem.world.forces.push_back({Drag{drag, 0, Vec3::Zero()}});
  return problem;
}

TEST(ClosedFlights, OnASpringAreSines) {
  for (const double stiffness : {1e-2, 1.0, 1e2, 1e5}) {
    Problem problem = swing(stiffness, 0, 0.01);
    problem.options.duration = 1000 / sqrt(stiffness);
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    for (int k = 1; k <= 20; ++k) {
      const double t = problem.options.duration * k / 20;
      go_to(*simulator, t);
      const long double w = sqrt(stiffness / 2.0L), c = std::cos(w * t), s = std::sin(w * t);
      const Vec3 there(static_cast<double>(c), static_cast<double>(0.3L * c), static_cast<double>(0.5L / w * s));
      EXPECT_LT((simulator->state().position[0] - there).norm(), 2e-12 * (1 + 0.5 / static_cast<double>(w)))
          << stiffness << " " << t;
    }
  }
}

TEST(ClosedFlights, OfStiffSpringsInAnyMediumTakeFewSteps) {
  for (const double stiffness : {1e-4, 1.0, 1e4, 1e8, 1e12})
    for (const double drag : {1e-2, 1.0, 1e2, 1e5, 1e8, 1e12}) {
      if (stiffness > drag * drag * 1e3) continue;  // that many turns
      Problem problem = swing(stiffness, drag, 0.01);
      problem.options.duration = 1;
      const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
      go_to(*simulator, 1);
      EXPECT_LT(simulator->effort().events, 2000u) << stiffness << ", " << drag;
      // x'' + 2 d x' + w^2 x = 0.
      using Complex = std::complex<long double>;
      const long double d = drag / 4.0L, w2 = stiffness / 2.0L;
      const Complex root = sqrt(Complex(d * d - w2)), p = -(w2 / (d + root)), q = -(d + root);
      const auto x = [&](long double x0, long double v0) {
        if (std::abs(root) < 1e-9L * d) return std::exp(-d) * (x0 + v0 + d * x0);
        return ((v0 - q * x0) / (p - q) * std::exp(p) - (v0 - p * x0) / (p - q) * std::exp(q)).real();
      };
      const Vec3 there(static_cast<double>(x(1, 0)), static_cast<double>(x(0.3L, 0)), static_cast<double>(x(0, 0.5L)));
      EXPECT_LT((simulator->state().position[0] - there).norm(), 1e-12) << stiffness << ", " << drag;
    }
}

/// A plane through the equilibrium throws the ball back: its path is the free one's mirror image.
TEST(ClosedFlights, OnASpringBounceExactly) {
  Problem problem = swing(100, 0, 0.01);
  problem.plane({-0.01, 0, 0}, {1, 0, 0});
  problem.options.duration = 100;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 100);
  const long double w = sqrt(50.0L);
  EXPECT_NEAR(simulator->state().position[0].x(), static_cast<double>(std::abs(std::cos(w * 100))), 1e-11);
  EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-10);
  EXPECT_EQ(simulator->tally().collisions(), 225u);
}

TEST(ClosedFlights, ChangeWithWindowsOfForces) {
  Problem problem = orbit(1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.01);  // a circle
  problem.world.forces[0].until = M_PI_2;
  problem.options.duration = 3;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 3);
  EXPECT_LT((simulator->state().position[0] - Vec3(-(3 - M_PI_2), 1, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace carom
