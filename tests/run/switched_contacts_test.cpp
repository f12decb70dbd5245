// Contact forces at the very instant at which something starts or ends: those from that instant on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/engine.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom::testing {
namespace {

/// 20 balls of 1 kg in a box, which time steps have put to rest by 4 s. `floor`: more keys of its floor.
string pile(const string& more, const string& floor = "") {
  return "scene: 1\nseed: 3\ngravity: [0, -10, 0]\nrestitution: 0.2\n"
         "room: {min: [0, -1, 0], max: [0.5, 6, 0.5]}\n"
         "groups: {b: {count: 20, in: {min: [0, 0, 0], max: [0.5, 1.6, 0.5]}, ball: {mass: 1, radius: 0.1}}}\n"
         "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]" +
         floor + "}}\n" + more;
}

struct Pressing {
  double on_floor = 0;  // N
  size_t contacts = 0;
};

Pressing pressing_in(Simulator& simulator, const Scene& scene) {
  Pressing found;
  for (const ContactForce& c : simulator.contacts()) {
    ++found.contacts;
    if (scene.roster.name(c.b) == "floor") found.on_floor += c.force;
  }
  return found;
}

/// The contacts at `time` (s), before which all bodies sleep.
Pressing pressing_at(const string& yaml, double time) {
  const Scene scene = load_text(yaml);
  const auto simulator = make_simulator(scene, {});
  const auto go_to = [&](double until) {
    while (simulator->time() < until) simulator->advance_to(until);
  };
  go_to(time - 0.01);
  EXPECT_GT(simulator->tally().stepped_contact, 0);
  for (const Vec3& v : simulator->state().velocity) EXPECT_EQ(v.norm(), 0);
  EXPECT_NEAR(pressing_in(*simulator, scene).on_floor, 200, 1e-7);
  go_to(time);
  return pressing_in(*simulator, scene);
}

// Crowds leave gaps, which change as the pile wakes: as a share of the force.
constexpr double closing = 8e-5;  // measured: 2e-5

TEST(SwitchedContacts, OfASleepingPileAreThoseFromThatInstantOn) {
  const string end = "simulate: {duration: 5.5}\n";
  const size_t all = pressing_at(pile(end), 5).contacts;
  const Pressing heavier = pressing_at(pile("forces: [{acceleration: [0, -5, 0], from: 5}]\n" + end), 5);
  EXPECT_NEAR(heavier.on_floor, 300, 300 * closing);
  EXPECT_EQ(heavier.contacts, all);
  const Pressing wind = pressing_at(pile("forces: [{drag: {linear: 0.1, wind: [0, -30, 0]}, from: 5}]\n" + end), 5);
  EXPECT_NEAR(wind.on_floor, 260, 260 * closing);
  EXPECT_EQ(wind.contacts, all);
  // 1 N and 0.01 N for each metre above the floor.
  const Pressing spring =
      pressing_at(pile("forces: [{spring: {anchor: [0.25, -100, 0.25], stiffness: 0.01}, from: 5}]\n" + end), 5);
  EXPECT_NEAR(spring.on_floor, 200 + 20 * 1.005, 20 * 0.005);
  EXPECT_NEAR(static_cast<double>(spring.contacts), static_cast<double>(all), 2);  // the weakest change
  // At the run's end.
  const Pressing last =
      pressing_at(pile("forces: [{acceleration: [0, -5, 0], from: 5}]\nsimulate: {duration: 5}\n"), 5);
  EXPECT_NEAR(last.on_floor, 300, 300 * closing);
}

TEST(SwitchedContacts, OfASleepingPileAreThoseAfterAForceHasEnded) {
  const Scene scene =
      load_text(pile("forces: [{acceleration: [0, -5, 0], from: 5, until: 8}]\nsimulate: {duration: 8.5}\n"));
  const auto simulator = make_simulator(scene, {});
  for (const double time : {6.0, 7.99, 8.0, 8.25}) {
    while (simulator->time() < time) simulator->advance_to(time);
    const double load = time < 8 ? 300 : 200;
    EXPECT_NEAR(pressing_in(*simulator, scene).on_floor, load, load * closing) << time;
  }
}

// It starts to rise or to sink, more slowly than impacts count. The first step takes up nearly all of that, from floor
// to top, and the next ones the rest.
TEST(SwitchedContacts, OfASleepingPileOnALiftAreThoseAfterItsStart) {
  for (const char* velocity : {"[0, 0.001, 0]", "[0, 1.0e-7, 0]", "[0, -1.0e-7, 0]"}) {
    const Pressing lifted = pressing_at(
        pile("simulate: {duration: 5.5}\n", string(", motion: [{from: 5, velocity: ") + velocity + "}]"), 5);
    EXPECT_NEAR(lifted.on_floor, 200, 200 * 0.02) << velocity;  // measured: 0.012 with 1 mm/s
  }
}

}  // namespace
}  // namespace carom::testing
