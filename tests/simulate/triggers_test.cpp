// Events that set times: forces, motions and strings begin and end at the instant of a first entry or a first
// collision, or after a delay. Closed forms, and the same run with the times that the events have set as numbers.
#include <gtest/gtest.h>

#include <numbers>

#include "physics/force.h"
#include "physics/world_now.h"
#include "simulate/build.h"
#include "simulate/snapshot.h"
#include "simulate/ties.h"
#include "std.h"

namespace carom {
namespace {

using Of = TriggeredEnd::Of;
constexpr Entity anything = no_entity;

/// A problem with events. Ends are named by what has them: the last of its kind.
struct Eventful : Tied {
  Eventful() { world.gravity = Vec3::Zero(); }

  uint32_t collision(Entity a, Entity b) {
    Trigger trigger{.a = {a, 1}, .b = {b, 1}};
    if (b == anything) trigger.b = {0, anything};
    world.triggers.all.push_back(trigger);
    return uint32_t(world.triggers.all.size() - 1);
  }
  /// The half-space x > `x`, for body `of`.
  uint32_t beyond(double x, Entity of) {
    world.regions.push_back({.position = Vec3(x, 0, 0), .normal = Vec3(1, 0, 0), .on = {of}});
    world.triggers.all.push_back({.regions = EntityRange{uint32_t(world.regions.size() - 1), 1}});
    return uint32_t(world.triggers.all.size() - 1);
  }
  void wait(Of of, size_t index, bool ends, uint32_t trigger, double after = 0, uint32_t window = 0) {
    world.triggers.ends.push_back({of, uint32_t(index), window, ends, trigger, after});
  }
  void force(const ForceLaw& law, vector<Entity> on, double from, double until) {
    world.forces.push_back({law, from, until, std::move(on)});
  }
};

/// The same with numbers in place of the events that have happened in a run.
Problem with_numbers(const Problem& problem, const Outcome& run) {
  Problem same = problem;
  set_off(same.world, run.tally.changes.fired);
  same.world.triggers = {};
  return same;
}

/// The greatest difference of places and velocities at the end from those of the run with numbers (m, m/s).
double difference_from_numbers(const Problem& problem, const Outcome& run) {
  const Outcome same = run_exact(with_numbers(problem, run));
  double most = 0;
  for (Entity i = 0; i < run.end.position.size(); ++i) {
    most = max(most, (run.end.position[i] - same.end.position[i]).cwiseAbs().maxCoeff());
    most = max(most, (run.end.velocity[i] - same.end.velocity[i]).cwiseAbs().maxCoeff());
  }
  EXPECT_NEAR(run.tally.work, same.tally.work, 1e-9 * (1 + std::abs(same.tally.work)));
  return most;
}

TEST(Triggers, AForceActsFromACollisionOnAndForSoLong) {
  Eventful problem;
  problem.ball({0, 0, 0}, {3, 0, 0}, 1, 0.1);
  problem.ball({1, 0, 0}, Vec3::Zero(), 1, 0.1);
  const Entity c = problem.ball({0, 5, 0}, {0, 1, 0}, 2, 0.1);
  problem.force(UniformForce{{0, 0, 4}}, {c}, not_yet, not_yet);
  const uint32_t hit = problem.collision(0, 1);
  problem.wait(Of::force, 0, false, hit);
  problem.wait(Of::force, 0, true, hit, 0.5);
  problem.options.duration = 2;
  const Outcome run = run_exact(problem);

  const double met = 0.8 / 3;
  EXPECT_NEAR(run.tally.changes.fired[hit], met, 1e-16);
  // 2 m/s^2 for half a second.
  const double left = 2 - met - 0.5;
  EXPECT_NEAR(run.end.position[c].z(), 0.5 * 2 * 0.25 + 1 * left, 1e-15);
  EXPECT_NEAR(run.end.velocity[c].z(), 1, 1e-15);
  EXPECT_NEAR(run.tally.work, 0.5 * 2 * 1, 1e-15);
  EXPECT_NEAR(residual(problem, run), 0, 1e-14);
}

TEST(Triggers, ASpringHoldsUntilItsBodyEntersARegion) {
  // A ball swings about a point from the left, and is let go at a distance beyond it.
  Eventful problem;
  const Entity a = problem.ball({-1, 0, 0}, {0, 0.5, 0}, 1, 0.1);
  problem.force(Spring{Vec3::Zero(), 4, 0, 0}, {a}, 0, not_yet);
  problem.wait(Of::force, 0, true, problem.beyond(0.5, a));
  problem.options.duration = 5;
  const Outcome run = run_exact(problem);

  // x = -cos 2t, y = sin(2t) / 4.
  const double t = std::acos(-0.5) / 2;
  EXPECT_NEAR(run.tally.changes.fired[0], t, 1e-14);
  const Vec3 x(0.5, std::sin(2 * t) / 4, 0);
  const Vec3 v(2 * std::sin(2 * t), std::cos(2 * t) / 2, 0);
  EXPECT_LT((run.end.position[a] - (x + (5 - t) * v)).norm(), 1e-12);
  EXPECT_NEAR(residual(problem, run), 0, 1e-12);
  EXPECT_LT(difference_from_numbers(problem, run), 1e-12);
}

TEST(Triggers, AStringIsCutAtTheLowestPointOfItsPendulum) {
  for (const bool rod : {false, true}) {
    Eventful problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    const Entity bob = problem.ball({-1, 2, 0}, Vec3::Zero(), 2, 0.1);
    problem.anchored(bob, {0, 2, 0}, 1).until = not_yet;
    problem.world.strings.back().rod = rod;
    problem.wait(Of::string, 0, true, problem.beyond(0, bob));
    problem.options.duration = 1.5;
    const Outcome run = run_exact(problem);

    const double low = period(1, std::numbers::pi / 2) / 4;
    const double left = 1.5 - low;
    EXPECT_NEAR(run.tally.changes.fired[0], low, 1e-11);
    const Vec3 there(sqrt(2 * g_n) * left, 1 - 0.5 * g_n * left * left, 0);
    EXPECT_LT((run.end.position[bob] - there).norm(), 1e-10);
    EXPECT_EQ(run.tally.resting, 0u);
    EXPECT_NEAR(residual(problem, run), 0, 1e-10);
  }
}

TEST(Triggers, AStringIsCutAtATimeThatIsANumber) {
  // Two balls turn about their middle at 2 rad/s. Between times they fly straight.
  Eventful problem;
  problem.ball({-1, 0, 0}, {0, -2, 0}, 1, 0.1);
  problem.ball({1, 0, 0}, {0, 2, 0}, 1, 0.1);
  problem.between(0, 1, 2).until = 0.7;
  problem.options.duration = 3;
  const Outcome run = run_exact(problem);
  const Vec3 x(std::cos(1.4), std::sin(1.4), 0), v(-2 * std::sin(1.4), 2 * std::cos(1.4), 0);
  EXPECT_LT((run.end.position[1] - (x + 2.3 * v)).norm(), 1e-11);
  EXPECT_LT((run.end.position[0] + (x + 2.3 * v)).norm(), 1e-11);

  // A slack one that is cut before it would go taut.
  Eventful slack;
  slack.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1);
  slack.anchored(0, {0, 0, 0}, 1).until = 0.5;
  EXPECT_EQ(run_exact(slack).end.position[0], Vec3(10, 0, 0));
  slack.world.strings.back().until = 1.5;
  EXPECT_EQ(run_exact(slack).tally.tautened, 1u);
}

TEST(Triggers, WhatHangsFallsWhenItsStringIsCut) {
  // A chain of three that hangs at rest, and sleeps, is cut in its middle by another ball's arrival.
  Eventful problem;
  problem.world.gravity = Vec3(0, -10, 0);
  for (int k = 0; k < 3; ++k) problem.ball({0, -1.0 - k, 0}, Vec3::Zero(), 1, 0.1, 0);
  const Entity other = problem.ball({5, 20, 0}, Vec3::Zero(), 1, 0.1);
  problem.anchored(0, {0, 0, 0}, 1);
  problem.between(0, 1, 1).until = not_yet;
  problem.between(1, 2, 1);
  problem.plane({0, -60, 0}, {0, 1, 0});
  problem.world.regions.push_back({.position = Vec3(0, 0, 0), .normal = Vec3(0, -1, 0), .on = {other}});
  problem.world.triggers.all.push_back({.regions = EntityRange{0, 1}});
  problem.wait(Of::string, 1, true, 0, 0.25);
  problem.options.duration = 3;
  const Outcome run = run_exact(problem);

  const double left = 3 - 2 - 0.25;
  EXPECT_NEAR(run.end.position[0].y(), -1, 1e-12);
  EXPECT_NEAR(run.end.position[1].y(), -2 - 5 * left * left, 1e-11);
  EXPECT_NEAR(run.end.position[2].y(), -3 - 5 * left * left, 1e-11);
  EXPECT_NEAR(run.end.velocity[2].y(), -10 * left, 1e-11);
}

TEST(Triggers, AWallLeavesWhenABallArrives) {
  // The wall begins to rise as the ball enters, and has left its way when it comes.
  Eventful problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1);
  problem.wall({2, 0, 0}, {-1, 0, 0}, 1, 1);
  const uint32_t enters = problem.beyond(1.5, 0);
  problem.move(1, motion_by_events({{not_yet, not_yet, Vec3(0, 2, 0)}}));
  problem.wait(Of::motion, 0, false, enters);
  problem.wait(Of::motion, 0, true, enters, 1);
  problem.options.duration = 4;
  Outcome run = run_exact(problem);
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_NEAR(run.end.position[0].x(), 4, 1e-15);

  // Too slow to leave: the ball bounces off as off a wall at rest.
  problem.world.motions[0].windows[0].velocity = Vec3(0, 0.1, 0);
  run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, 1.9, 1e-15);

  // It comes towards the ball from 1.5 s on, at 1 m/s: they meet in the middle of the 0.4 m between them.
  problem.world.motions[0].windows[0].velocity = Vec3(-1, 0, 0);
  run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, 1.7, 1e-14);
  EXPECT_NEAR(run.end.velocity[0].x(), -3, 1e-14);
  EXPECT_NEAR(residual(problem, run), 0, 1e-13);
}

TEST(Triggers, ATableLiftsTheBallThatHasLandedOnIt) {
  // It lands without a rebound, is carried from 0.25 s later on, and is thrown up as the table stops.
  Eventful problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0, 1.1, 0}, Vec3::Zero(), 1, 0.1, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  const uint32_t lands = problem.collision(0, anything);
  problem.move(1, motion_by_events({{not_yet, not_yet, Vec3(0, 2, 0)}}));
  problem.wait(Of::motion, 0, false, lands, 0.25);
  problem.wait(Of::motion, 0, true, lands, 0.75);

  const double landed = sqrt(0.2);
  problem.options.duration = landed + 0.75 + 0.1;
  const Outcome run = run_exact(problem);
  EXPECT_NEAR(run.tally.changes.fired[0], landed, 1e-15);
  EXPECT_NEAR(run.end.position[0].y(), 0.1 + 2 * 0.5 + 2 * 0.1 - 5 * 0.01, 1e-13);
  EXPECT_NEAR(run.end.velocity[0].y(), 2 - 10 * 0.1, 1e-13);
  EXPECT_LT(difference_from_numbers(problem, run), 1e-12);
}

TEST(Triggers, ADoorStrikesTheBallThatHasTouchedIt) {
  // It starts as the ball leaves it, and is faster: it strikes the ball once more, at once.
  Eventful problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1, 0.5);
  problem.wall({1.1, 0, 0}, {-1, 0, 0}, 1, 1);
  problem.move(1, motion_by_events({{not_yet, infinity, Vec3(-2, 0, 0)}}));
  problem.wait(Of::motion, 0, false, problem.collision(0, 1));
  problem.options.duration = 3;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 2u);
  // The ball leaves at 0.5 m/s, and is struck at a speed of 1.5 m/s.
  EXPECT_NEAR(run.collisions[1].time, 1, 1e-14);
  EXPECT_NEAR(run.end.velocity[0].x(), -2 - 0.75, 1e-14);
}

TEST(Triggers, WindowsThatOverlapAddUp) {
  Eventful problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1);
  problem.obstacle({50, 50, 0}, Volume::sphere(1));
  const uint32_t enters = problem.beyond(1, 0);
  problem.move(
      1, motion_by_events({{not_yet, not_yet, Vec3(0, 2, 0)}, {0.5, 1.5, Vec3(1, 0, 0)}, {not_yet, 3, Vec3(0, 0, 1)}}));
  problem.wait(Of::motion, 0, false, enters);
  problem.wait(Of::motion, 0, true, enters, 1);
  problem.wait(Of::motion, 0, false, enters, 0.5, 2);

  World world = problem.world;
  set_off(world, array{1.0});
  EXPECT_EQ(fixed_position(world, 1, {4, 0}), Vec3(51, 52, 1.5));
  EXPECT_EQ(fixed_velocity(world, 1, {1.25, 0}), Vec3(1, 2, 0));
  EXPECT_EQ(fixed_velocity(world, 1, {1.75, 0}), Vec3(0, 2, 1));

  // One that would begin after its end does not act.
  World late = problem.world;
  set_off(late, array{2.75});
  EXPECT_EQ(fixed_position(late, 1, {4, 0}), Vec3(51, 52, 0).cwiseProduct(Vec3(1, 0, 1)) + Vec3(0, 50 + 2, 0));
}

TEST(Triggers, ForcesBetweenBodiesBeginAtTheCollisionOfTwo) {
  for (const bool gravitation : {false, true}) {
    Eventful problem;
    problem.ball({-1, 0, 0}, {0, 0.4, 0}, 1, 0.1);
    problem.ball({1, 0, 0}, {0, -0.4, 0}, 2, 0.1);
    problem.ball({8, 0, 0}, {1, 0, 0}, 1, 0.1);
    problem.ball({9, 0, 0}, Vec3::Zero(), 1, 0.1);
    const uint32_t hit = problem.collision(3, 2);
    if (gravitation)
      problem.world.gravitations.push_back({1, 0, not_yet, infinity, {0, 1}});
    else
      problem.world.springs.push_back({0, 1, 3, 2, 0, not_yet, infinity});
    problem.wait(gravitation ? Of::gravitation : Of::body_spring, 0, false, hit);

    problem.options.duration = 4;
    const Outcome run = run_exact(problem);
    EXPECT_NEAR(run.tally.changes.fired[hit], 0.8, 1e-15);
    EXPECT_LT(difference_from_numbers(problem, run), 1e-11);
    EXPECT_NEAR(residual(problem, run), 0, 1e-11);
    // They have turned.
    EXPECT_GT(std::abs(run.end.velocity[0].x()), 0.1);
  }
}

TEST(Triggers, ThatDoNotHappenChangeNothing) {
  Eventful problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0, 3, 0}, {1, 0, 0}, 1, 0.1, 0.8);
  problem.ball({3, 5, 0}, {-1, 0, 0}, 1, 0.2, 0.8);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.obstacle({-5, 1, 0}, Volume::box({1, 1, 1}));

  // The same with a force and a motion that never begin.
  Problem without = problem;
  problem.force(UniformForce{{0, 4, 0}}, {0}, not_yet, infinity);
  problem.move(3, motion_by_events({{not_yet, infinity, Vec3(1, 0, 0)}}));
  problem.collision(0, 3);
  problem.wait(Of::force, 0, false, 0);
  problem.wait(Of::motion, 1, false, 0);
  const Outcome run = run_exact(problem);
  const Outcome same = run_exact(without);

  EXPECT_EQ(run.tally.changes.fired[0], not_yet);
  for (Entity i = 0; i < 2; ++i) EXPECT_LT((run.end.position[i] - same.end.position[i]).norm(), 1e-12);
  EXPECT_EQ(run.all.size(), same.all.size());
}

TEST(Triggers, OnlyTheFirstOfItsKindCounts) {
  // A ball that goes back and forth between two walls enters again and again.
  Eventful problem;
  problem.ball({0, 0, 0}, {2, 0, 0}, 1, 0.1);
  problem.ball({0, 5, 0}, Vec3::Zero(), 1, 0.1);
  problem.wall({1.1, 0, 0}, {-1, 0, 0}, 1, 1);
  problem.wall({-1.1, 0, 0}, {1, 0, 0}, 1, 1);
  problem.force(UniformAcceleration{{0, 1, 0}}, {1}, not_yet, not_yet);
  const uint32_t enters = problem.beyond(0.5, 0);
  problem.wait(Of::force, 0, false, enters);
  problem.wait(Of::force, 0, true, enters, 1);
  const Outcome run = run_exact(problem);
  EXPECT_NEAR(run.tally.changes.fired[enters], 0.25, 1e-14);
  EXPECT_NEAR(run.end.velocity[1].y(), 1, 1e-14);
}

TEST(Triggers, ABodyThatIsRemovedEntersAllRegionsOfItsInstant) {
  // Both regions begin at the same plane. Either may come first.
  for (const uint32_t removes : {0u, 1u}) {
    Eventful problem;
    problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1);
    problem.ball({0, 5, 0}, Vec3::Zero(), 2, 0.1);
    problem.force(UniformForce{{0, 0, 4}}, {1}, not_yet, infinity);
    const uint32_t first = problem.beyond(2, 0);
    const uint32_t second = problem.beyond(2, 0);
    problem.wait(Of::force, 0, false, removes == 0 ? second : first);
    problem.world.regions[removes].removes = true;

    problem.options.duration = 4;
    const Outcome run = run_exact(problem);
    EXPECT_EQ(run.tally.changes.removed.bodies, 1u);
    EXPECT_NEAR(run.end.velocity[1].z(), 4, 1e-13);
  }
}

TEST(Triggers, APlaceIsFreeWhenAnEventHasTakenAwayWhatStoodThere) {
  Eventful problem;
  problem.ball({0, 0, 0}, Vec3::Zero(), 1, 0.5);
  problem.ball({-9, 0, 0}, {2, 0, 0}, 1, 0.1);
  problem.obstacle({0, 0.2, 0}, Volume::sphere(0.5));
  problem.world.appears = {0.25, -infinity};
  const uint32_t enters = problem.beyond(-8, 1);
  problem.move(2, motion_by_events({{not_yet, infinity, Vec3(0, 2, 0)}}));
  problem.wait(Of::motion, 0, false, enters);
  problem.options.duration = 2;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  double appeared = 0;
  while (simulator->time() < 2) {
    simulator->advance_to(2);
    for (const RegionCrossing& crossing : simulator->crossings())
      if (crossing.region == RegionCrossing::world) appeared = crossing.time;
  }
  EXPECT_NEAR(appeared, 0.5 + 0.4, 1e-11);
}

TEST(Triggers, OfTime0ActFromThenOn) {
  // It is inside at the start, and two that touch collide.
  for (const bool meet : {false, true}) {
    Eventful problem;
    problem.ball({1, 0, 0}, {1, 0, 0}, 1, 0.1);
    problem.ball({1.2, 0, 0}, {-1, 0, 0}, 1, 0.1);
    problem.ball({0, 5, 0}, Vec3::Zero(), 2, 0.1);
    problem.force(UniformForce{{0, 0, 4}}, {2}, not_yet, not_yet);
    const uint32_t first = meet ? problem.collision(0, 1) : problem.beyond(0, 0);
    problem.wait(Of::force, 0, false, first);
    problem.wait(Of::force, 0, true, first, 1);

    problem.options.duration = 2;
    const Outcome run = run_exact(problem);
    EXPECT_LT(run.tally.changes.fired[first], 1e-15);
    EXPECT_NEAR(run.end.velocity[2].z(), 2, 1e-15);
    EXPECT_NEAR(run.end.position[2].z(), 3, 1e-15);
  }
}

/// Balls in a box whose floor a ball from outside takes away.
Eventful heap(bool steps) {
  Eventful problem;
  problem.world.gravity = Vec3(0, -10, 0);
  for (int k = 0; k < 27; ++k)
    problem.ball({0.21 * (k % 3) + 0.003 * (k / 9), 0.15 + 0.21 * (k / 9), 0.21 * (k / 3 % 3)}, Vec3::Zero(), 1, 0.1,
                 0.3);
  problem.ball({-6, 0, 0}, {4, 0, 0}, 1, 0.1);
  problem.world.forces.push_back({UniformAcceleration{{0, 10, 0}}, 0, infinity, {27}});

  // The box, through whose walls and floor that one passes.
  problem.plane({-0.3, 0, 0}, {1, 0, 0});
  problem.plane({0.7, 0, 0}, {-1, 0, 0});
  problem.plane({0, 0, -0.2}, {0, 0, 1});
  problem.plane({0, 0, 0.7}, {0, 0, -1});
  problem.world.pairs.push_back({27, 1, 28, 4, nullopt});
  problem.obstacle({0.2, -0.5, 0.2}, Volume::box({2, 1, 2}));
  problem.world.pairs.push_back({27, 1, 32, 1, nullopt});

  const uint32_t enters = problem.beyond(-2, 27);
  problem.move(32, motion_by_events({{not_yet, not_yet, Vec3(0, -3, 0)}}));
  problem.wait(Of::motion, 4, false, enters);
  problem.wait(Of::motion, 4, true, enters, 0.2);
  if (steps)
    problem.force(Drag{0, 0.1, Vec3::Zero()}, {}, not_yet, infinity), problem.wait(Of::force, 1, false, enters);
  problem.options.duration = 2;
  return problem;
}

TEST(Triggers, AHeapThatRestsFallsWithItsFloor) {
  for (const bool steps : {false, true}) {
    const Eventful problem = heap(steps);
    const Outcome run = run_exact(problem);
    EXPECT_NEAR(run.tally.changes.fired[0], 1, 1e-14);
    // The floor is 0.6 m lower.
    for (Entity i = 0; i < 27; ++i) EXPECT_LT(run.end.position[i].y(), 0.1 + 0.21 * 2 + 0.05 - 0.5) << i;
    EXPECT_LT(run.tally.max_overlap, 1e-4);
    EXPECT_LT(std::abs(unbooked(problem, run)), 1e-6);
    // Of some 160 J.
    EXPECT_LT(std::abs(residual(problem, run)), 1);
  }
}

TEST(Triggers, SnapshotsGoOnBitForBit) {
  Eventful table;
  table.world.gravity = Vec3(0, -10, 0);
  table.ball({0, 1.1, 0}, Vec3::Zero(), 1, 0.1, 0.5);
  table.ball({0.5, 2, 0}, Vec3::Zero(), 1, 0.1, 0.5);
  table.plane({0, 0, 0}, {0, 1, 0});
  table.anchored(1, {0, 2, 0}, 0.5).until = not_yet;
  table.force(Drag{0.1, 0, Vec3::Zero()}, {0}, not_yet, not_yet);

  table.collision(0, 2);
  table.move(2, motion_by_events({{not_yet, not_yet, Vec3(0, 2, 0)}}));
  table.wait(Of::motion, 0, false, 0, 0.25);
  table.wait(Of::motion, 0, true, 0, 0.75);
  table.wait(Of::force, 0, false, 0, 0.1);
  table.wait(Of::force, 0, true, table.beyond(-0.3, 1), 0.1);
  table.wait(Of::string, 0, true, table.beyond(-0.25, 1));
  table.options.record_paths = true;
  table.options.duration = 3;

  Eventful crowd = heap(false);
  crowd.options.duration = 1.4;
  for (const Eventful& problem : {table, crowd}) {
    const auto make = [&] { return make_exact_simulator(problem.world, problem.initial, problem.options); };
    vector<double> times;
    for (int k = 1; k <= 40; ++k) times.push_back(problem.options.duration * k / 40);
    expect_same_when_restored(make, times, 15);
  }
}

TEST(Triggers, SlicesOfTheRunChangeNothing) {
  const Eventful problem = heap(false);
  const Outcome whole = run_exact(problem);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  for (int k = 1; k <= 200; ++k) go_to(*simulator, 0.01 * k);
  for (Entity i = 0; i < 28; ++i) EXPECT_EQ(simulator->state().position[i], whole.end.position[i]);
  EXPECT_EQ(simulator->state().fired, whole.end.fired);
}

TEST(Triggers, InAStateAreThoseThatHaveHappened) {
  Eventful problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1);
  problem.ball({0, 3, 0}, Vec3::Zero(), 1, 0.1);
  problem.force(UniformForce{{0, 4, 0}}, {1}, not_yet, infinity);
  problem.wait(Of::force, 0, false, problem.beyond(2, 0));
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  EXPECT_EQ(simulator->state().fired, vector{not_yet});
  go_to(*simulator, 1.5);
  EXPECT_EQ(simulator->state().fired, vector{not_yet});
  go_to(*simulator, 2.5);
  EXPECT_NEAR(simulator->state().fired[0], 2, 1e-14);
}

}  // namespace
}  // namespace carom
