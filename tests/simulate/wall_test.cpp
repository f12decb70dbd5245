// Finite walls: faces, edges, corners, sliding over the rim.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

Problem at_wall(const Vec3& x, const Vec3& v) {  // a wall 2 wide, 2 high, across the x axis
  Problem problem;
  problem.wall({0, 0, 0}, {1, 0, 0}, 2, 2);
  problem.ball(x, v);
  return problem;
}

TEST(Wall, BothFacesReflect) {
  for (double side : {1.0, -1.0}) {
    const Outcome run = run_exact(at_wall({3 * side, 0.2, 0.3}, {-side, 0, 0}));
    ASSERT_EQ(run.collisions.size(), 1u);
    EXPECT_EQ(run.collisions[0].time, 2.5);
    EXPECT_EQ(run.collisions[0].normal, Vec3(-side, 0, 0));
    EXPECT_EQ(run.end.velocity[0], Vec3(side, 0, 0));
  }
}

TEST(Wall, AnEdgeHasTheNormalOfItsPoint) {
  // Height of the edge 1; the centre passes at 1.3: contact where x = sqrt(0.25 - 0.09) = 0.4.
  const Outcome run = run_exact(at_wall({3, 1.3, 0}, {-1, 0, 0}));
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, 2.6, 1e-15);
  EXPECT_LT((run.collisions[0].normal - Vec3(-0.8, -0.6, 0)).norm(), 4e-15);
  EXPECT_LT((run.collisions[0].position - Vec3(0, 1, 0)).norm(), 4e-15);
  EXPECT_LT((run.end.velocity[0] - Vec3(-1 + 2 * 0.64, 2 * 0.48, 0)).norm(), 4e-15);
}

TEST(Wall, ACornerHasTheNormalOfItsPoint) {
  // The centre passes the corner (0, 1, 1) at (0.2, 0.2) beside it: x = sqrt(0.25 - 0.08).
  const Outcome run = run_exact(at_wall({3, 1.2, 1.2}, {-1, 0, 0}));
  ASSERT_EQ(run.collisions.size(), 1u);
  const double x = sqrt(0.25 - 0.08);
  EXPECT_NEAR(run.collisions[0].time, 3 - x, 1e-15);
  EXPECT_LT((run.collisions[0].normal + Vec3(x, 0.2, 0.2) / 0.5).norm(), 4e-15);
}

TEST(Wall, BallsThatPassOverAndAroundDoNotTouch) {
  EXPECT_TRUE(run_exact(at_wall({3, 1.51, 0}, {-1, 0, 0})).collisions.empty());
  EXPECT_TRUE(run_exact(at_wall({3, 0, -1.51}, {-1, 0, 0})).collisions.empty());
  EXPECT_TRUE(run_exact(at_wall({3, 1.4, 1.4}, {-1, 0, 0})).collisions.empty()) << "corner distance 0.566 > 0.5";
}

// However a ball comes, it meets the wall where its distance to the rectangle first falls to the radius: a dense march
// along the same parabola finds the same time, and no contact where there is none.
TEST(Wall, EveryParabolaMeetsTheRectangleWhereADenseMarchDoes) {
  SLOW_WITH_SANITIZERS();
  uint64_t seed = 1;
  const auto uniform = [&](double low, double high) {
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    return low + (high - low) * static_cast<double>(seed >> 11) * 0x1p-53;
  };

  int hits = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Problem problem;

    problem.world.gravity = Vec3(0, trial % 3 == 0 ? 0.0 : -uniform(0.1, 20), 0);
    const Vec3 normal(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    problem.wall({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}, normal, uniform(0.2, 3), uniform(0.2, 3),
                 {0.3, 1, -0.2});

    const double radius = uniform(0.05, 0.6);
    const Vec3 x(uniform(-3, 3), uniform(-3, 3), uniform(-3, 3));
    const Vec3 v = Vec3(uniform(-2, 2), uniform(-2, 2), uniform(-2, 2)) - x;
    problem.ball(x, v, 1, radius);

    const Wall& wall = problem.world.walls[0];
    const auto distance = [&](double t) {
      const Vec3 p = x + t * v + 0.5 * t * t * problem.world.gravity - wall.center;
      const double u = std::max(std::abs(p.dot(wall.right)) - wall.half_width, 0.0);
      const double w = std::max(std::abs(p.dot(wall.up)) - wall.half_height, 0.0);
      return sqrt(u * u + w * w + pow(p.dot(wall.normal), 2));
    };

    if (distance(0) < radius) continue;
    // The march.
    problem.options.duration = 3;
    double march = -1;
    for (int step = 1; step <= 30000 && march < 0; ++step)
      if (distance(step * 1e-4) < radius) march = step * 1e-4;

    const Outcome run = run_exact(problem);
    if (march >= 0) {
      ++hits;
      ASSERT_FALSE(run.collisions.empty()) << "trial " << trial << ": missed at " << march;
      EXPECT_LE(run.collisions[0].time, march) << "trial " << trial;
      EXPECT_NEAR(distance(run.collisions[0].time), radius, 1e-12) << "trial " << trial;
    } else if (!run.collisions.empty()) {  // a graze between two steps of the march
      EXPECT_NEAR(distance(run.collisions[0].time), radius, 1e-12) << "trial " << trial;
    }
  }

  EXPECT_GT(hits, 400);
}

TEST(Wall, ABallRestsOnALevelWallAndSlidesOffItsRim) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.wall({0, 0, 0}, {0, 1, 0}, 2, 2, {0, 0, 1});
  problem.ball({0, 0.5, 0}, {4, 0, 0}, 1, 0.5, 0.5);  // v^2 = 16 > g r = 5: it leaves at the rim, x = 1, t = 0.25
  problem.options.duration = 1.25;
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_LT((run.end.velocity[0] - Vec3(4, -10, 0)).norm(), 1e-14);
  EXPECT_LT((run.end.position[0] - Vec3(5, 0.5 - 5, 0)).norm(), 1e-14);
  EXPECT_EQ(run.tally.resting, 0u);
}

TEST(Wall, ASlowBallRollsRoundTheRimAndFalls) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.wall({0, 0, 0}, {0, 1, 0}, 2, 2, {0, 0, 1});
  problem.ball({0.9, 0.5, 0}, {0.5, 0, 0}, 1, 0.5, 0.5);
  problem.options.duration = 2;
  const Outcome run = run_exact(problem);
  EXPECT_LT(run.end.position[0].y(), -5);
  EXPECT_GT(run.end.position[0].x(), 1.4);
  EXPECT_LT(run.tally.max_overlap, 1e-13);
}

}  // namespace
}  // namespace carom
