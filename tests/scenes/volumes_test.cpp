// Scenes of volumes, timed forces, merging and rest, against their comments and the closed forms.
#include <gtest/gtest.h>

#include "engine/engine.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

double force(const vector<ContactForce>& contacts, Entity a, Entity b) {
  for (const ContactForce& c : contacts) {
    if (c.a == a && c.b == b) return c.force;
  }
  return 0;
}

vector<ContactForce> contacts_at(const Scene& scene, double time) {
  const auto simulator = make_simulator(scene);
  do simulator->advance_to(time);
  while (simulator->time() < time);
  const auto contacts = simulator->contacts();
  return {contacts.begin(), contacts.end()};
}

TEST(RollingOff, LeavesAtTwoThirdsOfTheHeight) {
  const string file = "rolling_off";
  const double leave = stated(file, "it leaves at t = "), land = stated(file, "strikes the floor at t = ");
  const Played run = play(file, {leave});
  EXPECT_NEAR(run.states[0].position[0].x(), stated(file, "leaves at x = "), 1e-9);
  EXPECT_NEAR(run.states[0].position[0].y(), 0.384, 1e-9);
  EXPECT_NEAR(run.states[0].velocity[0].norm(), sqrt(0.384 * g_n), 1e-9);
  ASSERT_FALSE(run.collisions.empty());
  EXPECT_NEAR(run.collisions.back().time, land, 1e-9);
  EXPECT_NEAR(run.collisions.back().position.x(), stated(file, "its centre at x = "), 1e-9);
  EXPECT_NEAR(force(contacts_at(run.scene, 0), 0, run.number("globe")), 0.96 * g_n, 1e-12);
  EXPECT_TRUE(contacts_at(run.scene, (leave + land) / 2).empty());
}

TEST(Crates, FallOnceTheLowestIsPast) {
  const Played run = play("crates");
  const auto strikes = run.of("ball");
  ASSERT_EQ(strikes.size(), 1u);
  EXPECT_NEAR(strikes[0].time, 0.3875, 1e-15);
  EXPECT_NEAR(run.velocity("low").x(), 8.0 / 3, 1e-14);
  EXPECT_NEAR(run.of("middle").back().time, 0.575 + sqrt(1 / g_n), 1e-13);
  EXPECT_NEAR(run.position("high").y(), 0.75, 1e-13);
  const auto contacts = contacts_at(run.scene, 0.1);
  EXPECT_NEAR(force(contacts, run.number("middle"), run.number("high")), 10 * g_n, 1e-10);
  EXPECT_NEAR(force(contacts, run.number("low"), run.number("middle")), 20 * g_n, 1e-10);
  EXPECT_NEAR(force(contacts, run.number("low"), run.number("floor")), 30 * g_n, 1e-10);
}

TEST(Gust, PushesForItsSecond) {
  const Played run = play("gust");
  EXPECT_NEAR(run.position("light").x(), 8, 1e-14);
  EXPECT_NEAR(run.position("heavy").x(), 2, 1e-14);
  EXPECT_NEAR(run.position("rider").x(), 3, 1e-14);
  EXPECT_NEAR(run.tally.work, 19, 1e-13);
}

TEST(Clay, SticksWithMassMomentumCentreAndVolume) {
  const string file = "clay";
  const Played run = play(file);
  ASSERT_EQ(run.collisions.size(), 2u);
  EXPECT_NEAR(run.collisions[0].time, 7.0 / 30, 1e-15);
  EXPECT_NEAR(run.collisions[1].time, stated(file, "it meets large at t = "), 1e-14);
  EXPECT_EQ(run.tally.merges, 2u);
  EXPECT_NEAR(run.tally.energy_lost, 4.5 - 0.125, 1e-14);
  EXPECT_NEAR(run.end.velocity[0].x(), 3.0 / 36, 1e-15);
}

TEST(Pyramid, HasTheForcesOfStatics) {
  const Played run = play("pyramid");
  const auto contacts = contacts_at(run.scene, 0.5);
  EXPECT_EQ(contacts.size(), 6u);
  EXPECT_NEAR(force(contacts, run.number("left"), run.number("top")), g_n / 1.2, 1e-12);
  EXPECT_NEAR(force(contacts, run.number("left"), run.number("left_wall")), 2 * g_n / 3, 1e-12);
  EXPECT_NEAR(force(contacts, run.number("right"), run.number("floor")), 1.5 * g_n, 1e-12);
  EXPECT_EQ(run.velocity("top").norm(), 0);
}

TEST(PileAtRest, PressesWithItsWeight) {
  SLOW_WITH_SANITIZERS();
  const Played run = play("pile_at_rest");
  EXPECT_EQ(run.tally.resting, 40u);
  double floor = 0;
  for (const ContactForce& c : contacts_at(run.scene, 10)) floor += c.b == run.number("room.y_min") ? c.force : 0;
  EXPECT_NEAR(floor, 40 * g_n, 1e-9 * 40 * g_n);
}

TEST(TenPins, BallAndPinsAreStruckInOrder) {
  const string file = "ten_pins";
  const Played run = play(file);
  const auto first = run.of("pin_1");
  ASSERT_GE(first.size(), 2u);
  EXPECT_NEAR(first[0].time, stated(file, "m / 6 m/s = "), 1e-14);
  EXPECT_NEAR(first[1].time, stated(file, "meets pin_5 at "), 1e-14);
}

}  // namespace
}  // namespace carom::testing
