// The errors of a run, and the matching of collisions of two runs.
#include "bench/differences.h"
#include "physics/world.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

/// One ball of radius 0.5 m over a floor, entity 1.
World one_ball() {
  World world;
  world.mass = {2};
  world.radius = {0.5};
  world.restitution = {1};
  world.gravity = Vec3::Zero();
  world.planes = {{{0, 0, 0}, {0, 1, 0}, {}}};
  return world;
}

/// A ball that falls at 1 m/s onto the floor, which it strikes at `impact`, and flies up.
RecordedRun bounce(double impact, const vector<double>& instants) {
  RecordedRun run;
  for (const double t : instants) {
    State state;
    state.time = t;
    state.position = {{0, 0.5 + std::abs(t - impact), 0}};
    state.velocity = {{0, t < impact ? -1.0 : 1.0, 0}};
    run.states.push_back(state);
  }
  run.impacts = {{impact, 1, 0, 1}};
  run.tally.fastest.speed = 1;
  run.duration = 4;
  return run;
}

RecordedRun with_impacts(const vector<Impact>& impacts) {
  RecordedRun run;
  run.impacts = impacts;
  run.tally.fastest.speed = 1;
  run.duration = 100;
  return run;
}

TEST(Differences, OfAnImpactALittleLateAreThoseOfTheWayNotOfTheVelocity) {
  const vector<double> instants = {0.5, 1, 1.005, 1.01, 2};
  const Differences d = differences(one_ball(), bounce(1, instants), bounce(1.01, instants), instants, 4);
  EXPECT_NEAR(d.position, 0.01, 1e-15);
  EXPECT_EQ(d.velocity, 0);  // at 1, 1.005 and 1.01 s the ball is up in one run and down in the other
  EXPECT_EQ(d.energy, 0);
  EXPECT_EQ(d.missed, 0u);
  EXPECT_EQ(d.invented, 0u);
}

TEST(Differences, OfAMissedImpactAreThoseOfTheVelocityToo) {
  const vector<double> instants = {0.5, 2};
  RecordedRun through = bounce(1, instants);
  through.impacts.clear();
  through.states[1].position[0].y() = -0.5;
  through.states[1].velocity[0].y() = -1;
  const Differences d = differences(one_ball(), bounce(1, instants), through, instants, 4);
  EXPECT_EQ(d.missed, 1u);
  EXPECT_EQ(d.invented, 0u);
  EXPECT_EQ(d.velocity, 2);
  EXPECT_EQ(d.position, 2);
}

TEST(Differences, AfterTheTimeThatIsComparedDoNotCount) {
  const vector<double> instants = {0.5, 2};
  RecordedRun through = bounce(1, instants);
  through.impacts.clear();
  through.states[1].velocity[0].y() = -1;
  const Differences d = differences(one_ball(), bounce(1, instants), through, instants, 0.9);
  EXPECT_EQ(d.missed, 0u);
  EXPECT_EQ(d.velocity, 0);
}

TEST(Differences, CollisionsAreTheSameWithinTheTimeOfAPassage) {
  // 0.5 m at 1 m/s: within 0.5 s.
  const auto compare = [](double time) {
    return differences(one_ball(), with_impacts({{10, 1, 0, 1}}), with_impacts({{time, 1, 0, 1}}), {}, 100);
  };
  EXPECT_EQ(compare(10.5).missed, 0u);
  EXPECT_EQ(compare(9.5).invented, 0u);
  for (const double time : {9.4, 10.6}) {
    EXPECT_EQ(compare(time).missed, 1u) << time;
    EXPECT_EQ(compare(time).invented, 1u) << time;
  }
}

TEST(Differences, OneCollisionStandsForOneOnly) {
  const RecordedRun once = with_impacts({{10, 1, 0, 1}}), twice = with_impacts({{10, 1, 0, 1}, {10.1, 1, 0, 1}});
  EXPECT_EQ(differences(one_ball(), once, twice, {}, 100).invented, 1u);
  EXPECT_EQ(differences(one_ball(), twice, once, {}, 100).missed, 1u);
}

TEST(Differences, OfOtherPairsAreOtherCollisions) {
  World world = one_ball();
  world.planes.push_back(world.planes[0]);
  const Differences d = differences(world, with_impacts({{10, 1, 0, 1}}), with_impacts({{10, 1, 0, 2}}), {}, 100);
  EXPECT_EQ(d.missed, 1u);
  EXPECT_EQ(d.invented, 1u);
}

TEST(Differences, SlowBouncesAndThoseAtTheVeryEndAreNotMissed) {
  const RecordedRun none = with_impacts({});
  EXPECT_EQ(differences(one_ball(), with_impacts({{10, 0.009, 0, 1}}), none, {}, 100).missed, 0u);
  EXPECT_EQ(differences(one_ball(), with_impacts({{10, 0.011, 0, 1}}), none, {}, 100).missed, 1u);
  EXPECT_EQ(differences(one_ball(), with_impacts({{10, 0.1, 0, 1}}), none, {}, 100).missed, 1u);
  EXPECT_EQ(differences(one_ball(), with_impacts({{99.4, 1, 0, 1}}), none, {}, 100).missed, 1u);
  EXPECT_EQ(differences(one_ball(), with_impacts({{99.6, 1, 0, 1}}), none, {}, 100).missed, 0u);
}

}  // namespace
}  // namespace carom
