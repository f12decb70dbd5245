// Fixed things that move: their windows, and what is wrong with some.
#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string things =
    "scene: 1\n"
    "balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}}\n"
    "simulate: {duration: 4}\n";

string with(const string& windows) {
  return things + "planes:\n  floor: {point: [0, 0, 0], normal: [0, 1, 0], motion: " + windows + "}\n";
}

string first_error(const string& windows) {
  const string all = errors_of(with(windows));
  return all.substr(0, all.find('\n'));
}

TEST(Motions, AreWindowsOfConstantVelocity) {
  const Scene scene = load_text(things +
                                "defaults: {wall: {motion: [{velocity: [0, 0, 1]}]}}\n"
                                "room: {min: [-9, -9, -9], max: [9, 9, 9]}\n"
                                "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
                                "walls: {bat: {center: [5, 0, 0], normal: [1, 0, 0], size: [1, 1]}}\n"
                                "obstacles:\n"
                                "  post: {radius: 1, position: [-5, 0, 0], motion: [{from: 1, until: 2, velocity: [0, "
                                "0.5, 0]}, {from: 3, velocity: [2, 0, 0]}]}\n");

  const World& world = scene.world;
  const auto at = [&](Entity e, double time) { return fixed_position(world, e, {time, 0}); };
  ASSERT_EQ(world.fixed_count(), 9u);

  for (Entity e = 1; e < 8; ++e) EXPECT_FALSE(world.moves(e)) << e;
  EXPECT_EQ(at(8, 2.5), Vec3(5, 0, 2.5));
  EXPECT_EQ(at(9, 0.5), Vec3(-5, 0, 0));
  EXPECT_EQ(at(9, 1.5), Vec3(-5, 0.25, 0));
  EXPECT_EQ(at(9, 2.5), Vec3(-5, 0.5, 0));
  EXPECT_EQ(at(9, 4), Vec3(-3, 0.5, 0));
  EXPECT_EQ(fixed_velocity(world, 9, {1, 0}), Vec3(0, 0.5, 0)) << "from its start on";
  EXPECT_EQ(fixed_velocity(world, 9, {2, 0}), Vec3(0, 0, 0)) << "until its end";
}

TEST(Motions, WithoutVelocityAreNone) {
  EXPECT_FALSE(load_text(with("[]")).world.moves());
  EXPECT_FALSE(load_text(with("[{velocity: [0, 0, 0]}]")).world.moves());
}

TEST(MotionErrors, NameThePlaceAndTheRemedy) {
  EXPECT_EQ(in_parts(errors_of(with("[{until: 2, velocity: [0, 1, 0]}, {from: 1, velocity: [0, 1, 0]}]"))),
            (Parts{{"5:97 1", "this window starts at 1 s, but the one before it ends at 2 s",
                    "expected windows in order that do not overlap, each with `until` except the last"}}));
  EXPECT_EQ(first_error("[{velocity: [0, 1, 0]}, {from: 1, velocity: [0, 1, 0]}]"),
            "scene.yaml:5:87: error: this window starts at 1 s, but the one before it never ends");
  EXPECT_EQ(first_error("[{from: 1, until: 1, velocity: [0, 1, 0]}]"),
            "scene.yaml:5:74: error: `until` is 1 but `from` is 1");
  EXPECT_EQ(first_error("[{from: 1}]"), "scene.yaml:5:57: error: this entry of `motion` has no `velocity`");
  EXPECT_EQ(first_error("{velocity: [0, 1, 0]}"), "scene.yaml:5:56: error: `motion` is a map of keys");

  EXPECT_EQ(
      first_error("[{velocity: [0, 1e20, 0]}]"),
      "scene.yaml:5:56: error: `floor` goes as far as 4e+20 m from the origin, more than 1e+12 times the smallest "
      "size, 0.1 m");
  EXPECT_EQ(errors_of(things + "room: {min: [-1, -1, -1], max: [2, 2, 2], motion: []}\n").substr(0, 61),
            "scene.yaml:4:43: error: unknown key `motion` in `room`\n   4 |");
}

TEST(MotionErrors, TheBooksEngineHasNone) {
  string text = with("[{velocity: [0, 1, 0]}]");
  text.replace(text.find("duration: 4"), 11, "duration: 4, engine: book");
  EXPECT_NE(errors_of(text).find("`engine: book` has no fixed things that move"), string::npos);
}

TEST(Motions, AreInTheResolvedScene) {
  const string windows = "[{from: 0.5, until: 1, velocity: [0, 1, 0]}, {from: 2, velocity: [0, -1, 0]}]";
  const Scene scene = load_text(with(windows));
  EXPECT_NE(scene.resolved.find("motion: " + windows), string::npos) << scene.resolved;
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
}

}  // namespace
}  // namespace carom
