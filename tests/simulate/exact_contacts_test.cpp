// The exact simulator's contacts and impacts, part by part.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/exact_parts.h"
#include "simulate/loop/exact_simulator.h"
#include "simulate/path/path_log.h"
#include "std.h"

namespace carom {
namespace {

/// Gravity, m/s^2.
constexpr double pull = 10;

Problem ball_on_floor(double e = 0.5) {
  Problem p;
  p.world.gravity = Vec3(0, -pull, 0);
  p.plane(Vec3::Zero(), Vec3(0, 1, 0));
  p.ball(Vec3(0, 0.5, 0), Vec3::Zero(), 2, 0.5, e);
  return p;
}

/// Three balls in a row that touch, far from everything.
Problem three_in_a_row(double e) {
  Problem p;
  for (int k = 0; k < 3; ++k) p.ball(Vec3(k, 0, 0), Vec3::Zero(), 1, 0.5, e);
  return p;
}

TEST(CollapseDetector, FindsImpactsInTurnAtOnePlace) {
  ExactParts parts(three_in_a_row(0.5));
  // So many impacts leave exp(-8) of the speeds.
  for (int k = 0; k < 32; ++k)
    EXPECT_FALSE(parts.collapses.count_impact(1, k % 2 == 0 ? 0 : 2, 0.5, 1, 0, 1, false)) << k;
  EXPECT_TRUE(parts.collapses.count_impact(1, 0, 0.5, 1, 0, 1, false));
  EXPECT_TRUE(parts.collapses.ended_now(1));
}

TEST(CollapseDetector, BeginsAnewWhereABodyHasComeAway) {
  ExactParts parts(three_in_a_row(0.5));
  for (int k = 0; k < 200; ++k) {
    parts.bodies.now = {1e-3 * k, 0};
    EXPECT_FALSE(parts.collapses.count_impact(1, k % 2 == 0 ? 0 : 2, 0.5, 1, 0, 1, false)) << k;
  }
}

TEST(CollapseDetector, NeverEndsElasticImpacts) {
  ExactParts parts(three_in_a_row(1));
  for (int k = 0; k < 200; ++k)
    EXPECT_FALSE(parts.collapses.count_impact(1, k % 2 == 0 ? 0 : 2, 1, 1, 0, 1, false)) << k;
}

TEST(FlatContacts, CarryABodyThatTouchesFromTheStart) {
  ExactParts parts(ball_on_floor());
  parts.flat.find_initial(0);
  EXPECT_TRUE(parts.flat.carries(0, 1));
  EXPECT_TRUE(parts.bodies.flights[0].a.isZero(0));
  EXPECT_EQ(parts.bodies.log.tally().resting, 1u);
}

TEST(FlatContacts, LetABodySlideAndLiftOff) {
  ExactParts parts(ball_on_floor());
  parts.flat.find_initial(0);
  EXPECT_EQ(parts.flat.keep_at(0, Vec3(3, 0, 0)), Vec3(3, 0, 0));
  EXPECT_TRUE(parts.flat.carries(0, 1));
  EXPECT_EQ(parts.flat.keep_at(0, Vec3(0, 1, 0)), Vec3(0, 1, 0));
  EXPECT_FALSE(parts.flat.carries(0, 1));
  EXPECT_EQ(parts.bodies.log.tally().resting, 0u);
}

TEST(FlatContacts, ReportTheWeight) {
  ExactParts parts(ball_on_floor());
  parts.flat.find_initial(0);
  vector<ContactForce> forces;
  parts.flat.report(0, forces);
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_NEAR(forces[0].force, 2 * pull, 1e-12);
  EXPECT_EQ(parts.flat.acceleration_without(0, 1).u, Vec3(0, -pull, 0));
}

TEST(FlatContacts, TakeWhatTheLastBounceLeft) {
  ExactParts parts(ball_on_floor());
  parts.flat.add(0, {1, 0, Vec3(0, 1, 0), true, {1, 0}, 0.1});
  EXPECT_DOUBLE_EQ(parts.bodies.log.tally().energy_lost, 0.5 * 2 * 0.01);
  parts.bodies.now = {1, 0};
  parts.flat.end_bounces(0);
  EXPECT_FALSE(parts.flat.of(0).at[0].settling);
}

TEST(FlightChanges, BookWhatContactTookFromAFlight) {
  ExactParts parts(ball_on_floor());
  parts.bodies.flights.accelerate(0, Vec3::Zero());  // carried
  parts.flights.book(0, Vec3(0, 0.5 - 3, 0), parts.bodies.now);
  EXPECT_EQ(parts.bodies.log.tally().energy_lost, 0);  // it is not from an impact
  EXPECT_EQ(parts.bodies.log.tally().method_error, 2 * pull * 3);
}

TEST(FlightChanges, NeverMakeAnOldEventFresh) {
  ExactParts parts(three_in_a_row(1));
  parts.bodies.body[1].event = ExactEvent{{1, 0}, 0, 1, 0, ExactEvent::Kind::body_body};
  for (int k = 0; k < 0xffff; ++k) parts.flights.count(0);
  EXPECT_EQ(parts.bodies.body[0].version, 1);
  EXPECT_EQ(parts.bodies.body[1].event.partner_version, 0);
}

TEST(ExactImpacts, ExchangeVelocitiesOfEqualMasses) {
  Problem p = three_in_a_row(1);
  p.initial.velocity[0] = Vec3(2, 1, 0);
  ExactParts parts(p);
  parts.impacts.collide_pair(0, 1, 0);
  EXPECT_EQ(parts.bodies.flights[0].v, Vec3(0, 1, 0));
  EXPECT_EQ(parts.bodies.flights[1].v, Vec3(2, 0, 0));
  ASSERT_EQ(parts.bodies.log.collisions().size(), 1u);
  EXPECT_EQ(parts.bodies.log.collisions()[0].impulse, 2);
}

TEST(ExactGroup, WakesAllThatTouch) {
  ExactParts parts(three_in_a_row(0.5));
  for (Entity i = 0; i < 3; ++i) parts.modes.fall_asleep(i);
  EXPECT_EQ(parts.bodies.log.tally().resting, 3u);
  parts.group.join(0);
  EXPECT_EQ(parts.bodies.islands.of(0).members.size(), 3u);
  EXPECT_EQ(parts.bodies.log.tally().resting, 0u);
}

TEST(ExactGroup, IsJoinedByBodiesThatPressOnEachOtherFromTheStart) {
  Problem p = ball_on_floor();
  p.ball(Vec3(0, 1.5, 0), Vec3::Zero());
  ExactParts parts(p);
  parts.flat.find_initial(0);
  parts.group.join_initial(1);
  EXPECT_EQ(parts.bodies.islands.of(1).members.size(), 2u);
}

TEST(CrowdMotion, PutsToRestWhatForcesHold) {
  ExactParts parts(ball_on_floor());
  parts.group.join(0);
  parts.bodies.islands.of(0).busy = true;
  EXPECT_TRUE(parts.crowds.advance(0));
  EXPECT_EQ(parts.bodies.mode(0), Mode::asleep);
  ASSERT_EQ(parts.group.pressing[0].size(), 1u);
  EXPECT_NEAR(parts.group.pressing[0][0].force, 2 * pull, 1e-9);
  EXPECT_FALSE(parts.bodies.islands.any());
}

TEST(CrowdMotion, KeepsAMemberOutOfTheFloorUntilTheStepEnds) {
  Problem p = ball_on_floor();
  p.initial.velocity[0] = Vec3(1, 0, 0);
  ExactParts parts(p);
  parts.group.join(0);
  parts.bodies.flights.accelerate(0, Vec3::Zero());
  parts.bodies.islands.of(0).busy = true;
  EXPECT_TRUE(parts.crowds.advance(0));
  const Instant end = parts.bodies.islands.of(0).end;
  ASSERT_GT(end.hi, 0);
  EXPECT_GE(parts.bodies.flights[0].position(end.hi).y(), 0.5 - 1e-12);
  EXPECT_EQ(parts.bodies.log.tally().resting, 1u);
}

TEST(ConstrainedMotion, KeepsToACurvedSurface) {
  Problem p;
  p.world.gravity = Vec3(0, -pull, 0);
  p.obstacle(Vec3::Zero(), Volume::sphere(1));
  p.ball(Vec3(0, 1.5, 0), Vec3(0.5, 0, 0));
  ExactParts parts(p);

  parts.group.join(0);
  ASSERT_TRUE(parts.constrained.advance(0));
  const Island& island = parts.bodies.islands.of(0);
  EXPECT_EQ(parts.bodies.mode(0), Mode::held);

  const double end = island.end.hi;
  ASSERT_GT(end, 0);
  for (const double t : {0.5 * end, end}) EXPECT_NEAR(parts.bodies.flights[0].position(t).norm(), 1.5, 1e-10);

  vector<ContactForce> forces;
  parts.constrained.report(island, 0, forces);
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_NEAR(forces[0].force, pull - 0.25 / 1.5, 1e-12);  // m (pull - v^2 / r)
}

TEST(ConstrainedMotion, LeavesAnIslandWhoseContactsChangeTooOftenToACrowd) {
  Problem p;
  p.world.gravity = Vec3(0, -pull, 0);
  p.obstacle(Vec3::Zero(), Volume::sphere(1));
  p.ball(Vec3(0, 1.5, 0), Vec3(0.5, 0, 0));
  ExactParts parts(p);
  parts.group.join(0);
  uint32_t changes = 0;
  while (changes < 100 && parts.constrained.advance(0)) parts.bodies.now = {1e-6 * ++changes, 0};
  EXPECT_EQ(changes, exact_tolerance::many_changes + 1);  // none of them is the start
  EXPECT_TRUE(parts.bodies.islands.of(0).busy);
}

TEST(ConstrainedMotion, SplitsAnIslandThatNoContactConnects) {
  Problem p;
  for (int k = 0; k < 3; ++k) p.ball(Vec3(2.0 * k, 0, 0), Vec3(k, 0, 0));
  ExactParts parts(p);
  for (Entity i = 0; i < 3; ++i) {
    parts.group.join(i);
    parts.group.unite(0, i);
  }
  ASSERT_TRUE(parts.constrained.advance(0));
  EXPECT_FALSE(parts.bodies.islands.same(0, 1));
  EXPECT_FALSE(parts.bodies.islands.same(1, 2));
}

Problem two_lumps() {
  Problem p;
  p.options.merge = true;
  p.ball(Vec3(0, 0, 0), Vec3(4, 0, 0), 1);
  p.ball(Vec3(1, 0, 0), Vec3(0, 0, 0), 3, 0.5, 0);
  return p;
}

TEST(MergedBodies, HaveTheSumOfMassesAndVolumes) {
  const Problem p = two_lumps();
  MergedBodies merged(p.world, true);
  EXPECT_FALSE(merged.any());
  merged.join(1, 0);
  EXPECT_EQ(merged.world().mass[1], 4);
  EXPECT_DOUBLE_EQ(pow(merged.world().radius[1], 3), 2 * 0.125);
  EXPECT_EQ(merged.world().restitution[1], 0.25);
  EXPECT_EQ(merged.whole_of()[0], 1u);
  EXPECT_EQ(merged.given().mass[1], 3);
}

TEST(MergedBodies, FeelTheForcesOnTheirParts) {
  Problem p = two_lumps();
  p.world.forces.push_back({UniformForce{Vec3(8, 0, 0)}, 0, 5, {0}});
  MergedBodies merged(p.world, true);
  merged.join(1, 0);
  EXPECT_EQ(merged.applied(1, 0).all, merged.applied(0, 0).all / 4);
  EXPECT_EQ(merged.next_switch(1, 0), 5);
}

TEST(BodyMerging, KeepsMomentumAndTheCentreOfMass) {
  ExactParts parts(two_lumps());
  parts.merging.merge(0, 1, parts.bodies.touch_at(0, Vec3(0, 0, 0), 1, Vec3(1, 0, 0), 0));
  EXPECT_EQ(parts.bodies.flights[1].v, Vec3(1, 0, 0));
  EXPECT_EQ(parts.bodies.flights[1].x, Vec3(0.75, 0, 0));
  EXPECT_EQ(parts.bodies.log.tally().energy_lost, 0.5 * 0.75 * 16);
  EXPECT_EQ(parts.bodies.log.tally().merges, 1u);
}

TEST(PathLog, RecordsAPathOnceAnInstant) {
  Problem p = three_in_a_row(1);
  p.options.record_paths = true;
  ExactParts parts(p);
  for (const Entity i : {2u, 0u, 2u}) parts.paths.note_change(i);
  parts.paths.record_changes();
  ASSERT_EQ(parts.paths.pieces().size(), 2u);
  EXPECT_EQ(parts.paths.pieces()[0].body, 0u);
  EXPECT_EQ(parts.paths.pieces()[1].body, 2u);
  parts.paths.begin_advance();
  EXPECT_TRUE(parts.paths.pieces().empty());
}

TEST(PathLog, RecordsNothingUnlessRequested) {
  ExactParts parts(three_in_a_row(1));
  parts.paths.note_change(0);
  parts.paths.record_changes();
  EXPECT_TRUE(parts.paths.pieces().empty());
}

TEST(ExactSimulator, TallyDoesNotDependOnWhetherStatesAreRead) {
  Problem p = ball_on_floor(0.6);
  p.initial.position[0] = Vec3(0, 3, 0);
  p.initial.velocity[0] = Vec3(1, 0, 0.1);
  p.ball(Vec3(0.3, 5, 0.1), Vec3(0, -7, 0), 1, 0.4, 0.3);
  p.options.duration = 4;

  const auto silent = make_exact_simulator(p.world, p.initial, p.options);
  const auto requested = make_exact_simulator(p.world, p.initial, p.options);
  for (int k = 1; k <= 40; ++k) {
    while (requested->time() < 0.1 * k) requested->advance_to(0.1 * k);
    requested->state();
    requested->contacts();
  }

  while (silent->time() < 4) silent->advance_to(4);
  EXPECT_EQ(silent->tally().energy_lost, requested->tally().energy_lost);
  EXPECT_EQ(silent->tally().fastest.speed, requested->tally().fastest.speed);
  EXPECT_EQ(silent->tally().work, requested->tally().work);

  const Tally before = silent->tally();
  silent->state();
  EXPECT_EQ(silent->tally().energy_lost, before.energy_lost);
}

TEST(ExactSimulator, TallyAtTheEndHasTheLastFlights) {
  Problem p;
  p.world.gravity = Vec3(0, -pull, 0);
  p.ball(Vec3::Zero(), Vec3::Zero());
  p.options.duration = 2;
  const auto simulator = make_exact_simulator(p.world, p.initial, p.options);
  simulator->advance_to(2);
  EXPECT_EQ(simulator->tally().fastest.speed, 2 * pull);
}

/// Takes the first step of body 0 as a crowd.
void step_as_a_crowd(ExactParts& parts) {
  parts.group.join(0);
  parts.bodies.islands.of(0).busy = true;
  EXPECT_TRUE(parts.crowds.advance(0));
}

TEST(CrowdMotion, CarriesABodyThatFellWithoutLettingItFallOn) {
  ExactParts parts(ball_on_floor());
  step_as_a_crowd(parts);
  EXPECT_EQ(parts.bodies.mode(0), Mode::asleep);
  EXPECT_TRUE(parts.bodies.flights[0].a.isZero(0));
  EXPECT_TRUE(parts.bodies.flights[0].v.isZero(0));
}

// The ball falls on the floor within the step. Contact takes m (v^2 - v'^2) / 2 and the weight's work on the way.
TEST(CrowdMotion, BooksWhatContactTakesUpToAnyInstantOfAStep) {
  const double v = 0.02, m = 2;
  for (const double part : {0.25, 0.5, 1.0}) {
    Problem p = ball_on_floor();
    p.initial.position[0].y() += 1e-5;
    p.initial.velocity[0] = Vec3(0.1, -v, 0);
    ExactParts parts(p);
    step_as_a_crowd(parts);

    ASSERT_TRUE(parts.bodies.mode(0) == Mode::stepped);
    EXPECT_NEAR(parts.bodies.log.tally().energy_lost, 0.5 * m * v * v, 1e-15);

    const Instant end = parts.bodies.islands.of(0).end;
    const Instant at = Instant{} + part * end.hi;
    const double slower = parts.bodies.velocity_without_kick(0, at).y();
    const double drift = parts.bodies.flights[0].v.y();

    parts.crowds.book_last(parts.bodies.islands.of(0), at.hi);
    const double lost = m * (0.5 * (v * v - slower * slower) - pull * drift * at.hi);
    EXPECT_NEAR(parts.bodies.log.tally().energy_lost + parts.bodies.log.tally().method_error, lost, 1e-15);
  }
}

TEST(CrowdMotion, SlidesABodyOverTilesAsOverOneFloor) {
  for (const double speed : {0.1, 1.0, 10.0}) {
    Problem p;
    p.world.gravity = Vec3(0, -pull, 0);
    for (int k = -4; k < 4; ++k) p.obstacle(Vec3(k + 0.5, -0.25, 0), Volume::box({1, 0.5, 4}));
    p.ball(Vec3(-0.01, 0.5, 0), Vec3(speed, 0, 0), 2, 0.5, 0.5);
    ExactParts parts(p);
    step_as_a_crowd(parts);
    EXPECT_TRUE(parts.bodies.mode(0) == Mode::stepped);
    EXPECT_EQ(parts.bodies.flights[0].v.x(), speed);
    EXPECT_NEAR(parts.bodies.flights[0].v.y(), 0, 1e-15 * speed);
  }
}

}  // namespace
}  // namespace carom
