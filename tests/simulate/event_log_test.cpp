#include "simulate/event_log.h"

#include <gtest/gtest.h>

#include "physics/impact.h"
#include "physics/world.h"
#include "simulate/simulation_error.h"
#include "std.h"

namespace carom {
namespace {

World two_bodies() {
  World world;
  world.mass = {1, 3};
  world.radius = {1, 1};
  world.restitution = {0.5, 0.5};
  world.planes.push_back({.point = Vec3::Zero(), .normal = Vec3::UnitZ(), .restitution = {}});
  return world;
}

Collision strike(double time) {
  return with_effect(two_bodies(), {time, CollisionKind::body_body, 0, 1, Vec3::Zero(), Vec3::UnitX(), 2, 1, 0.5});
}

TEST(MakeCollision, TakesImpulseAndLossFromBothMasses) {
  const Collision c = strike(7);
  EXPECT_EQ(c.time, 7);
  EXPECT_EQ(c.impulse, 0.75 * (2 + 1));  // reduced mass 3/4 kg
  EXPECT_EQ(c.energy_lost, 0.5 * 0.75 * (2 * 2 - 1));
}

TEST(MakeCollision, TakesAFixedThingAsInfinitelyHeavy) {
  const Collision c =
      with_effect(two_bodies(), {0, CollisionKind::body_fixed, 1, 2, Vec3::Zero(), -Vec3::UnitZ(), 2, 1, 0.5});
  EXPECT_EQ(c.impulse, 3 * (2 + 1));
  EXPECT_EQ(c.energy_lost, 0.5 * 3 * (2 * 2 - 1));
}

TEST(EventLog, CountsWhatItDoesNotBuffer) {
  EventLog log(0, false);
  log.record(strike(1));
  EXPECT_EQ(log.tally().body_body, 1u);
  EXPECT_TRUE(log.collisions().empty());
  EXPECT_TRUE(log.has_room(1));
}

TEST(EventLog, KeepsCollisionsUntilTheNextAdvance) {
  EventLog log(0, true);
  log.record(strike(0));
  log.record(strike(1));
  ASSERT_EQ(log.collisions().size(), 2u);
  EXPECT_EQ(log.collisions()[1].time, 1);
  log.begin_advance();
  EXPECT_TRUE(log.collisions().empty());
  EXPECT_EQ(log.tally().body_body, 2u);
}

TEST(EventLog, HasNoRoomBeforeItsBufferGrows) {
  EventLog log(0, true);
  for (size_t k = 0; k + 8 < EventLog::capacity; ++k) {
    EXPECT_TRUE(log.has_room(8));
    log.record(strike(1));
  }
  EXPECT_FALSE(log.has_room(8));
}

TEST(EventLog, StopsAtTheFirstCollisionBeyondTheLimit) {
  EventLog log(2, true);
  log.record(strike(1));
  log.record(strike(2));

  Collision rest = strike(2.5);
  rest.kind = CollisionKind::rest;  // the end of bounces is no collision
  log.record(rest);

  try {
    log.record(strike(3));
    FAIL();
  } catch (const SimulationError& error) {
    EXPECT_STREQ(error.what(), "more than simulate.max_collisions = 2 collisions, reached at t = 3 s");
  }
}

TEST(EventLog, SumsEnergyWithoutRounding) {
  EventLog log(0, false);
  log.lose(1e16);
  for (int k = 0; k < 1000; ++k) log.lose(1);
  log.lose(-1e16);
  EXPECT_EQ(log.tally().energy_lost, 1000);
  log.add_work(1e16);
  log.add_work(1);
  log.add_work(-1e16);
  EXPECT_EQ(log.tally().work, 1);
}

TEST(EventLog, KeepsTheGreatestSpeedAndOverlap) {
  EventLog log(0, false);
  for (const double x : {1.0, 3.0, 2.0}) {
    log.note_speed(static_cast<Entity>(x), x);
    log.note_overlap(0.5 * x);
  }
  EXPECT_EQ(log.tally().fastest.speed, 3);
  EXPECT_EQ(log.tally().fastest.body, 3u);
  EXPECT_EQ(log.tally().max_overlap, 1.5);
}

}  // namespace
}  // namespace carom
