// Strings and rods against closed forms: pendulums, impacts on them, chains, cradles.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/polynomial.h"
#include "physics/force_law.h"
#include "simulate/build.h"

namespace carom {
namespace {

struct Tied : Problem {
  Tied() { world.gravity = Vec3(0, -g_n, 0); }
  String& anchored(Entity body, const Vec3& anchor, double length) {
    world.strings.push_back({body, no_entity, anchor, length});
    return world.strings.back();
  }
  String& between(Entity body, Entity other, double length) {
    world.strings.push_back({body, other, Vec3::Zero(), length});
    return world.strings.back();
  }
};

/// The period of a pendulum (s) that swings out to `angle` (rad), by the arithmetic-geometric mean.
double period(double length, double angle) {
  double a = 1, b = std::cos(angle / 2);
  for (int k = 0; k < 8; ++k) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * M_PI * std::sqrt(length / g_n) / a;
}

Tied pendulum(double angle, double length, bool rod = false) {
  Tied problem;
  const Vec3 x(length * std::sin(angle), -length * std::cos(angle), 0);
  const Entity bob = problem.ball(x, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, x.norm()).rod = rod;
  return problem;
}

TEST(Strings, APendulumReturnsAfterThePeriodOfTheEllipticIntegral) {
  for (const bool rod : {false, true})
    for (const double angle : {0.01, 0.7, 1.5, M_PI / 2}) {
      Tied problem = pendulum(angle, 1.25, rod);
      const double length = problem.world.strings[0].length, whole = period(length, angle);
      problem.options.duration = 10 * whole;
      const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
      for (int k = 1; k <= 10; ++k) {
        go_to(*simulator, k * whole);
        const State& state = simulator->state();
        EXPECT_LT((state.position[0] - problem.initial.position[0]).norm(), 1e-12 * k) << angle << " " << k;
        EXPECT_LT(state.velocity[0].norm(), 1e-11 * k) << angle << " " << k;
      }
      EXPECT_EQ(simulator->tally().collisions(), 0u);
      EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-11);
    }
}

TEST(Strings, ASlackStringHoldsNothingAndGoesTautAtTheTimeOfTheClosedForm) {
  // Falls by h, until the string of length L is straight; e = 0: hangs.
  Tied problem;
  const Entity bob = problem.ball({0.3, 0, 0.4}, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, 1.3);
  problem.options.duration = 1;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  const Collision& taut = run.collisions[0];
  const double drop = std::sqrt(1.3 * 1.3 - 0.25), at = std::sqrt(2 * drop / g_n), v = g_n * at;
  EXPECT_EQ(taut.kind, CollisionKind::string);
  EXPECT_NEAR(taut.time, at, 1e-15);
  EXPECT_NEAR(taut.approach_speed, v * drop / 1.3, 1e-14);
  EXPECT_EQ(taut.separation_speed, 0);
  EXPECT_NEAR(taut.impulse, 2 * v * drop / 1.3, 1e-14);
  EXPECT_NEAR(taut.energy_lost, std::pow(v * drop / 1.3, 2), 1e-13);
  EXPECT_LT((taut.normal - Vec3(0.3, -drop, 0.4) / 1.3).norm(), 1e-15);
  EXPECT_NEAR(run.end.position[0].norm(), 1.3, 1e-12);
  EXPECT_NEAR(residual(problem, run), 0, 1e-11);
}

TEST(Strings, ABallInASlackSphereOfStringBouncesByItsRestitution) {
  Tied problem;
  problem.world.gravity.setZero();
  const Entity bob = problem.ball({0.6, 0, 0}, {0, 2, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, 1).restitution = 1;
  problem.options.duration = 0.4 + 10 * 0.8;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.collisions.size(), 11u);
  EXPECT_NEAR(run.end.velocity[0].norm(), 2, 1e-14);
  EXPECT_NEAR(run.end.position[0].norm(), 1, 1e-13);
  for (std::size_t k = 0; k < run.collisions.size(); ++k) EXPECT_NEAR(run.collisions[k].time, 0.4 + 0.8 * static_cast<double>(k), 1e-13);
}

TEST(Strings, AHangingBallSleeps) {
  Tied problem;
  const Entity bob = problem.ball({0.1, -1, 0}, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0.1, 0.5, 0}, 1.5);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 10);
  EXPECT_EQ(simulator->state().position[0], problem.initial.position[0]);
  EXPECT_TRUE(simulator->state().velocity[0].isZero(0));
  EXPECT_LT(simulator->effort().events, 10u);
  ASSERT_EQ(simulator->contacts().size(), 1u);
  EXPECT_NEAR(simulator->contacts()[0].force, 2 * g_n, 1e-14);
}

TEST(Strings, ALargeSwingGoesSlackAndTautAgainAtTheClosedForms) {
  // From the lowest point at speed v, with 2 g L < v^2 < 5 g L: the string goes slack at the angle a above the
  // horizontal with sin a = (v^2 - 2 g L) / (3 g L). The speed is then w with w^2 = g L sin a, and the parabola meets
  // the circle again after t = 4 w cos a / g.
  Tied problem;
  const double length = 0.8, v2 = 3.5 * g_n * length;
  const Entity bob = problem.ball({0, -length, 0}, {std::sqrt(v2), 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, length);
  problem.options.duration = 2;
  const double sine = (v2 - 2 * g_n * length) / (3 * g_n * length), cosine = std::sqrt(1 - sine * sine);
  const double w = std::sqrt(g_n * length * sine), flight = 4 * w * cosine / g_n;
  const Vec3 slack = length * Vec3(cosine, sine, 0), u = w * Vec3(-sine, cosine, 0);
  const Vec3 again = slack + flight * u + Vec3(0, -0.5 * g_n * flight * flight, 0);
  EXPECT_NEAR(again.norm(), length, 1e-15);
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.collisions.size(), 1u);
  const Collision& taut = run.collisions[0];
  EXPECT_LT((taut.position - again).norm(), 1e-12);
  const Vec3 speed = u + Vec3(0, -g_n * flight, 0);
  EXPECT_NEAR(taut.approach_speed, speed.dot(again) / length, 1e-11);
  EXPECT_NEAR(residual(problem, run), 0, 1e-10);
  // The time of the swing up to there, by quadrature of the pendulum's equation.
  const double angle = M_PI / 2 + std::asin(sine);
  double swing = 0;
  const int n = 4000;
  for (int k = 0; k <= n; ++k) {
    const double a = angle * k / n, speed2 = v2 - 2 * g_n * length * (1 - std::cos(a));
    swing += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * length / std::sqrt(speed2);
  }
  swing *= angle / n / 3;
  EXPECT_NEAR(taut.time, swing + flight, 1e-12);
}

}  // namespace
}  // namespace carom
