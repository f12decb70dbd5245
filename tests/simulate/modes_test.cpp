// The modes of bodies (modes.h): what moves a body now, and what hangs on it.
#include <gtest/gtest.h>

#include "simulate/exact_parts.h"
#include "simulate/impact/body_removal.h"
#include "simulate/loop/exact_simulator.h"
#include "std.h"

namespace carom {
namespace {

/// A ball of 1 m on a floor, and one on the first.
Problem two_on_a_floor(double height = 0, double e = 0.5) {
  Problem p;
  p.world.gravity = Vec3(0, -10, 0);
  p.plane(Vec3::Zero(), Vec3(0, 1, 0));
  p.ball(Vec3(0, 0.5 + height, 0), Vec3::Zero(), 1, 0.5, e);
  p.ball(Vec3(0, 1.5 + 2 * height, 0), Vec3::Zero(), 1, 0.5, e);
  return p;
}

uint64_t changes_of(const ModeChanges& modes, Mode from, Mode to) {
  return modes.counts()[static_cast<size_t>(from)][static_cast<size_t>(to)];
}

/// Brings body 0 into a mode, by the function that does so in a run.
void bring(ExactParts& parts, Mode mode) {
  switch (mode) {
    case Mode::settling:
      return parts.flat.add(0, {2, 0, Vec3(0, 1, 0), true, {1, 0}, 0.1});
    case Mode::carried:
      return parts.flat.add(0, {2, 0, Vec3(0, 1, 0), false, {}, 0});
    case Mode::fresh:
      return parts.group.join(0);

    case Mode::held:
      parts.group.join(0);
      return parts.modes.constrain(0);

    case Mode::stepped:
      parts.group.join(0);
      return parts.modes.step(0);

    default:
      return;
  }
}

TEST(Modes, OfABallThatFallsOnAFloorAreFlyingSettlingCarried) {
  Problem p = two_on_a_floor(1);
  p.options.duration = 5;
  p.initial.position[1].x() = 3;
  ExactSimulator simulator(p.world, p.initial, p.options);
  simulator.advance_to(5);
  EXPECT_EQ(changes_of(simulator.modes(), Mode::flying, Mode::settling), 2u);
  EXPECT_EQ(changes_of(simulator.modes(), Mode::settling, Mode::carried), 2u);
  EXPECT_EQ(simulator.tally().resting, 2u);
}

TEST(Modes, OfABallThatFallsOnAnotherEndAsleep) {
  Problem p = two_on_a_floor(0.01, 0);
  p.options.duration = 1;
  ExactSimulator simulator(p.world, p.initial, p.options);
  simulator.advance_to(1);
  const ModeChanges& modes = simulator.modes();
  EXPECT_EQ(changes_of(modes, Mode::held, Mode::asleep), 2u);
  EXPECT_EQ(changes_of(modes, Mode::asleep, Mode::fresh), 0u);
  EXPECT_EQ(simulator.tally().resting, 2u);
}

TEST(Modes, TakeASecondSurfaceWithBouncesFromCarriedBackToSettling) {
  ExactParts parts(two_on_a_floor());
  bring(parts, Mode::carried);
  parts.flat.add(0, {3, 0, Vec3(1, 0, 0), true, {1, 0}, 0.1});
  EXPECT_EQ(parts.bodies.mode(0), Mode::settling);
  parts.flat.remove(0, 3);
  EXPECT_EQ(parts.bodies.mode(0), Mode::carried);
  parts.flat.clear(0);
  EXPECT_EQ(parts.bodies.mode(0), Mode::flying);
}

TEST(Modes, CountWhatThingsPressOnAsAtRest) {
  const auto resting = [](const ExactParts& parts) { return parts.bodies.log.tally().resting; };
  ExactParts parts(two_on_a_floor());
  bring(parts, Mode::settling);
  EXPECT_EQ(resting(parts), 1u);

  parts.group.join(0);  // a step has yet to find what presses on it
  EXPECT_EQ(resting(parts), 0u);

  parts.modes.constrain(0);
  parts.modes.press(0, true);
  EXPECT_EQ(resting(parts), 1u);

  parts.modes.step(0);
  EXPECT_EQ(resting(parts), 1u);
  parts.modes.fall_asleep(0);
  EXPECT_EQ(resting(parts), 1u);
  parts.modes.join(0);
  EXPECT_EQ(resting(parts), 0u);
}

TEST(Modes, OfAnIslandAreThatOfItsTimeSteps) {
  ExactParts parts(two_on_a_floor());
  for (const Entity i : {0, 1}) parts.group.join(i);
  parts.modes.constrain(0);
  parts.modes.step(1);
  parts.group.unite(0, 1);
  EXPECT_EQ(parts.bodies.mode(0), Mode::stepped);
  EXPECT_EQ(parts.bodies.mode(1), Mode::stepped);
}

TEST(Modes, OfAFreshBodyThatUnitesWithACrowdAreStepped) {
  ExactParts parts(two_on_a_floor());
  for (const Entity i : {0, 1}) parts.group.join(i);
  parts.modes.step(1);
  parts.bodies.islands.of(1).end = {2, 0};
  parts.group.unite(0, 1);
  EXPECT_EQ(parts.bodies.mode(0), Mode::stepped);
  EXPECT_EQ(parts.bodies.islands.of(0).end, parts.bodies.now);  // its next step is due
}

TEST(Modes, OfARemovedBodyAreGone) {
  for (const Mode mode : {Mode::flying, Mode::settling, Mode::carried, Mode::fresh, Mode::held, Mode::stepped}) {
    ExactParts parts(two_on_a_floor());
    bring(parts, mode);
    ASSERT_EQ(parts.bodies.mode(0), mode);
    BodyRemoval(parts.bodies, parts.modes, parts.group, parts.flat, parts.flights).remove(0);
    EXPECT_EQ(parts.bodies.mode(0), Mode::gone);
    EXPECT_EQ(changes_of(parts.modes, is_free(mode) ? Mode::flying : mode, Mode::gone), 1u);
    EXPECT_EQ(parts.bodies.log.tally().resting, 0u);
    EXPECT_FALSE(parts.bodies.islands.any());
  }
}

TEST(Modes, OfASleeperThatIsRemovedAreFreshBefore) {
  ExactParts parts(two_on_a_floor());
  parts.modes.fall_asleep(0);
  BodyRemoval(parts.bodies, parts.modes, parts.group, parts.flat, parts.flights).remove(0);
  EXPECT_EQ(changes_of(parts.modes, Mode::asleep, Mode::fresh), 1u);
  EXPECT_EQ(changes_of(parts.modes, Mode::fresh, Mode::gone), 1u);
}

TEST(Modes, OfTwoSleepersOnTwoStringsMakeOneIsland) {
  Problem p = two_on_a_floor(1);  // 2 m apart
  for (int k = 0; k < 2; ++k) p.world.strings.push_back({0, 1, Vec3::Zero(), 2});
  ExactParts parts(p);
  parts.modes.fall_asleep(0);
  parts.modes.fall_asleep(1);
  parts.group.join(0);
  EXPECT_EQ(changes_of(parts.modes, Mode::asleep, Mode::fresh), 2u);
  int islands = 0;
  parts.bodies.islands.for_each([&](const Island&) { ++islands; });
  EXPECT_EQ(islands, 1);
}

TEST(Modes, OfABodyThatMergesArePartAndFlyingBefore) {
  for (const Mode mode : {Mode::flying, Mode::settling, Mode::carried, Mode::fresh, Mode::held, Mode::stepped}) {
    Problem p = two_on_a_floor();
    p.options.merge = true;
    p.world.mass[1] = 2;
    ExactParts parts(p);
    bring(parts, mode);

    parts.merging.merge(0, 1, parts.bodies.touch_at(0, p.initial.position[0], 1, p.initial.position[1], 0));
    EXPECT_EQ(parts.bodies.mode(0), Mode::part);
    EXPECT_EQ(parts.bodies.mode(1), Mode::flying);
    EXPECT_EQ(changes_of(parts.modes, Mode::flying, Mode::part), 1u);
    EXPECT_FALSE(parts.bodies.islands.any());
  }
}

TEST(Modes, KeepPartnersOnBothSides) {
  ExactParts parts(two_on_a_floor());
  for (const Entity i : {0, 1}) parts.group.join(i);
  parts.modes.add_partner(0, 1);
  parts.modes.add_partner(0, 2);
  EXPECT_TRUE(parts.modes.are_partners(0, 1) && parts.modes.are_partners(1, 0) && parts.modes.are_partners(0, 2));
  parts.modes.leave(0);
  EXPECT_FALSE(parts.modes.are_partners(0, 1) || parts.modes.are_partners(1, 0) || parts.modes.are_partners(0, 2));
}

}  // namespace
}  // namespace carom
