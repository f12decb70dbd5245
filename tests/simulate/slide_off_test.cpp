// Without friction a ball slides off a curved top, an edge, a rim, and flies off where the contact force vanishes.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// A centre that slides over the top of a circle of radius s (m), at speed v0 (m/s) there: v^2 = v0^2 + 2 g_n s (1 - c)
/// at the angle with cosine c; the contact acceleration g_n c - v^2 / s vanishes at c = (2 + v0^2 / (g_n s)) / 3.
struct Leaving {
  double c;     // cosine of the angle from the vertical
  double time;  // s, from the top
  double x, y;  // m, from the circle's centre
  double speed;
};

Leaving leaving(double s, double v0) {
  const double c = (2 + v0 * v0 / (g_n * s)) / 3, angle = std::acos(c);
  // t = integral of s / sqrt(v0^2 + 4 g_n s sin^2(q/2)) dq; with sin(q/2) = k sinh(z), k = v0 / sqrt(4 g_n s), smooth
  // in z.
  const double k = v0 / sqrt(4 * g_n * s), end = std::asinh(std::sin(angle / 2) / k);
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double z = end * i / n, half_sine = k * std::sinh(z);
    const double f = 2 * s * k / v0 / sqrt(1 - half_sine * half_sine);
    sum += f * (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return {c, sum * end / n / 3, s * sqrt(1 - c * c), s * c, sqrt(g_n * s * c)};
}

/// Ball 0 slides over the top at `start` (s) and leaves as expected. Shortly before, the top carries it; shortly after,
/// it is on the parabola of free flight.
void expect_leaves(const Problem& problem, const Leaving& expected, double start, const Vec3& center,
                   const string& what) {
  constexpr double late = 1e-8;  // s; measured: contacts() is right to within 5e-10

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, start + expected.time - late);
  EXPECT_EQ(simulator->contacts().size(), 1u) << what;
  go_to(*simulator, start + expected.time + late);
  EXPECT_EQ(simulator->contacts().size(), 0u) << what;

  const double sine = sqrt(1 - expected.c * expected.c), t = late;
  const Vec3 v(expected.speed * expected.c, -expected.speed * sine, 0), down(0, -g_n, 0);
  const Vec3 x = center + Vec3(expected.x, expected.y, 0) + t * v + 0.5 * t * t * down;
  const State& state = simulator->state();

  EXPECT_LT((state.position[0] - x).norm(), 2e-10) << what;              // m; measured: 1.1e-10
  EXPECT_LT((state.velocity[0] - (v + t * down)).norm(), 1e-8) << what;  // m/s; measured: 6.3e-9
  EXPECT_TRUE(simulator->collisions().empty()) << what;
}

TEST(SlideOff, ABallLeavesAFixedBallAtTwoThirdsOfTheHeight) {
  for (double v0 : {0.01, 0.1, 0.5, 1.0, 1.5}) {
    for (double e : {0.0, 0.5}) {
      Problem problem;
      problem.world.gravity = Vec3(0, -g_n, 0);
      problem.obstacle({0, 0, 0}, Volume::sphere(0.5));
      problem.ball({0, 0.75, 0}, {v0, 0, 0}, 1, 0.25, e);
      expect_leaves(problem, leaving(0.75, v0), 0, {0, 0, 0}, "ball, v0 = " + to_string(v0) + ", e = " + to_string(e));
    }
  }
}

/// Balls off fixed balls, 100 m apart along z, and a scene of another kind among them if `other`.
Problem balls_off_balls(int balls, bool other) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 0.8;

  for (int k = 0; k < balls; ++k) {
    problem.obstacle({0, 0, 100.0 * k}, Volume::sphere(0.5));
    problem.ball({0, 0.75, 100.0 * k}, {0.1, 0, 0}, 1, 0.25, 0);
  }

  if (other) {  // a heap that is too large for constrained motion, and a heavy body that slides
    problem.obstacle({1000, 0, 0}, Volume::box({5, 0.5, 5}));
    for (int k = 0; k < 27; ++k)
      problem.ball({999.0 + k % 3, 1 + 0.95 * (k / 9), k / 3 % 3 - 1.0 + 0.1 * (k / 9)}, {0, 0, 0}, 1 + k, 0.5, 0.3);
    problem.obstacle({2000, 0, 0}, Volume::sphere(5));
    problem.ball({2000, 15, 0}, {1, 0, 0}, 1e6, 10, 0);
  }

  return problem;
}

TEST(SlideOff, NeitherNumberNorWhatHappensFarAwayChangesAnyBit) {
  SLOW_WITH_SANITIZERS();
  const Outcome one = run_exact(balls_off_balls(1, false));
  for (const int balls : {2, 17, 200}) {
    for (const bool other : {false, true}) {
      const Outcome many = run_exact(balls_off_balls(balls, other));
      for (int k = 0; k < balls; ++k) {
        const auto i = static_cast<size_t>(k);
        EXPECT_EQ(many.end.position[i].head<2>(), one.end.position[0].head<2>()) << balls << ' ' << other << ' ' << k;
        EXPECT_EQ(many.end.velocity[i], one.end.velocity[0]) << balls << ' ' << other << ' ' << k;
      }
    }
  }
}

TEST(SlideOff, AFastBallLeavesTheTopAtOnce) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.obstacle({0, 0, 0}, Volume::sphere(0.5));
  problem.ball({0, 0.75, 0}, {2.75, 0, 0}, 1, 0.25, 0);  // v0^2 > g_n s
  problem.options.duration = 1;
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.all.empty());
  EXPECT_LT((run.end.position[0] - Vec3(2.75, 0.75 - g_n / 2, 0)).norm(), 1e-15);
}

/// A ball on a level top that ends at x = 1, 0.25 m under its centre.
Problem on_a_table(bool wall, double v0, double e) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  if (wall)
    problem.wall({0, 0, 0}, {0, 1, 0}, 2, 2, {0, 0, 1});
  else
    problem.obstacle({0, -0.5, 0}, Volume::box({2, 1, 2}));
  problem.ball({0.5, 0.25, 0.125}, {v0, 0, 0}, 1, 0.25, e);
  problem.options.duration = 10;
  return problem;
}

TEST(SlideOff, AFastBallFliesOffATablesEdgeAsAParabola) {
  for (bool wall : {false, true}) {
    for (double e : {0.0, 0.5}) {
      Problem problem = on_a_table(wall, 2, e);  // v0^2 > g_n r
      problem.options.duration = 1.25;
      const Outcome run = run_exact(problem);
      EXPECT_TRUE(run.collisions.empty());
      EXPECT_LT((run.end.position[0] - Vec3(3, 0.25 - g_n / 2, 0.125)).norm(), 2e-15) << wall << e;
    }
  }
}

TEST(SlideOff, ASlowBallTurnsAboutATablesEdgeAndLeavesByTheSameRule) {
  for (bool wall : {false, true})
    for (double v0 : {0.1, 0.5, 1.0})
      expect_leaves(on_a_table(wall, v0, 0), leaving(0.25, v0), 0.5 / v0, {1, 0, 0.125},
                    (wall ? "wall, v0 = " : "box, v0 = ") + to_string(v0));
}

TEST(SlideOff, ACylinderFallsOffABoxWithItsCentrePastTheEdgeAndAll) {
  // A flat bottom is carried to its last point: the cylinder leaves when its rim is past the edge.
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.obstacle({0, -0.5, 0}, Volume::box({2, 1, 2}));
  problem.body(Volume::cylinder(0.25, 0.5), {0, 0.25, 0}, {1, 0, 0}, 1, 0);
  problem.options.duration = 2.25;
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_LT((run.end.position[0] - Vec3(2.25, 0.25 - g_n / 2, 0)).norm(), 2e-15);
}

TEST(SlideOff, ABoxFallsOffAMovingBoxAtTheTimeOfTheirRelativeMotion) {
  // Frictionless: the lower box slides on under the upper one, which stays behind in place and then falls.
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.body(Volume::box({2, 0.5, 1}), {0, 0.25, 0}, {2, 0, 0}, 4, 0);
  problem.body(Volume::box({1, 0.5, 1}), {0, 0.75, 0}, {0, 0, 0}, 1, 0);
  problem.options.duration = 5;
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.collisions.size(), 1u);
  const double past = 1.5 / 2, fall = sqrt(2 * 0.5 / g_n);
  EXPECT_NEAR(run.collisions[0].time, past + fall, 1e-9);  // measured: 4.4e-10, for a gap of 1e-10 radii
  EXPECT_LT((run.end.velocity[0] - Vec3(2, 0, 0)).norm(), 1e-15);
  EXPECT_LT((run.end.position[1] - Vec3(0, 0.25, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace carom
