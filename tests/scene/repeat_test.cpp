// `repeat`: members of a thing.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/motion_text.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string bricks = start + R"(gravity: [0, -9.8, 0]
defaults: {body: {density: 700}}
bodies:
  bricks: {repeat: {i: 6, j: 4}, box: [0.2, 0.1, 0.1], position: ['= 0.25 * (i + 0.5 * (j % 2))', '= 0.0625 + 0.125 * j', 0]}
  shot: {radius: 0.1, position: [0, 3, 0]}
forces: [{drag: {linear: 0.1}, on: [bricks]}]
)";

TEST(Repeat, IsTheSceneWithItsMembersWrittenOut) {
  string written = start + "gravity: [0, -9.8, 0]\ndefaults: {body: {density: 700}}\nbodies:\n", on;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 4; ++j) {
      written += fmt::format("  b{}: {{box: [0.2, 0.1, 0.1], position: [{}, {}, 0]}}\n", 4 * i + j,
                             0.25 * (i + 0.5 * (j % 2)), 0.0625 + 0.125 * j);
      on += fmt::format("{}b{}", on.empty() ? "" : ", ", 4 * i + j);
    }
  }
  written += "  shot: {radius: 0.1, position: [0, 3, 0]}\nforces: [{drag: {linear: 0.1}, on: [" + on + "]}]\n";

  const Scene scene = load_text(bricks);
  EXPECT_EQ(motion_text(scene), motion_text(load_text(written)));
  EXPECT_EQ(scene.roster.name(0), "bricks.0");
  EXPECT_EQ(scene.roster.name(23), "bricks.23");
  EXPECT_EQ(scene.roster.name(24), "shot");
  // Row-major: the last index varies fastest.
  EXPECT_EQ(scene.initial.position[5], Vec3(0.375, 0.1875, 0));
  // One colour for all, as a group has.
  EXPECT_EQ(scene.roster.bodies[0].color, scene.roster.bodies[23].color);
  EXPECT_NE(scene.roster.bodies[0].color, scene.roster.bodies[24].color);
}

TEST(Repeat, ResolvesToMembersThatRunAlike) {
  const Scene scene = load_text(bricks), again = load_text(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(motion_text(again), motion_text(scene));
  EXPECT_NE(scene.resolved.find("  bricks.23: {"), string::npos);
  EXPECT_NE(scene.resolved.find("\"on\": [bricks]"), string::npos);
}

const string repeated_things = start + R"(
let: {n: 2}
planes: {sides: {repeat: 2, point: ['= 100 * (1 - 2 * i)', 0, 0], normal: ['= 2 * i - 1', 0, 0]}}
balls: {row: {repeat: = n + 1, mass: = i + 1, radius: 0.1, position: [= i, 0, 0]}}
groups: {gas: {repeat: 2, count: 3, in: {min: [= 9 * i, 9, 0], max: [= 9 * i + 3, 12, 3]}, ball: {mass: 1, radius: 0.1}}}
walls: {fences: {repeat: 2, center: [= -20 - i, 1, 0], normal: [-1, 0, 0], size: [1, 1]}}
obstacles: {posts: {repeat: {a: 1, b: 2, c: 2}, radius: 0.1, position: [= a, = -5 - b, = c]}}
lights: {lamps: {repeat: 2, position: [= i, 9, 0]}}
restitution: {pairs: [{between: [row, sides], value: 0.5}, {between: [gas.1, posts.3], value: 0.25}]}
forces:
  - {repeat: 3, spring: {anchor: [= i, 1, 0], stiffness: = i + 1}, on: ['row.{i}']}
  - {uniform: [1, 0, 0], on: [gas.1, gas.0.2]}
camera: {follow: row}
)";

TEST(Repeat, MakesMembersOfEveryKind) {
  const Scene scene = load_text(repeated_things);

  ASSERT_EQ(scene.world.body_count(), 9u);
  EXPECT_EQ(scene.roster.name(2), "row.2");
  EXPECT_EQ(scene.roster.name(8), "gas.1.2");
  EXPECT_EQ(scene.world.mass[2], 3);
  ASSERT_EQ(scene.roster.fixed.size(), 8u);
  EXPECT_EQ(scene.roster.fixed[1].name, "sides.1");
  EXPECT_EQ(scene.roster.fixed[3].name, "fences.1");
  EXPECT_EQ(scene.world.obstacles[2].center, Vec3(0, -6, 0));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[1].name, "lamps.1");
  ASSERT_EQ(scene.world.forces.size(), 4u);
  EXPECT_EQ(scene.world.forces[2].on, (vector<Entity>{2}));
  EXPECT_EQ(scene.world.forces[3].on, (vector<Entity>{5, 6, 7, 8}));

  EXPECT_EQ(scene.world.pairs[0].a_count, 3u);
  EXPECT_EQ(scene.world.pairs[0].b_count, 2u);
  EXPECT_EQ(scene.world.pairs[1].a_first, 6u);
  EXPECT_EQ(scene.camera->follow->count, 3u);
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
}

TEST(Repeat, MayBeZero) {
  const string text = start + R"(let: {n: 0}
balls:
  row: {repeat: = n, mass: 1, radius: 0.1, position: ['= i / n', 0, 0]}
  red: {mass: 1, radius: 0.1, position: [0, 3, 0]}
planes: {sides: {repeat: {i: 0, j: 3}, point: [= i, 0, 0], normal: [0, 1, 0]}}
forces: [{drag: {linear: 1}, on: [row, red]}, {uniform: [1, 0, 0], on: [row]}, {repeat: 0, uniform: [= i, 0, 0]}]
restitution: {pairs: [{between: [row, red], value: 0.5}]}
)";

  const Scene scene = load_text(text);
  EXPECT_EQ(scene.world.body_count(), 1u);
  ASSERT_EQ(scene.world.forces.size(), 1u);
  EXPECT_EQ(scene.world.forces[0].on, (vector<Entity>{0}));
  EXPECT_TRUE(scene.world.planes.empty());
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);

  LoadOptions options;
  options.set = {"let.n=4"};
  EXPECT_EQ(load_text(text, options).world.body_count(), 5u);
  EXPECT_EQ(marked_errors(start + "balls:\n  row: {repeat: 0, mass: 1, radus: 1, position: [= i, 0, 0]}\n"),
            (Marked{{"radus", "unknown key `radus` in ball `row`"}}));
}

TEST(Repeat, OfNoMemberKeepsItsDefaultsInTheResolvedScene) {
  const Scene scene = load_text(start + R"(let: {n: 0}
defaults: {ball: {mass: 1, radius: = 1 / 4, color: red, velocity: [1, 0, 0]}, group: {speed: 1}}
balls: {row: {repeat: = n, position: ['= i', 0, 0], color: none}}
groups: {gas: {repeat: 0, count: 3, in: {min: [0, 0, '= i'], max: [1, 1, 1]}, ball: {restitution: 1}}}
)");
  EXPECT_NE(
      scene.resolved.find("row: {mass: 1, radius: 0.25, position: [\"= i\", 0, 0], velocity: [1, 0, 0], repeat: 0}"),
      string::npos);
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
}

TEST(Repeat, TakesSettingsOfTheThingAndOfAMember) {
  LoadOptions options;
  options.set = {"bodies.bricks.box=[0.1, 0.1, 0.1]", "bodies.bricks.repeat.i=2"};
  const Scene scene = load_text(bricks, options);
  EXPECT_EQ(scene.world.body_count(), 9u);
  EXPECT_EQ(scene.world.volume[7].half, Vec3(0.05, 0.05, 0.05));
  options.set = {"bodies.bricks.3.position.z=2"};
  EXPECT_EQ(load_text(load_text(bricks).resolved, options).initial.position[3].z(), 2);
  EXPECT_EQ(marked_errors(load_text(bricks).resolved, "bodies.bricks=1"),
            (Marked{{"bricks", "`bricks` has several members"}}));
  EXPECT_EQ(marked_errors(load_text(bricks).resolved, "bodies.bricks.mass=1"),
            (Marked{{"mass", "`bricks` has no member `mass`"}}));
}

TEST(RepeatErrors, PointAtTheCount) {
  const auto of = [](const string& repeat) {
    return marked_errors(start + "balls:\n  row: {repeat: " + repeat +
                         ", mass: 1, radius: 0.1, position: [= i, 0, 0]}\n");
  };
  EXPECT_EQ(of("-1"), (Marked{{"-1", "`repeat` is `-1`"}}));
  EXPECT_EQ(of("2.5"), (Marked{{"2.5", "`repeat` is `2.5`"}}));
  EXPECT_EQ(of("= 5 / 2"), (Marked{{"= 5 / 2", "`repeat` is `2.5`"}}));
  EXPECT_EQ(of("'3'"), (Marked{{"'3'", "`repeat` is `3`"}}));
  EXPECT_EQ(of("many"), (Marked{{"many", "`repeat` is `many`"}}));
  EXPECT_EQ(of("[1]"), (Marked{{"[", "`repeat` is a list"}}));
  EXPECT_EQ(of("{}"), (Marked{{"{", "`repeat` has 0 indices"}}));
  EXPECT_EQ(of("{i: -1}"), (Marked{{"-1", "`i` is `-1`"}}));
  EXPECT_EQ(of("{i: }"), (Marked{{"i", "`i` is empty"}}));

  EXPECT_EQ(of("1e9"), (Marked{{"1e9", "`repeat` makes 1000000000 members; the limit is 2000000"}}));
  EXPECT_EQ(of("{i: 1e5, j: 1e5}"), (Marked{{"{", "`repeat` makes 10000000000 members; the limit is 2000000"}}));
  EXPECT_EQ(of("1e300"), (Marked{{"1e300", "`repeat` makes 1e+300 members; the limit is 2000000"}}));
  EXPECT_EQ(of("2e6"), (Marked{{"repeat", "with these members the scene has 14000013 values; the limit is 6000000"}}));
  EXPECT_EQ(of("{sin: 2, i: 2}"), (Marked{{"sin", "`sin` is a function of expressions"}}));
  EXPECT_EQ(of("{a-b: 2, i: 2}"), (Marked{{"a-b", "`a-b` is not a name for an index"}}));
  EXPECT_EQ(of("{k: 2}"), (Marked{{"i", "no number is named `i`"}}));
  EXPECT_EQ(
      marked_errors(start + "let: {i: 3}\nballs: {row: {repeat: 2, mass: 1, radius: 1, position: [= i, 0, 0]}}\n"),
      (Marked{{"2", "the index `i` is a name of `let`, too"}}));
  EXPECT_EQ(marked_errors(start + "defaults: {ball: {repeat: 3}}\n"), (Marked{{"3", "`repeat` in `defaults`"}}));
}

TEST(RepeatErrors, OfAnIndexSuggestANameThatIsFree) {
  const auto remedy = [](const string& let, const string& repeat) {
    const string errors = errors_of(start + "let: " + let + "\nballs:\n  row: {repeat: " + repeat +
                                    ", mass: 1, radius: 0.1, position: [0, 0, 0]}\n");
    const size_t at = errors.find("such as `");
    return errors.substr(at, errors.find(',', at) - at);
  };
  EXPECT_EQ(remedy("{i: 3}", "2"), "such as `repeat: {k: 7}`");
  EXPECT_EQ(remedy("{k: 3}", "{k: 7}"), "such as `repeat: {j: 7}`");
  EXPECT_EQ(remedy("{i: 3, k: 3}", "2"), "such as `repeat: {j: 7}`");
  EXPECT_EQ(remedy("{i: 3}", "{i: 2, k: 2, j: 2}"), "such as `repeat: {n: 7}`");
}

TEST(RepeatErrors, OfOneHugeThingAreThoseOfNoOther) {
  const string others =
      "  w: {repeat: 2, mass: 1, radius: 0.1, position: [= i, 0, 5]}\n"
      "  u: {repeat: 3, mass: 1, radius: 0.1, position: [= i, 0, 9]}\n";

  for (const string count : {"1e9", "2e6"})
    EXPECT_EQ(marked_errors(start + "balls:\n  v: {repeat: " + count +
                            ", mass: 1, radius: 0.1, position: [= i, 0, 0]}\n" + others)
                  .size(),
              1u)
        << count;

  string sines = "= sin(i)";
  for (int k = 0; k < 100; ++k) sines += " + sin(i)";

  const Marked slow =
      marked_errors(start + "balls:\n  v: {repeat: 500000, mass: 1, radius: 0.1, position:\n    [= i,\n    " + sines +
                    ", 0]}\n" + others);
  ASSERT_EQ(slow.size(), 1u);
  EXPECT_EQ(slow[0].second, "evaluating the expressions of so many members takes too long");
}

TEST(RepeatErrors, OfMembersAreReportedOnce) {
  const auto of = [](const string& keys) {
    return marked_errors(start + "balls:\n  row: {repeat: 1000, " + keys + "}\n");
  };
  EXPECT_EQ(of("mass: 1, radius: 0.1, position: [= 1 / (i - 1), 0, 0]"), (Marked{{"/", "division by zero"}}));
  EXPECT_EQ(of("mass: 1, radius: = 5 - i, position: [= 20 * i, 0, 0]"), (Marked{{"= 5 - i", "`radius` is 0"}}));
  EXPECT_EQ(of("mass: 1, radus: 0.1, position: [= i, 0, 0]"),
            (Marked{{"radus", "unknown key `radus` in ball `row.0`"}}));
  EXPECT_EQ(of("mass: 1, position: [= i, 0, 0]"), (Marked{{"row", "ball `row.0` has no `radius`"}}));
}

TEST(RepeatErrors, OfOneLineAreOneErrorWithTheNumberOfMembers) {
  const string things = start + "balls:\n  row: {repeat: 30, mass: 1, radius: 0.1, position: [= i, 0, 0]}\n";
  EXPECT_EQ(in_parts(errors_of(things + "strings:\n  s: {repeat: 30, from: 'row.{i}', to: 'bob.{i}'}\n")),
            (Parts{{"6:40 'bob.{i}'", "nothing is named `bob.0`",
                    "in 30 members, of which this is the first\n"
                    "expected a ball, body, group or member (gas.3)\n"
                    "there is `row`"}}));
  // Two wrong places of one thing are two errors; a force and a region are repeated, too.
  EXPECT_EQ(marked_errors(things + "forces: [{repeat: 9, uniform: [1, 0, 0], on: [x], from: -1}]\n"),
            (Marked{{"x", "nothing is named `x`"}, {"-1", "`from` is -1"}}));
  EXPECT_EQ(marked_errors(things + "regions: {r: {repeat: 9, radius: 1, position: [0, 0, 0], on: [x]}}\n"),
            (Marked{{"x", "nothing is named `x`"}}));
  // So many members take no time: measured 0.1 s.
  EXPECT_EQ(marked_errors(start + "balls: {row: {repeat: 20000, mas: 1, radius: 1, position: [= 3 * i, 0, 0]}}\n"),
            (Marked{{"mas", "unknown key `mas` in ball `row.0`"}}));
}

TEST(RepeatErrors, OfNames) {
  const string row = start + "balls:\n  row: {repeat: 3, mass: 1, radius: 0.1, position: [= i, 0, 0]}\n";
  EXPECT_EQ(marked_errors(row + "forces: [{drag: {linear: 1}, on: [row.3]}]\n"),
            (Marked{{"row.3", "there is no `row.3`: `row` has 3 members"}}));
  EXPECT_EQ(marked_errors(row + "forces: [{repeat: 3, uniform: [1, 0, 0], on: ['row.{i / 2}']}]\n"),
            (Marked{{"i", "the number in this name is 0.5"}}));
  EXPECT_EQ(marked_errors(row + "forces: [{repeat: 3, uniform: [1, 0, 0], on: ['row.{i + 1}']}]\n"),
            (Marked{{"'row.{i + 1}'", "there is no `row.3`: `row` has 3 members"}}));
  EXPECT_EQ(marked_errors(row + "forces: [{repeat: 3, uniform: [1, 0, 0], on: ['row.{j}']}]\n"),
            (Marked{{"j", "no number is named `j`"}}));
  EXPECT_EQ(marked_errors(row + "forces: [{uniform: [1, 0, 0], on: ['row.{1']}]\n"),
            (Marked{{"1", "this brace is not closed"}}));
  EXPECT_NE(errors_of(row + "forces: [{uniform: [1, 0, 0], on: [roww]}]\n").find("did you mean `row`?"), string::npos);

  EXPECT_EQ(marked_errors(row + "planes: {row: {point: [0, -9, 0], normal: [0, 1, 0]}}\n"),
            (Marked{{"row", "the name `row` is taken"}}));
}

TEST(RepeatErrors, OfMembersWrittenOut) {
  EXPECT_EQ(marked_errors(start + "balls:\n  row.1: {mass: 1, radius: 1, position: [0, 3, 0]}\n"),
            (Marked{{"row.1", "`row.1` does not follow `row.0`"}}));
  EXPECT_EQ(marked_errors(start + "balls:\n  a: {mass: 1, radius: 1, position: [0, 3, 0]}\n"
                                  "  a.0: {mass: 1, radius: 1, position: [9, 3, 0]}\n"),
            (Marked{{"a.0", "the name `a` is taken"}}));
  EXPECT_EQ(marked_errors(start + "balls:\n  a.x: {mass: 1, radius: 1, position: [0, 3, 0]}\n"),
            (Marked{{"a.x", "`a.x` is not a name"}}));
}

}  // namespace
}  // namespace carom
