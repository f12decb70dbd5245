// `start`: bodies that begin as a former run had them, and groups that list their balls.
#include "physics/world.h"
#include "scene/former_state.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A run with these bodies at 2 s, its end. The bodies of numbers in `gone` are no longer there.
LoadOptions with_run(const vector<string>& names, const vector<Entity>& gone = {}) {
  LoadOptions options;
  options.former_state = [names, gone](const string&, optional<double> at) {
    FormerState former{names};
    former.file = "flights.bin";
    former.state.time = at.value_or(2);

    for (size_t i = 0; i < names.size(); ++i) {
      const auto x = static_cast<double>(i);
      former.state.position.emplace_back(x + 0.1, 0.3 * 3, 1e-7 * x);
      former.state.velocity.emplace_back(1 / 3.0, -x, 0);
      former.state.part_of.push_back(static_cast<Entity>(i));
    }

    for (const Entity i : gone) former.state.part_of[i] = no_entity;
    return former;
  };
  return options;
}

string with_balls(const string& more) {
  return start + "defaults: {ball: {mass: 1, radius: 0.1}}\nstart: {run: first}\n" + more;
}

TEST(Start, GivesBodiesByNameThePlacesOfTheRun) {
  const string text = with_balls(
      "balls:\n  red: {position: [9, 9, 9], velocity: [5, 5, 5], impulse: [1, 2, 3]}\n"
      "bodies: {box: {box: [1, 1, 1], mass: 2, position: [7, 0, 0], velocity: [0, 1, 0]}}\n");
  const Scene scene = load_text(text, with_run({"blue", "red"}));
  EXPECT_EQ(scene.initial.position[0], Vec3(1.1, 0.3 * 3, 1e-7));
  EXPECT_EQ(scene.initial.velocity[0], Vec3(1 / 3.0, -1, 0));
  EXPECT_EQ(scene.initial.position[1], Vec3(7, 0, 0));
  EXPECT_EQ(scene.initial.velocity[1], Vec3(0, 1, 0));
  EXPECT_TRUE(scene.world.impulse.empty());
  ASSERT_TRUE(scene.made_from.start);
  EXPECT_EQ(scene.made_from.start->run, "first");
  EXPECT_EQ(scene.made_from.start->at, 2);

  EXPECT_EQ(scene.made_from.notes,
            (vector<string>{"start: the run has no `box`, which begins where this scene places it",
                            "start: this scene has no `blue`, which the run has",
                            "start: the impulse of `red` is not applied again: the velocities of the run contain it"}));
}

TEST(Start, OfDefaultImpulsesAppliesNone) {
  const Scene scene = load_text(start +
                                    "start: {run: first}\n"
                                    "defaults: {ball: {mass: 1, radius: 0.1, impulse: [1, 0, 0]}}\n"
                                    "balls: {red: {position: [0, 5, 0]}, own: {position: [0, 7, 0]}}\n",
                                with_run({"red"}));
  EXPECT_EQ(scene.world.impulse, (vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0)}));
}

TEST(Start, OfGroupsWithDefaultImpulsesAppliesNone) {
  for (const char* defaults : {"{group: {ball: {mass: 1, radius: 0.1, impulse: [1, 0, 0]}}}",
                               "{ball: {mass: 1, radius: 0.1, impulse: [1, 0, 0]}, group: {ball: {}}}"}) {
    const Scene scene = load_text(start + "start: {run: first}\ndefaults: " + defaults +
                                      "\ngroups: {gas: {count: 2, in: {min: [0, 0, 0], max: [1, 1, 1]}}}\n",
                                  with_run({"gas.0", "gas.1"}));
    EXPECT_TRUE(scene.world.impulse.empty()) << defaults;
    EXPECT_EQ(scene.initial.position[1].x(), 1.1);
    EXPECT_EQ(scene.made_from.notes.size(), 1u);
  }
}

TEST(Start, OfRepeatedThingsAndGroupsIsByMember) {
  const Scene scene =
      load_text(with_balls("balls: {row: {repeat: 3, position: ['= i', 5, 0]}}\n"
                           "groups: {gas: {count: 2, speed: 1, in: {min: [0, 7, 0], max: [1, 8, 1]}, ball: {mass: 1, "
                           "radius: 0.1, velocity: [8, 8, 8]}}}\n"),
                with_run({"row.0", "gas.0", "row.2", "gas.1"}));
  EXPECT_EQ(scene.initial.position[0].x(), 0.1);
  EXPECT_EQ(scene.initial.position[1], Vec3(1, 5, 0));
  EXPECT_EQ(scene.initial.position[2].x(), 2.1);
  EXPECT_EQ(scene.initial.position[3].x(), 1.1);
  EXPECT_EQ(scene.initial.position[4].x(), 3.1);
  EXPECT_EQ(scene.initial.velocity[4], Vec3(1 / 3.0, -3, 0));
}

TEST(Start, LeavesNumbersInTheResolvedSceneWhichNeedsNoRun) {
  const Scene scene = load_text(
      with_balls("balls: {red: {position: ['= 1 + 1', 9, 9], velocity: ['= 3', 0, 0], impulse: [1, 0, 0]}}\n"
                 "groups: {gas: {count: 2, speed: 1, arrange: lattice, in: {min: [0, 7, 0], max: [1, 8, 1]}, ball: "
                 "{mass: 1, radius: 0.1}}}\n"
                 "caption: 'from {start.at} s of {start.run}'\n"),
      with_run({"red", "gas.0", "gas.1"}));

  EXPECT_EQ(scene.resolved.find("start:"), string::npos);
  EXPECT_EQ(scene.overlay.caption, "from 2 s of first");
  EXPECT_TRUE(scene.made_from.expressions.empty());

  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(again.initial.position, scene.initial.position);
  EXPECT_EQ(again.initial.velocity, scene.initial.velocity);
  EXPECT_EQ(again.world.impulse, scene.world.impulse);
}

TEST(Start, CountsWindowsFromItsOwnTimeAndSaysSo) {
  const string text = with_balls("balls: {red: {position: [0, 5, 0]}}\nforces: [{uniform: [1, 0, 0], from: 0.5}]\n");
  EXPECT_EQ(load_text(text, with_run({"red"})).made_from.notes,
            (vector<string>{
                "start: times of forces, motions and strings count from the new time 0, which is 2 s of the run"}));
}

TEST(StartErrors, OfBodiesThatAreGone) {
  EXPECT_EQ(in_parts(errors_of(with_balls("balls: {red: {position: [0, 5, 0]}, blue: {position: [0, 7, 0]}}\n"),
                               with_run({"red", "blue"}, {1}))),
            (Parts{{"4:1 start",
                    "at 2 s of the run `blue` is out of the world: merged into another body, removed by a region, or "
                    "yet to appear",
                    "expected a scene without such bodies, or another `at`"}}));
}

TEST(StartErrors, OfARunWithoutTheSceneBodies) {
  EXPECT_EQ(in_parts(errors_of(with_balls("balls: {red: {position: [0, 5, 0]}}\n"), with_run({"Red", "b"}))),
            (Parts{{"4:1 start", "the run has none of the bodies of this scene",
                    "bodies match by their names; the run has `Red` and `b`"}}));
}

TEST(StartErrors, OfGroupsOfAnotherSize) {
  EXPECT_EQ(in_parts(errors_of(with_balls("groups:\n  gas:\n    count: 3\n    in: {min: [0, 7, 0], max: [1, 8, 1]}\n"
                                          "    ball: {mass: 1, radius: 0.1}\n"
                                          "balls: {red: {position: [0, 5, 0]}}\n"),
                               with_run({"gas.0", "gas.1", "red"}))),
            (Parts{{"7:12 3", "`gas` has 3 balls, and the run has 2",
                    "expected `count`: 2, or another name, which the run does not have"}}));
}

TEST(StartErrors, OfStringsWithoutALength) {
  EXPECT_EQ(
      in_parts(errors_of(with_balls("balls: {red: {position: [0, 5, 0]}}\nstrings: {s: {from: [0, 9, 0], to: red}}\n"),
                         with_run({"red"}))),
      (Parts{{"6:11 s", "`s` has no `length`, and its ends begin where a former run had them",
              "expected `length`: that of scene.yaml in the folder of the former run"}}));
}

TEST(Start, OfTautStringsAllowsTheErrorsOfTheirPaths) {
  const string string = "balls: {red: {position: [0, 5, 0]}}\nstrings: {s: {from: [0.1, 0, 0], to: red, length: ";
  const Scene scene = load_text(with_balls(string + "0.899999999999}}\n"), with_run({"red"}));
  EXPECT_EQ(scene.world.strings[0].length, 0.3 * 3);
  EXPECT_NE(errors_of(with_balls(string + "0.8999}}\n"), with_run({"red"})), "");
}

TEST(StartErrors, OfOverlapsAreAtTheStart) {
  EXPECT_EQ(
      in_parts(errors_of(with_balls("balls: {red: {position: [0, 5, 0]}}\nobstacles:\n"
                                    "  post: {radius: 0.5, position: [0.1, 1, 0]}\n"),
                         with_run({"red"}))),
      (Parts{{"4:1 start", "`red` overlaps `post` by 0.5 m at the start", "expected bodies apart, or just touching"}}));
}

TEST(StartErrors, OfSettingsThatItReplaces) {
  LoadOptions options = with_run({"red"});
  options.set = {"balls.red.velocity.y=4"};
  EXPECT_EQ(in_parts(errors_of(with_balls("balls: {red: {position: [0, 5, 0]}}\n"), options)),
            (Parts{{"--set:11 velocity", "`velocity` of `red` has no effect: `start` takes its place",
                    "expected no such setting of a body that begins as the former run had it"}}));
}

TEST(StartErrors, OfTheReaderStandAtTheRunOrTheTime) {
  LoadOptions options;
  for (const bool of_time : {false, true}) {
    options.former_state = [of_time](const string&, optional<double>) -> FormerState {
      throw StartError("it is lost", "find it", of_time);
    };
    const string errors = errors_of(start + "start:\n  run: first\n  at: 3\n", options);
    EXPECT_EQ(in_parts(errors),
              (Parts{{of_time ? "5:7 3" : "4:8 first", "the run `first` cannot be used: it is lost", "find it"}}));
  }
}

TEST(StartErrors, OfKeys) {
  for (const auto& [part, error] :
       vector<pair<string, string>>{{"{at: 1}", "`start` has no `run`"},
                                    {"{run: first, at: -1}", "`at` is -1"},
                                    {"{run: first, at: 1 s}", "1 s"},
                                    {"{run: [first]}", "`run` is a list"},
                                    {"first", "`start` is `first`"},
                                    {"{run: first, time: 1}", "unknown key `time` in `start`"}})
    EXPECT_NE(errors_of(start + "balls: {red: {mass: 1, radius: 1, position: [0, 0, 0]}}\nstart: " + part + "\n",
                        with_run({"red"}))
                  .find(error),
              string::npos)
        << part << errors_of(start + "start: " + part + "\n");
}

TEST(ListedBalls, HaveTheirPlacesAndVelocities) {
  const Scene scene =
      load_text(start +
                "groups:\n  gas: {count: 2, ball: {mass: 1, radius: 0.1, velocity: [0, 2, 0]}, members: "
                "[{position: [1, 2, 3]}, {position: [4, 5, 6], velocity: [7, 8, 9]}]}\n");
  EXPECT_EQ(scene.initial.position, (vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)}));
  EXPECT_EQ(scene.initial.velocity, (vector<Vec3>{Vec3(0, 2, 0), Vec3(7, 8, 9)}));
  EXPECT_EQ(scene.roster.name(1), "gas.1");
  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(again.initial.velocity, scene.initial.velocity);
}

TEST(ListedBalls, ReplaceTheRulesOfDefaults) {
  const Scene scene =
      load_text(start +
                "defaults: {group: {arrange: lattice, speed: 3, in: {min: [0, 0, 0], max: [1, 1, 1]}}}\n"
                "groups: {gas: {count: 1, ball: {mass: 1, radius: 0.1}, members: [{position: [9, 2, 3]}]}}\n");
  EXPECT_EQ(scene.initial.position[0], Vec3(9, 2, 3));
  EXPECT_EQ(scene.initial.velocity[0], Vec3(0, 0, 0));
}

const string two_members = "members: [{position: [0, 0, 0]}, {position: [0, 0.15, 0]}]";

/// Keys of a group of two balls, and a part of their error.
const vector<pair<string, string>> wrong_members = {
    {two_members, "`gas.1` overlaps `gas.0` by 0.05 m at the start"},
    {two_members + ", in: {min: [0, 0, 0], max: [1, 1, 1]}", "has both `members` and `in`"},
    {"arrange: lattice, " + two_members, "has both `arrange` and `members`"},
    {"members: [{position: [0, 0, 0]}]", "`members` of `gas` has 1 entry, and `count` is 2"},
    {"members: [{}, {position: [0, 0, 0]}]", "has no `position`"},
    {"members: [{position: [0, 0, 0]}, {position: [1e25, 0, 0]}]", "`gas.1` is 1e+25 m from the origin"},
    {"members: [{position: [0, 0, 0]}, {position: [1, 0, 0], velocity: [1e20, 0, 0]}]", "`gas.1` "},
    {"speed: 1", "has no `in` and no `members`"}};

TEST(ListedBalls, AreCheckedOneByOne) {
  for (const auto& [part, error] : wrong_members) {
    const string errors = errors_of(start + "groups:\n  gas: {count: 2, ball: {mass: 1, radius: 0.1}, " + part + "}\n");
    EXPECT_NE(errors.find(error), string::npos) << part << "\n" << errors;
  }
}

}  // namespace
}  // namespace carom
