// Hollow obstacles: their parts, their names, and what is wrong with some.
#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/motion_text.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string one_ball =
    "scene: 1\n"
    "balls: {red: {mass: 1, radius: 0.1, position: [0, 0.2, 0]}}\n"
    "simulate: {duration: 1}\n";

Parts faults_of(const string& written) {
  return in_parts(errors_of(one_ball + written));
}

vector<string> names_of(const Scene& scene) {
  vector<string> names;
  for (const FixedLook& fixed : scene.roster.fixed) names.push_back(fixed.name);
  return names;
}

TEST(HollowObstacles, AreShellsAndThinEnds) {
  const Scene scene = load_text(one_ball +
                                "obstacles:\n"
                                "  bowl: {inside: true, radius: 1, open: top, position: [0, 0, 0], restitution: 0.5}\n"
                                "  tube: {inside: true, cylinder: {radius: 0.5, height: 2}, position: [3, 0, 0]}\n"
                                "  post: {radius: 0.1, position: [9, 0, 0]}\n");
  EXPECT_EQ(names_of(scene), (vector<string>{"bowl", "tube.side", "tube.bottom", "tube.top", "post"}));

  const vector<Obstacle>& obstacles = scene.world.obstacles;
  EXPECT_EQ(obstacles[0].hollow, Hollow::lower_half);
  EXPECT_EQ(obstacles[0].restitution, 0.5);
  EXPECT_EQ(obstacles[1].hollow, Hollow::side);
  EXPECT_EQ(obstacles[1].volume, Volume::cylinder(0.5, 2));
  EXPECT_EQ(obstacles[2].center, Vec3(3, -1, 0));
  EXPECT_EQ(obstacles[2].volume, Volume::cylinder(0.5, 0));
  EXPECT_EQ(obstacles[3].center, Vec3(3, 1, 0));
  EXPECT_EQ(obstacles[4].hollow, Hollow::none);
}

TEST(HollowObstacles, LackTheEndsThatAreOpen) {
  const auto names = [](const string& open) {
    return names_of(load_text(
        one_ball +
        "obstacles:\n  t: {inside: true, cylinder: {radius: 1, height: 2}, position: " + "[0, 0, 0], open: " + open +
        "}\n  b: {inside: true, box: [1, 2, 3], position: " + "[0, 0, 0], open: " + open + "}\n"));
  };
  EXPECT_EQ(names("top"),
            (vector<string>{"t.side", "t.bottom", "b.x_min", "b.x_max", "b.y_min", "b.z_min", "b.z_max"}));
  EXPECT_EQ(names("bottom"),
            (vector<string>{"t.side", "t.top", "b.x_min", "b.x_max", "b.y_max", "b.z_min", "b.z_max"}));
  EXPECT_EQ(names("both"), (vector<string>{"t.side", "b.x_min", "b.x_max", "b.z_min", "b.z_max"}));
}

TEST(HollowObstacles, HaveNamesAsAWholeAndByParts) {
  const Scene scene = load_text(one_ball +
                                "obstacles:\n"
                                "  t: {repeat: 2, inside: true, cylinder: {radius: 1, height: 2}, position: "
                                "['= 5 * i', 0, 0], motion: [{from: 0, until: 1, velocity: [0, 1, 0]}]}\n"
                                "restitution: {pairs: [{between: [red, t], value: 0.5}, {between: [red, t.1], value: "
                                "0.25}, {between: [red, t.1.bottom], value: 0.125}]}\n");
  const vector<PairRestitution>& pairs = scene.world.pairs;
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].b_first, 1u);
  EXPECT_EQ(pairs[0].b_count, 6u);

  EXPECT_EQ(pairs[1].b_first, 4u);
  EXPECT_EQ(pairs[1].b_count, 3u);
  EXPECT_EQ(pairs[2].b_first, 5u);
  EXPECT_EQ(pairs[2].b_count, 1u);

  // All parts move.
  for (Entity e = 1; e <= 6; ++e) EXPECT_TRUE(scene.world.moves(e));
  // What is resolved is the same scene.
  EXPECT_EQ(motion_text(load_text(scene.resolved)), motion_text(scene));
}

TEST(HollowObstacles, MayHoldABodyOrStandBesideIt) {
  const string bowl = "obstacles: {bowl: {inside: true, radius: 1, position: [";
  EXPECT_EQ(errors_of(one_ball + bowl + "0, 0, 0]}}\n"), "");
  EXPECT_EQ(errors_of(one_ball + bowl + "3, 0, 0]}}\n"), "");
  EXPECT_EQ(
      faults_of(bowl + "0, -0.75, 0]}}\n"),
      (Parts{{"2:47 [", "`red` overlaps `bowl` by 0.05 m at the start", "expected bodies apart, or just touching"}}));
  EXPECT_EQ(
      faults_of("obstacles: {t: {inside: true, cylinder: {radius: 0.3, height: 1}, position: [0.25, 0.2, 0]}}\n"),
      (Parts{{"2:47 [", "`red` overlaps `t.side` by 0.05 m at the start", "expected bodies apart, or just touching"}}));
}

TEST(HollowObstacles, RefuseKeysThatContradictOneAnother) {
  EXPECT_EQ(
      faults_of("obstacles: {a: {radius: 1, position: [5, 0, 0], open: top}}\n"),
      (Parts{{"4:55 top", "`a` has an opening and is solid", "expected `inside: true` beside `open`, or no `open`"}}));
  EXPECT_EQ(faults_of("obstacles: {a: {inside: true, radius: 1, position: [5, 0, 0], open: both}}\n"),
            (Parts{{"4:69 both", "a sphere is open at the top or at the bottom, not at both",
                    "expected `open: top`, its lower half, `open: bottom`, its upper half, or a `cylinder`"}}));
  EXPECT_EQ(faults_of("obstacles: {a: {inside: 1, radius: 1, position: [5, 0, 0]}}\n"),
            (Parts{{"4:25 1", "`inside` is `1`", "expected true or false"}}));
  EXPECT_EQ(faults_of("obstacles: {a: {inside: true, radius: 1, position: [5, 0, 0], open: left}}\n"),
            (Parts{{"4:69 left", "`open` is `left`", "expected none, top, bottom or both"}}));
}

TEST(HollowObstacles, RefuseBodiesThatCannotMeetThem) {
  const string tube = "obstacles: {t: {inside: true, cylinder: {radius: 0.5, height: 1}, position: [5, 0, 0]";
  EXPECT_EQ(faults_of("bodies: {crate: {mass: 1, box: [1, 1, 1], position: [0, 5, 0]}}\n" + tube + "}}\n"),
            (Parts{{"5:25 true", "`t` is round and hollow, which only balls can meet, and `crate` is a box",
                    "expected balls alone, or a hollow `box`, which all bodies can meet"}}));
  EXPECT_EQ(errors_of(one_ball + "bodies: {crate: {mass: 1, box: [1, 1, 1], position: [0, 5, 0]}}\n"
                                 "obstacles: {t: {inside: true, box: [3, 3, 3], position: [0, 5, 0]}}\n"),
            "");

  const string large =
      "groups: {big: {count: 1, ball: {mass: 1, radius: 0.5}, in: {min: [0, 5, 0], max: [1, 6, 1]}}}\n";
  EXPECT_EQ(faults_of(large + tube + ", open: top}}\n"),
            (Parts{{"5:94 top", "`big.0`, of radius 0.5 m, is too wide for the opening of `t`, of radius 0.5 m",
                    "a ball cannot lie on a rim all around: expected narrower balls, or `open: none`"}}));
  EXPECT_EQ(errors_of(one_ball + large + tube + "}}\n"), "");
}

TEST(HollowObstacles, RefuseBallsThatMayMergeIntoAWiderOne) {
  const string balls =
      "balls: {a: {mass: 1, radius: 0.25, position: [0, 0, 0]}, b: {mass: 1, radius: 0.25, position: [2, 0, 0]}}\n";
  const string text = "scene: 1\nsimulate: {duration: 1, contact: merge}\n" + balls;
  EXPECT_EQ(in_parts(errors_of(text + "obstacles: {s: {inside: true, radius: 0.3, position: [5, 0, 0]}}\n")),
            (Parts{{"4:25 true", "balls may merge into one of radius 0.31498 m, and `s` has a radius of 0.3 m",
                    "expected `contact: bounce`, or a wider one"}}));
  EXPECT_EQ(errors_of(text + "obstacles: {s: {inside: true, radius: 0.4, position: [5, 0, 0]}}\n"), "");
}

}  // namespace
}  // namespace carom
