// Strings and rods: their ends, lengths and names, and what is wrong with some.
#include "physics/world.h"
#include "scene/engines.h"
#include "scene/marked_errors.h"
#include "scene/motion_text.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string things =
    "scene: 1\n"
    "balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}, blue: {mass: 1, radius: 0.1, position: [3, 5, 0]}}\n"
    "groups: {gas: {count: 3, ball: {mass: 1, radius: 0.1}, in: {min: [9, 0, 0], max: [10, 1, 1]}, arrange: lattice}}\n"
    "planes: {floor: {point: [0, -3, 0], normal: [0, 1, 0]}}\n"
    "obstacles: {post: {radius: 0.1, position: [0, 9, 0]}}\n";
const string simulate = "simulate: {duration: 1}\n";

string with(const string& written) {
  return things + simulate + "strings:\n  s: " + written + "\n";
}

string first_error(const string& written) {
  const string all = errors_of(with(written));
  return all.substr(0, all.find('\n'));
}

string remedy(const string& written) {
  const Parts errors = in_parts(errors_of(with(written)));
  EXPECT_EQ(errors.size(), 1u) << written;
  return std::get<2>(errors.at(0));
}

TEST(Strings, TieBodiesAndPoints) {
  const Scene scene = load_text(things + simulate +
                                "defaults: {string: {restitution: 0.25}}\n"
                                "strings:\n"
                                "  a: {from: [0, 4, 0], to: red}\n"
                                "  b: {from: blue, to: red, length: 6, restitution: 0.5}\n"
                                "  c: {from: gas.2, to: gas.1, rod: true}\n");

  const World& world = scene.world;
  ASSERT_EQ(world.strings.size(), 3u);

  const String &a = world.strings[0], &b = world.strings[1], &c = world.strings[2];
  EXPECT_EQ(a.body, 0u);
  EXPECT_EQ(a.other, no_entity);
  EXPECT_EQ(a.anchor, Vec3(0, 4, 0));
  EXPECT_EQ(a.length, 3) << "the distance at time 0";
  EXPECT_EQ(a.restitution, 0.25);
  EXPECT_FALSE(a.rod);

  EXPECT_EQ(b.body, 0u) << "the lower number, in whichever order the file has them";
  EXPECT_EQ(b.other, 1u);
  EXPECT_EQ(b.length, 6);
  EXPECT_EQ(b.restitution, 0.5);

  EXPECT_EQ(c.body, 3u);
  EXPECT_EQ(c.other, 4u);
  EXPECT_EQ(c.length, (scene.initial.position[3] - scene.initial.position[4]).norm());
  EXPECT_TRUE(c.rod);

  // Five bodies, a plane and an obstacle come before them.
  ASSERT_TRUE(world.is_string(7) && world.is_string(9) && !world.is_string(6) && !world.is_string(10));
  EXPECT_EQ(scene.roster.name(7), "a");
  EXPECT_EQ(scene.roster.name(9), "c");
  EXPECT_EQ(scene.roster.name(6), "post");
}

TEST(Strings, WithinRoundingAreTaut) {
  const string turned = "['= sin(33)', '= 1 + cos(33)', 0]";
  for (const char* rod : {"false", "true"}) {
    const Scene scene = load_text(with("{from: " + turned + ", to: red, length: 1, rod: " + rod + "}"));
    EXPECT_EQ(scene.world.strings[0].length, (scene.world.strings[0].anchor - scene.initial.position[0]).norm());
    EXPECT_NEAR(scene.world.strings[0].length, 1, 1e-15);
  }
}

TEST(Strings, AreRepeated) {
  const Scene scene = load_text(
      "scene: 1\n"
      "balls: {ball: {repeat: 3, mass: 1, radius: 0.1, position: ['= i', 0, 0]}}\n"
      "strings:\n"
      "  hung: {repeat: 3, from: ['= i', 2, 0], to: 'ball.{i}'}\n"
      "  chain: {repeat: 2, from: 'ball.{i}', to: 'ball.{i + 1}', length: 1.5}\n"
      "  none: {repeat: 0, from: [0, 1, 0], to: ball.0}\n" +
      simulate);

  ASSERT_EQ(scene.world.strings.size(), 5u);
  EXPECT_EQ(scene.roster.strings, (vector<string>{"hung.0", "hung.1", "hung.2", "chain.0", "chain.1"}));
  EXPECT_EQ(scene.world.strings[2].anchor, Vec3(2, 2, 0));
  EXPECT_EQ(scene.world.strings[4].body, 1u);
  EXPECT_EQ(scene.world.strings[4].other, 2u);
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
}

TEST(Strings, AreInTheResolvedSceneWithTheirLengths) {
  const Scene scene =
      load_text(with("{from: [0, 4, 0], to: red}") + "  r: {from: red, to: blue, rod: true, visible: false}\n");
  EXPECT_NE(
      scene.resolved.find("strings:\n"
                          "  s: {from: [0, 4, 0], to: red, length: 3, restitution: 0, rod: false, visible: true}\n"
                          "  r: {from: red, to: blue, length: 5, restitution: 0, rod: true, visible: false}\n"),
      string::npos)
      << scene.resolved;
  EXPECT_EQ(scene.overlay.hidden_strings, vector<size_t>{1});
  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(motion_text(again), motion_text(scene));
}

TEST(Strings, AreSetByTheirPaths) {
  LoadOptions options;
  options.set = {"strings.s.from.y=5", "strings.s.restitution=1"};
  const Scene scene = load_text(with("{from: [0, 4, 0], to: red}"), options);
  EXPECT_EQ(scene.world.strings[0].anchor, Vec3(0, 5, 0));
  EXPECT_EQ(scene.world.strings[0].length, 4);
  EXPECT_EQ(scene.world.strings[0].restitution, 1);
  EXPECT_NE(errors_with(with("{from: blue, to: red}"), "strings.s.from.y=5").find("`from` has no numbers yet"),
            string::npos);
}

TEST(Strings, HaveFlights) {
  const Scene scene = load_text(with("{from: [0, 4, 0], to: red}") + "output: {flights: true}\n");
  EXPECT_EQ(engine_of(scene.world, scene.simulate), Engine::exact);
  EXPECT_TRUE(scene.output.flights);
}

TEST(StringErrors, NameThePlaceAndTheRemedy) {
  EXPECT_EQ(in_parts(errors_of(with("{from: [0, 4, 0], to: red, length: 2.5}"))),
            (Parts{{"8:41 2.5", "`s` is 2.5 m long, but its ends are 3 m apart at time 0",
                    "expected a length of at least that distance; without `length` it is the distance"}}));
  EXPECT_EQ(first_error("{from: [0, 4, 0], to: red, length: 3.5, rod: true}"),
            "scene.yaml:8:41: error: `s` is 3.5 m long, but its ends are 3 m apart at time 0");
  EXPECT_EQ(remedy("{from: [0, 4, 0], to: red, length: 3.5, rod: true}"),
            "the ends of a rod are as far apart as it is long: leave out `length`, or move an end");
  EXPECT_EQ(first_error("{from: [0, 4, 0], to: red, length: 0}"), "scene.yaml:8:41: error: `length` is 0");
  EXPECT_EQ(first_error("{from: [0, 4, 0], to: red, length: -1}"), "scene.yaml:8:41: error: `length` is -1");
  EXPECT_EQ(first_error("{from: [0, 4, 0], to: red, restitution: -1}"), "scene.yaml:8:46: error: `restitution` is -1");

  EXPECT_EQ(first_error("{from: [0, 1, 0], to: red}"),
            "scene.yaml:8:3: error: the ends of `s` are at the same point at time 0");
  EXPECT_EQ(remedy("{from: [0, 1, 0], to: red}"), "expected `length`: a number above 0 in m");
  EXPECT_EQ(errors_of(with("{from: [0, 1, 0], to: red, length: 1}")), "");
  EXPECT_EQ(first_error("{from: [1e9, 1, 0], to: red, length: 1e-4}"),
            "scene.yaml:8:43: error: `s` is 1e-04 m long and 1e+09 m from the origin");
  EXPECT_EQ(first_error("{from: [0, 4e13, 0], to: red}"),
            "scene.yaml:8:13: error: `s` is 4e+13 m from the origin, more than 1e+12 times the smallest "
            "size, 0.1 m");
}

TEST(StringErrors, OfRodsWithVelocitiesAlongThem) {
  const auto error_of = [](const string& velocities, const string& more) {
    return errors_of("scene: 1\nbodies:\n  a: {mass: 1, radius: 0.1, position: [3, 4, 0], " + velocities +
                     "}\n  b: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [0, 0, 2]}\n"
                     "strings: {bar: {from: b, to: a" +
                     more + "}}\n" + simulate);
  };

  EXPECT_EQ(in_parts(error_of("velocity: [5, 0, 2]", ", rod: true")),
            (Parts{{"5:38 true", "the ends of `bar` part at 3 m/s at time 0",
                    "a rod keeps its length: expected velocities across it, such as the same at both ends"}}));
  EXPECT_NE(error_of("velocity: [-5, 0, 2]", ", rod: true").find("`bar` approach at 3 m/s"), string::npos);
  EXPECT_EQ(error_of("velocity: [4, -3, 2]", ", rod: true"), "");
  EXPECT_EQ(error_of("velocity: [0, 0, 2]", ", rod: true"), "");
  EXPECT_EQ(error_of("velocity: ['= sin(53.130102354155978)', '= -sin(36.869897645844021)', 0]", ", rod: true"), "");
  EXPECT_EQ(error_of("impulse: [5, 0, 0], velocity: [0, 0, 2]", ", rod: true"), "");
  EXPECT_EQ(error_of("velocity: [5, 0, 2]", ""), "") << "a string goes taut then";
}

TEST(StringErrors, OfTheEnds) {
  EXPECT_EQ(first_error("{from: red, to: red}"), "scene.yaml:8:22: error: `red` is tied to itself");
  EXPECT_EQ(first_error("{from: rde, to: red}"), "scene.yaml:8:13: error: nothing is named `rde`");
  EXPECT_EQ(remedy("{from: rde, to: red}"), "did you mean `red`?");
  EXPECT_EQ(first_error("{from: floor, to: red}"),
            "scene.yaml:8:13: error: `floor` is a fixed thing: no string is tied to it");
  EXPECT_EQ(remedy("{from: floor, to: red}"),
            "expected a ball, a body or a member (gas.3); a fixed end is a point: `from: [x, y, z]`");
  EXPECT_EQ(first_error("{from: s, to: red}"), "scene.yaml:8:13: error: `s` is a string: no string is tied to it");
  EXPECT_EQ(first_error("{from: red, to: gas}"),
            "scene.yaml:8:22: error: `gas` has 3 bodies: a string has one at each end");
  EXPECT_EQ(remedy("{from: red, to: gas}"),
            "expected one of them, such as gas.0; for a string to each `repeat`, and 'gas.{i}'");
  EXPECT_EQ(first_error("{from: red, to: [0, 1, 0]}"), "scene.yaml:8:22: error: `to` is a list");

  EXPECT_EQ(first_error("{from: [0, 1], to: red}"), "scene.yaml:8:13: error: `from` has 2 numbers");
  EXPECT_EQ(first_error("{to: red}"), "scene.yaml:8:3: error: string `s` has no `from`");
  EXPECT_EQ(first_error("{from: [0, 4, 0]}"), "scene.yaml:8:3: error: string `s` has no `to`");
  EXPECT_EQ(first_error("{from: [0, 4, 0], to: red, color: red}").substr(0, 58),
            "scene.yaml:8:33: error: unknown key `color` in string `s`");
}

TEST(StringErrors, OfNamesAreReportedWhereverTheyAreUsed) {
  const string one = with("{from: [0, 4, 0], to: red}");
  const auto has = [&](const string& more, const string& what) {
    const string all = errors_of(one + more);
    EXPECT_NE(all.find(what), string::npos) << all;
  };
  has("  red: {from: [0, 4, 0], to: blue}\n", "the name `red` is taken");
  has("regions: {s: {radius: 1, position: [0, 0, 0]}}\n", "the name `s` is taken");
  has("forces: [{uniform: [1, 0, 0], on: [s]}]\n", "`s` is a string: no force acts on it");
  has("restitution: {pairs: [{between: [red, s], value: 1}]}\n", "`s` is a string: it meets no other thing");
  has("camera: {follow: s}\n", "`s` is a string: there is nothing to follow");
}

TEST(StringErrors, OfEnginesThatLackThem) {
  const auto error_of = [&](const string& keys) {
    return errors_of(things + "strings: {s: {from: [0, 4, 0], to: red}}\nsimulate: {duration: 1, " + keys + "}\n");
  };
  EXPECT_NE(error_of("engine: book").find("`engine: book` has no strings"), string::npos);
  EXPECT_NE(error_of("contact: merge").find("`contact: merge` is for parabolas and linear drag, not for `strings`"),
            string::npos);
  EXPECT_EQ(error_of("engine: stepped"), "");
}

TEST(StringErrors, OfOtherThingsDoNotHideThem) {
  const string all = errors_of(things + simulate +
                               "strings: {s: {from: [0, 4, 0], to: red, length: 1}}\n"
                               "walls: {fence: {center: [20, 1, 0], normal: [1, 0, 0], size: [1, x]}}\n");
  EXPECT_NE(all.find("`s` is 1 m long"), string::npos) << all;
  EXPECT_NE(all.find("`x` is not a number"), string::npos) << all;
}

}  // namespace
}  // namespace carom
