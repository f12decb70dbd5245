// Long runs lose nothing but rounding.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

/// Position of a point that moves back and forth between low and high without loss: the straight path, folded. Long
/// doubles keep 1e5 m to 5e-15 m.
long double folded(long double low, long double high, long double x, long double v, long double t) {
  const long double width = high - low;
  long double way = std::fmod(x - low + v * t, 2 * width);
  if (way < 0) way += 2 * width;
  return low + (way <= width ? way : 2 * width - way);
}

// The set-up of references/clock.json: 3.9 impacts a second for 1e5 s. There one double as clock loses 8.8e-7 m, a
// clock of two doubles 1.1e-9 m.
TEST(Clock, ABallInABoxIsOnItsPathAfterADay) {
  Problem problem;
  const Vec3 max(1, 1.1, 0.9), x(0.3, 0.4, 0.55), v(1.1, 0.9723, -1.0391);
  const double r = 0.1;

  problem.room({0, 0, 0}, max);
  problem.ball(x, v, 1, r, 1);
  problem.options.duration = 1e5;
  problem.options.record_collisions = false;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  double worst = 0;
  for (double t = 1; t <= 1e5; t *= 10) {
    go_to(*simulator, t);
    for (int k = 0; k < 3; ++k) {
      const long double expected = folded(r, static_cast<long double>(max[k]) - r, x[k], v[k], t);
      worst = std::max(worst, static_cast<double>(std::abs(simulator->state().position[0][k] - expected)));
    }
    EXPECT_LT(worst, 1e-13 * t) << t;
  }

  EXPECT_NEAR(static_cast<double>(simulator->tally().body_fixed), 3.9e5, 0.2e5);
  EXPECT_LT(worst, 1e-11);  // m; measured: 4.5e-12 after 393,976 impacts
}

TEST(Clock, AMillionSecondsAreKeptToo) {
  Problem problem;
  problem.room({0, 0, 0}, {100, 100, 100});
  const Vec3 x(30, 40, 50), v(1.1, 0.7, -0.3);
  problem.ball(x, v, 1, 0.1, 1);
  problem.options.duration = 1e6;

  const Outcome run = run_exact(problem);
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const long double expected = folded(0.1, 100 - static_cast<long double>(0.1), x[k], v[k], 1e6L);
    worst = std::max(worst, static_cast<double>(std::abs(run.end.position[0][k] - expected)));
  }

  EXPECT_LT(worst, 2e-10);  // m; measured: 1.0e-10, what 99.9 m is rounded to, 11,000 times
}

/// The distance of balls from their starts (m, in diameters), at reduced density 0.3. They run for so many collisions a
/// ball, reverse, and run as long again.
double way_off_after_reversal(double collisions_a_ball, uint64_t seed) {
  Random random(seed);
  Problem problem;
  const double side = std::cbrt(125 / 0.3);  // m; diameter 1 m
  problem.room({0, 0, 0}, Vec3::Constant(side));

  for (int i = 0; i < 125; ++i) {
    const Vec3 cell(i % 5, i / 5 % 5, i / 25);
    const Vec3 shift(random(-0.2, 0.2), random(-0.2, 0.2), random(-0.2, 0.2));
    const Vec3 v(random(-1, 1), random(-1, 1), random(-1, 1));
    problem.ball((cell + Vec3::Constant(0.5)) * (side / 5) + shift, v, 1, 0.5, 1);
  }

  problem.options.duration = 1000;
  const auto there = make_exact_simulator(problem.world, problem.initial, problem.options);
  double time = 0;
  while (static_cast<double>(there->tally().body_body) * 2 / 125 < collisions_a_ball) go_to(*there, time += 1.0 / 64);

  // Back again.
  Problem turned = problem;
  turned.initial = there->state();
  turned.initial.time = 0;
  for (Vec3& v : turned.initial.velocity) v = -v;
  turned.options.duration = time;
  const State back = run_exact(turned).end;

  double worst = 0;
  for (size_t i = 0; i < 125; ++i) worst = std::max(worst, (back.position[i] - problem.initial.position[i]).norm());
  return worst;
}

TEST(Reversal, AGasReturnsToItsStartAfterEightCollisionsABall) {
  for (uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(way_off_after_reversal(8, seed), 2e-10) << seed;  // diameters; measured: 1.0e-11 to 6.3e-11
}

// A row that falls 1e9 m. With a new search of neighbours every few radii it would not end in an hour.
TEST(FreeFall, ACloseGroupFallsFarAtOnce) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.80665, 0);
  for (int i = 0; i < 12; ++i) problem.ball({0.25 * i, 0, 0}, {0, 0, 0}, 1, 0.125, 0.9);
  problem.options.duration = 14280;
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.all.empty());
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(run.end.position[i].x(), 0.25 * static_cast<double>(i));
    EXPECT_NEAR(run.end.position[i].y() / (-0.5 * 9.80665 * 14280 * 14280), 1, 1e-15);
  }
}

}  // namespace
}  // namespace carom
