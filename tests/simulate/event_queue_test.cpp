// The exact simulator's events: their order, their prediction, and prefetching.
#include "simulate/loop/event_queue.h"

#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/contact/region_exit.h"
#include "simulate/exact_parts.h"
#include "simulate/loop/event_predictor.h"
#include "simulate/loop/event_prefetch.h"
#include "simulate/loop/exact_collision_times.h"
#include "std.h"

namespace carom {
namespace {

using Kind = ExactEvent::Kind;

Problem row(int balls) {
  Problem p;
  for (int k = 0; k < balls; ++k) p.ball(Vec3(3.0 * k, 0, 0), Vec3::Zero());
  return p;
}

/// With the parts of the loop.
struct LoopParts : ExactParts {
  explicit LoopParts(Problem given)
      : ExactParts(std::move(given)),
        queue(bodies),
        prefetch(bodies, queue),
        predictor(bodies, queue, modes, flat, group) {}

  EventQueue queue;
  EventPrefetch prefetch;
  EventPredictor predictor;
};

struct Queue : LoopParts {
  using LoopParts::LoopParts;
  void put(Entity i, double time, Kind kind, Entity partner, double leaves = never) {
    bodies.body[i].event = ExactEvent{{time, 0}, partner, 1, 0, kind};
    queue.schedule(i, leaves);
  }
};

TEST(EventQueue, TheEarliestEventIsFirst) {
  Queue q(row(3));
  q.put(0, 3, Kind::body_body, 1);
  q.put(1, 2, Kind::body_body, 2);
  q.put(2, 2.5, Kind::rest, no_entity);
  EXPECT_EQ(q.queue.first(), 1u);
  EXPECT_EQ(q.queue.first_time(), 2);
}

TEST(EventQueue, EventsOfOneInstantGoByKindThenByNumbers) {
  Queue q(row(4));
  q.put(2, 1, Kind::body_body, 0);
  q.put(1, 1, Kind::body_body, 3);
  EXPECT_EQ(q.queue.first(), 2u);  // (0, 2) before (1, 3)
  q.put(3, 1, Kind::rest, no_entity);
  EXPECT_EQ(q.queue.first(), 3u);
}

TEST(EventQueue, TheSecondDoubleOfTheClockDecides) {
  Queue q(row(2));
  q.bodies.body[0].event = ExactEvent{{1, 1e-20}, no_entity, 0, 0, Kind::force};
  q.bodies.body[1].event = ExactEvent{{1, 0}, no_entity, 0, 0, Kind::rest};
  q.queue.schedule(0, never);
  q.queue.schedule(1, never);
  EXPECT_EQ(q.queue.first(), 1u);
}

TEST(EventQueue, ABodyThatLeavesItsRegionComesFirst) {
  Queue q(row(2));
  q.put(0, 1, Kind::force, no_entity);
  q.put(1, 2, Kind::force, no_entity, 1);
  EXPECT_EQ(q.queue.first(), 1u);
  EXPECT_TRUE(q.queue.leaves_first(1));
}

TEST(EventQueue, NothingIsDueAfterTheDuration) {
  Queue q(row(1));
  q.put(0, 10.5, Kind::force, no_entity);
  EXPECT_EQ(q.queue.first_time(), never);
}

Problem two_towards_each_other() {
  Problem p;
  p.ball(Vec3(0, 0, 0), Vec3(1, 0, 0));
  p.ball(Vec3(5, 0, 0), Vec3(-1, 0, 0));
  return p;
}

TEST(ExactCollisionTimes, AreTheSameFromBothSides) {
  ExactParts parts(two_towards_each_other());
  const ExactCollisionTimes times(parts.bodies);
  uint8_t feature = 0;
  EXPECT_EQ(times.of_pair(0, 1, feature).hi, 2);  // a gap of 4 m at 2 m/s
  EXPECT_EQ(times.of_pair(0, 1, feature), times.of_pair(1, 0, feature));
}

TEST(EventPredictor, FindsTheFirstOfABodysCollisions) {
  Problem p = two_towards_each_other();
  p.plane(Vec3(0, -1, 0), Vec3(0, 1, 0));
  p.initial.velocity[0] = Vec3(1, -1, 0);
  LoopParts parts(p);
  parts.predictor.predict(0);
  const ExactEvent& event = parts.bodies.body[0].event;
  EXPECT_EQ(event.kind, Kind::body_fixed);
  EXPECT_EQ(event.time.hi, 0.5);
  EXPECT_EQ(parts.predictor.surface_tests(), 1u);
}

TEST(RegionExit, IsBeforeTheBodyLeaves) {
  Problem p;
  p.world.gravity = Vec3(0, -9.8, 0);
  p.ball(Vec3(0, 0, 0), Vec3(3, 4, 0));
  ExactParts parts(p);
  const double t = region_exit(parts.bodies, 0);
  ASSERT_GT(t, 0);
  const Neighbours& n = parts.bodies.neighbours;
  for (double s = 0; s <= 1; s += 1.0 / 64)
    EXPECT_LE((parts.bodies.flights[0].position(s * t) - n.center(0)).norm(), n.room(0));
}

TEST(EventPrefetch, ChangesNoEvent) {
  LoopParts parts(row(100));
  parts.predictor.predict_all();
  const Entity first = parts.queue.first();
  const double time = parts.queue.first_time();
  for (int k = 0; k < 100; ++k) parts.prefetch.look_ahead();
  EXPECT_EQ(parts.queue.first(), first);
  EXPECT_EQ(parts.queue.first_time(), time);
}

}  // namespace
}  // namespace carom
