// Ends of runs: by regions, by numbers of collisions, and at rest.
#include <gtest/gtest.h>

#include "simulate/regions.h"
#include "std.h"

namespace carom {
namespace {

TEST(Stops, AtTheInstantOfACrossing) {
  Problem problem = gas_among_regions(20);
  problem.world.regions = {stopping(region_at({1.5, -1.5, 1.5}, Volume::sphere(0.5)))};
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->reason, EndReason::region);
  ASSERT_EQ(run.crossings.size(), 1u);
  EXPECT_EQ(run.tally.end->time, run.crossings[0].time);
  EXPECT_EQ(run.end.time, run.crossings[0].time);
  EXPECT_NEAR((run.end.position[run.crossings[0].body] - Vec3(1.5, -1.5, 1.5)).norm(), 0.5, 1e-15);
}

TEST(Stops, EndWhatIsWatched) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  const Entity ball = problem.ball({0, 0, 0}, Vec3::Zero(), 1, 0.1);
  problem.world.regions = {stopping(region_at({0, -2, 0}, Volume::box({10, 2, 10})))};
  problem.options.duration = 5;
  problem.options.watch = {{Quantity::y, ball, 1}};
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 1);  // it enters at y = -1, after sqrt(0.2) s
  EXPECT_NEAR(simulator->extremes()[0].least.value, -1, 1e-14);
  EXPECT_NEAR(simulator->extremes()[0].least.time, sqrt(0.2), 1e-14);
}

TEST(Stops, RecordAllThatEnterAtThatInstant) {
  Problem problem;
  problem.ball({-4, 3, 0}, {1, 0, 0});
  problem.ball({4, -3, 0}, {-1, 0, 0});
  problem.ball({4, 7, 0}, {-1, 0, 0});
  problem.world.regions = {stopping(region_at({0, 0, 0}, Volume::box({1.5, 20, 1})))};
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 3u);
  for (Entity i = 0; i < 3; ++i) EXPECT_EQ(run.crossings[i], (RegionCrossing{3.25, 0, i, true}));
}

TEST(Stops, AfterTheCollisions) {
  Problem problem = gas_among_regions(20);
  problem.world.regions.clear();
  const WithRegions whole = run_with(problem);

  for (const uint64_t n : {1u, 7u, 100u}) {
    problem.options.stop_collisions = n;
    const WithRegions run = run_with(problem);

    ASSERT_TRUE(run.tally.end);
    EXPECT_EQ(run.tally.end->reason, EndReason::collisions);
    EXPECT_EQ(run.tally.collisions(), n);
    EXPECT_EQ(run.tally.end->time, whole.all[n - 1].time);
    EXPECT_EQ(run.end.time, whole.all[n - 1].time);
    EXPECT_LT(std::abs(residual(problem, run)), 1e-12);
  }
}

TEST(Stops, AfterACollisionLetCrossingsOfThatInstantHappen) {
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0});
  problem.ball({1, 0, 0}, {0, 0, 0});
  problem.ball({-2, 9, 0}, {1, 0, 0});
  problem.world.regions = {removing(region_at({1, 9, 0}, Volume::box({2, 2, 2})))};
  problem.options.stop_collisions = 1;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->time, 2);
  EXPECT_EQ(run.crossings, (vector<RegionCrossing>{{2, 0, 2, true}}));
  EXPECT_EQ(run.tally.changes.removed.bodies, 1u);
}

TEST(Stops, CountCollisionsOfOneInstantTogether) {
  Problem problem;
  problem.room({-2, -2, -2}, {2, 2, 2});
  problem.ball({-1, 0, 0}, {-1, 0, 0});
  problem.ball({1, 0, 0}, {1, 0, 0});
  problem.options.stop_collisions = 1;
  const WithRegions run = run_with(problem);
  EXPECT_EQ(run.tally.collisions(), 2u);
  EXPECT_EQ(run.end.velocity[0], Vec3(1, 0, 0));
  EXPECT_EQ(run.end.velocity[1], Vec3(-1, 0, 0));
}

TEST(Stops, AtRestWhenTheBouncesHaveEnded) {
  // Dropped by h, e = 1/2: at rest after sqrt(2 h / g) (1 + e) / (1 - e) = 3 s.
  Problem problem;
  problem.world.gravity = Vec3(0, -2, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 1.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.options.stop_at_rest = true;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->reason, EndReason::rest);
  EXPECT_NEAR(run.tally.end->time, 3, 3e-15);
  EXPECT_EQ(run.tally.resting, 1u);
}

TEST(Stops, AtOnceWhereNothingMoves) {
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.options.stop_at_rest = true;
  EXPECT_EQ(run_with(problem).tally.end->time, 0);
  problem.world.gravity = Vec3(0, -1, 0);
  EXPECT_FALSE(run_with(problem).tally.end);
  problem.plane({0, -0.5, 0}, {0, 1, 0});
  EXPECT_EQ(run_with(problem).tally.end->time, 0);
  // It slides on.
  problem.initial.velocity[0] = Vec3(1, 0, 0);
  EXPECT_FALSE(run_with(problem).tally.end);
}

TEST(Stops, AtRestWaitForAForceThatIsToCome) {
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.world.forces.push_back({UniformForce{Vec3(1, 0, 0)}, 2, 3});
  problem.options.stop_at_rest = true;
  EXPECT_FALSE(run_with(problem).tally.end);
  // A floor holds it against a force in a window: at rest when the window is over.
  problem.world.gravity = Vec3(0, -1, 0);
  problem.plane({0, -0.5, 0}, {0, 1, 0});
  problem.world.forces[0].law = UniformForce{Vec3(0, -1, 0)};
  EXPECT_EQ(run_with(problem).tally.end->time, 3);
}

TEST(Stops, AtRestWaitForThingsThatStartToMoveOrCome) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.options.stop_at_rest = true;
  problem.options.duration = 20;
  // A floor that rises from 3 to 4 s at 1 m/s throws the ball up at its end. It comes to rest 0.2 s / (1 - e) later.
  problem.move(1, {{3, 4, {0, 1, 0}}});
  WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_NEAR(run.tally.end->time, 4.4, 1e-14);
  EXPECT_NEAR(run.end.position[0].y(), 1.5, 1e-14);
  // A wall comes along: it strikes the ball after 2 s.
  problem.world.motions.clear();
  problem.plane({-2.5, 0, 0}, {1, 0, 0});
  problem.move(2, {{0, 1e3, {1, 0, 0}}});
  problem.options.duration = 5;
  run = run_with(problem);
  ASSERT_FALSE(run.all.empty());
  EXPECT_NEAR(run.all[0].time, 2, 1e-14);
}

TEST(Stops, AtRestOfAPile) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.room({-1.1, 0, -1.1}, {1.1, 9, 1.1});
  Random random;
  for (int k = 0; k < 12; ++k)
    problem.ball({-0.5 + (k % 2), 0.6 + 1.1 * (k / 2), 0.1 * random(-1, 1)}, {0, 0, 0}, 1, 0.5, 0.3);

  problem.options.duration = 200;
  problem.options.stop_at_rest = true;
  const WithRegions run = run_with(problem);

  ASSERT_TRUE(run.tally.end);
  EXPECT_LT(run.tally.end->time, 100);
  for (const Vec3& v : run.end.velocity) EXPECT_EQ(v, Vec3(0, 0, 0));
  EXPECT_EQ(run.tally.resting, 12u);
}

TEST(Stops, AtRestWhenAllOthersHaveLeft) {
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.ball({0, 5, 0}, {1, 0, 0});
  problem.world.regions = {removing(side_at({4, 0, 0}, {1, 0, 0}))};
  problem.options.stop_at_rest = true;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->time, 4);
}

TEST(Stops, OfTheBooksEngineAreAtFrames) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.world.regions = {stopping(side_at({1.01, 0, 0}, {1, 0, 0}))};

  BookOptions options;
  options.step = 0.25;
  const auto simulator = make_book_simulator(problem.world, problem.initial, options);

  vector<RegionCrossing> crossings;
  for (const double time : {0.0, 1.0, 1.1, 1.2, 1.3, 2.0}) {
    simulator->advance_to(time);
    crossings.insert(crossings.end(), simulator->crossings().begin(), simulator->crossings().end());
    EXPECT_EQ(simulator->tally().end.has_value(), time >= 1.25);
  }

  EXPECT_EQ(crossings, (vector<RegionCrossing>{{1.25, 0, 0, true}}));
  EXPECT_EQ(simulator->state().position[0], Vec3(1.25, 0, 0));
}

}  // namespace
}  // namespace carom
