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
  EXPECT_EQ(first_error("[{from: 1}]"), "scene.yaml:5:57: error: this entry of `windows` has no `velocity`");
  EXPECT_EQ(first_error("{velocity: [0, 1, 0]}"),
            "scene.yaml:5:48: error: `motion` has no `windows` and no `sine` and no `circle`");

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
  EXPECT_NE(scene.resolved.find("motion: " + windows + ","), string::npos) << scene.resolved;
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
}

TEST(Motions, MayRepeat) {
  const Scene scene =
      load_text(with("{every: 2, windows: [{from: 0.5, until: 1, velocity: [0, 1, 0]}, {from: 1.5, "
                     "velocity: [0, -0.5, 0]}]}"));
  const auto height = [&](double time) { return fixed_position(scene.world, 1, {time, 0}).y(); };
  EXPECT_EQ(height(1.25), 0.5);
  EXPECT_EQ(height(2), 0.25) << "a window without an end lasts until the next period";
  EXPECT_EQ(height(2.75), 0.5) << "from where it has arrived";
  EXPECT_EQ(height(2001), 1000 * 0.25 + 0.5);
}

TEST(Motions, MaySwingOrGoRound) {
  const Scene scene = load_text(
      things +
      "planes: {floor: {point: [0, -1, 0], normal: [0, 1, 0], motion: {sine: {amplitude: [0, 0.25, 0], period: 4, "
      "phase: -90}}}}\n"
      "walls: {gate: {center: [3, 0, 0], normal: [1, 0, 0], size: [1, 1], motion: {circle: {center: [5, 7, 0], axis: "
      "[0, -2, 0], period: 8}}}}\n");
  const auto at = [&](Entity e, double time) { return fixed_position(scene.world, e, {time, 0}); };
  EXPECT_EQ(scene.world.planes[0].point, Vec3(0, -1.25, 0)) << "its place at time 0";
  EXPECT_EQ(at(1, 1), Vec3(0, -1, 0));
  EXPECT_EQ(at(1, 2), Vec3(0, -0.75, 0));
  EXPECT_EQ(at(1, 4e6 + 3), Vec3(0, -1, 0));
  EXPECT_EQ(fixed_velocity(scene.world, 1, {2, 0}).y(), 0);

  // Seen against the axis, from below, it goes to the left.
  EXPECT_LT((at(2, 2) - Vec3(5, 0, -2)).norm(), 1e-15);
  EXPECT_LT((at(2, 4) - Vec3(7, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(at(2, 8), Vec3(3, 0, 0));
}

TEST(Motions, HaveEntriesInPathsWithAndWithoutTheirKey) {
  LoadOptions options;
  for (const char* path : {"planes.floor.motion.0.velocity", "planes.floor.motion.windows.0.velocity"}) {
    options.set = {string(path) + "=[0, 3, 0]"};
    EXPECT_EQ(fixed_velocity(load_text(with("[{velocity: [0, 1, 0]}]"), options).world, 1, {1, 0}), Vec3(0, 3, 0));
  }
}

TEST(MotionErrors, OfWhatRepeatsSwingsOrGoesRoundNameThePlaceAndTheRemedy) {
  const string window = "{from: 1, until: 3, velocity: [0, 1, 0]}";
  EXPECT_EQ(in_parts(errors_of(with("{every: 2, windows: [" + window + "]}"))),
            (Parts{{"5:94 3", "this window ends at 3 s, but the windows repeat every 2 s",
                    "expected windows from 0 to `every`"}}));
  EXPECT_EQ(in_parts(errors_of(with("{every: 2, windows: [{from: 2, velocity: [0, 1, 0]}]}"))),
            (Parts{{"5:84 2", "`every` is 2 but `from` is 2", "expected from < every"}}));
  EXPECT_EQ(first_error("{every: 2, windows: [{until: 1, velocity: [0, 1, 0]}, {from: 0.5, velocity: [0, 1, 0]}]}"),
            "scene.yaml:5:117: error: this window starts at 0.5 s, but the one before it ends at 1 s");
  EXPECT_EQ(first_error("{every: 0, windows: []}"), "scene.yaml:5:64: error: `every` is 0");

  // Keys that are missing or exclude one another.
  EXPECT_EQ(first_error("{every: 2}"),
            "scene.yaml:5:48: error: `motion` has no `windows` and no `sine` and no `circle`");
  EXPECT_EQ(first_error("{every: 2, sine: {amplitude: [0, 1, 0], period: 1}}"),
            "scene.yaml:5:57: error: `motion` has `every` but no `windows`");
  EXPECT_EQ(first_error("{sine: {amplitude: [0, 1, 0], period: 0}}"), "scene.yaml:5:94: error: `period` is 0");
  EXPECT_EQ(first_error("{sine: {period: 1}}"), "scene.yaml:5:57: error: `sine` has no `amplitude`");
  EXPECT_EQ(first_error("{sine: {amplitude: [0, 1, 0], period: 1}, "
                        "circle: {center: [0, 1, 0], axis: [1, 0, 0], period: 1}}"),
            "scene.yaml:5:98: error: `motion` has both `sine` and `circle`");

  // Motions that are none, or too fast or far.
  EXPECT_EQ(first_error("{circle: {center: [0, 1, 0], axis: [0, 0, 0], period: 1}}"),
            "scene.yaml:5:91: error: `axis` has no length");
  EXPECT_EQ(in_parts(errors_of(with("{circle: {center: [0, 1, 0], axis: [0, 1, 0], period: 1}}"))),
            (Parts{{"5:65 {", "the axis goes through this thing's place, so that it would not move",
                    "expected another `center` or `axis`, or no `motion`"}}));
  EXPECT_EQ(first_error("{sine: {amplitude: [0, 1, 0], period: 1e-30}}"),
            "scene.yaml:5:56: error: `floor` moves at up to 6.283185307179585e+30 m/s");
  EXPECT_EQ(
      first_error("{sine: {amplitude: [0, 1e15, 0], period: 1}}"),
      "scene.yaml:5:56: error: `floor` goes as far as 1e+15 m from the origin, more than 1e+12 times the smallest "
      "size, 0.1 m");
  EXPECT_EQ(first_error("{sine: {amplitude: [0, 1, 0], period: 1, phase: 1e4}}"),
            "scene.yaml:5:104: error: `phase` is 1e4");
}

}  // namespace
}  // namespace carom
