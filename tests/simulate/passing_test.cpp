// Pairs that pass through each other: they have no impact, no contact and no effect on one another.
#include <gtest/gtest.h>

#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

PairRestitution passing(Entity a, Entity a_count, Entity b, Entity b_count) {
  return {a, a_count, b, b_count, nullopt};
}

TEST(Passing, BallsThatPassKeepTheirVelocitiesAndStrikeOthers) {
  // The first two pass each other. Each of them strikes the third.
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0});
  problem.ball({2, 0.1, 0}, {-1, 0, 0});
  problem.ball({0, 5, 0}, {0, -1, 0});
  problem.ball({6, 0, 0}, {0, 0, 0});
  problem.world.pairs = {passing(0, 1, 1, 1)};
  problem.options.duration = 9;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.collisions[0].a, 0u);
  EXPECT_EQ(run.collisions[0].b, 3u);
  EXPECT_NEAR(run.collisions[0].time, 7, 1e-14);
  EXPECT_EQ(run.end.velocity[1], Vec3(-1, 0, 0));
}

TEST(Passing, TheLastMatchDecides) {
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0});
  problem.ball({2, 0, 0}, {-1, 0, 0});
  problem.world.pairs = {passing(0, 2, 0, 2), {0, 1, 1, 1, 0.5}};
  EXPECT_TRUE(may_meet(problem.world, 1, 0));
  EXPECT_EQ(pair_restitution(problem.world, 1, 0), 0.5);
  ranges::reverse(problem.world.pairs);
  EXPECT_FALSE(may_meet(problem.world, 1, 0));
  EXPECT_TRUE(run_exact(problem).all.empty());
}

TEST(Passing, AGasThatPassesItselfMovesAsEachOfItsBallsAlone) {
  constexpr Entity balls = 40;
  const auto gas = [](Entity first, Entity count) {
    Problem problem;
    problem.options.duration = 20;
    Random random(7);
    for (Entity i = 0; i < balls; ++i) {
      const Vec3 x = in_cube(random, 0.9);
      const Vec3 v = in_cube(random, 1);
      if (i >= first && i < first + count) problem.ball(x, v, 1, 0.1);
    }

    problem.room({-1, -1, -1}, {1, 1, 1});
    problem.world.pairs = {passing(0, count, 0, count)};
    return run_exact(problem);
  };

  const Outcome all = gas(0, balls);
  EXPECT_GT(all.collisions.size(), 500u);
  for (Entity i = 0; i < balls; i += 7) {
    const Outcome one = gas(i, 1);
    EXPECT_EQ(one.end.position[0], all.end.position[i]);
    EXPECT_EQ(one.end.velocity[0], all.end.velocity[i]);
  }
}

TEST(Passing, AHeapInIslandsMovesAsAlone) {
  // Three boxes and a ball that slides down them. The same again, at the same place, begins higher.
  const auto heap = [](int heaps) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    for (int h = 0; h < heaps; ++h) {
      for (int i = 0; i < 3; ++i)
        problem.body(Volume::box({0.4, 0.2, 0.4}), {0.01 * i, 0.1 + 0.21 * i + h, 0}, Vec3::Zero(), 1 + i, 0);
      problem.ball({0.1, 0.8 + h, 0.05}, {0.3, 0, 0}, 1, 0.1, 0);
    }
    problem.plane({0, 0, 0}, {0, 1, 0});
    if (heaps == 2) problem.world.pairs = {passing(0, 4, 4, 4)};
    problem.options.duration = 1.5;
    return run_exact(problem);
  };

  const Outcome both = heap(2);
  const Outcome alone = heap(1);
  for (size_t i = 0; i < alone.end.position.size(); ++i)
    EXPECT_LT((both.end.position[i] - alone.end.position[i]).norm(), 1e-12) << i;
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(both.end.position[4 + i].y(), 0.1 + 0.2 * double(i), 1e-12);
}

TEST(Passing, TwoHeapsLieInOnePlaceAsCrowds) {
  constexpr Entity balls = 60;
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  Random random(3);

  for (int heap = 0; heap < 2; ++heap)
    for (int i = 0; i < int(balls); ++i)
      problem.ball(
          Vec3(0.22 * (i % 4) - 0.33, 0.2 + 0.25 * (i / 16), 0.22 * (i / 4 % 4) - 0.33) + in_cube(random, 0.005),
          Vec3::Zero(), 1, 0.1, 0.3);

  problem.room({-0.5, 0, -0.5}, {0.5, 9, 0.5});
  problem.world.pairs = {passing(0, balls, balls, balls)};
  problem.options.duration = 3;

  // Bodies of one heap touch, those of both overlap.
  const Outcome run = run_exact(problem);
  double own = infinity;
  double other = infinity;
  for (Entity i = 0; i < 2 * balls; ++i)
    for (Entity j = 0; j < i; ++j) {
      double& least = i < balls || j >= balls ? own : other;
      least = min(least, (run.end.position[i] - run.end.position[j]).norm());
    }
  EXPECT_GT(own, 0.2 * (1 - 1e-9));
  EXPECT_LT(other, 0.1);

  for (const Vec3& x : run.end.position) {
    EXPECT_LT(max(std::abs(x.x()), std::abs(x.z())), 0.4 + 1e-9);
    EXPECT_GT(x.y(), 0.1 - 1e-9);
    EXPECT_LT(x.y(), 0.9);
  }
}

TEST(Passing, ABodyFallsThroughAFloorThatCarriesAnother) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0, 1, 0}, Vec3::Zero(), 1, 0.5, 0);
  problem.ball({0, 1, 0}, Vec3::Zero(), 1, 0.5, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.world.pairs = {passing(0, 2, 0, 2), passing(1, 1, 2, 1)};
  problem.options.duration = 1;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.end.position[0], Vec3(0, 0.5, 0));
  EXPECT_NEAR(run.end.position[1].y(), 1 - 5, 1e-14);
}

TEST(Passing, TheBooksEngineLetsPairsPass) {
  const auto framed = [](const Problem& problem) {
    const auto simulator = make_book_simulator(problem.world, problem.initial, {});
    return run_to_end(*simulator, problem.options.duration).all;
  };

  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0});
  problem.ball({2, 0.1, 0}, {-1, 0, 0});
  problem.wall({0, 0, 0}, {1, 0, 0}, 4, 4);
  problem.world.pairs = {passing(0, 1, 1, 1), passing(0, 2, 2, 1)};
  problem.options.duration = 4;
  EXPECT_TRUE(framed(problem).empty());
  problem.world.pairs.pop_back();
  EXPECT_EQ(framed(problem).size(), 2u);
}

}  // namespace
}  // namespace carom
