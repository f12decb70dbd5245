// `start` by the real program: a run goes on where a former run was.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

using Words = vector<string>;

/// A row of a table: its texts, and its numbers.
struct Row {
  vector<string> names;
  vector<double> numbers;
};

vector<Row> rows_in(const string& table) {
  vector<Row> rows;
  std::istringstream in(table);
  string line;
  std::getline(in, line);

  while (std::getline(in, line)) {
    Row& row = rows.emplace_back();
    std::istringstream cells(line);
    for (string cell; std::getline(cells, cell, ',');) {
      char* end = nullptr;
      const double number = std::strtod(cell.c_str(), &end);
      if (*end == '\0' && !cell.empty())
        row.numbers.push_back(number);
      else
        row.names.push_back(cell);
    }
  }

  return rows;
}

/// The rows from a time on, with times from there.
vector<Row> later(vector<Row> rows, double from) {
  std::erase_if(rows, [&](const Row& row) { return row.numbers[0] < from - 1e-9; });
  for (Row& row : rows) row.numbers[0] -= from;
  return rows;
}

/// The greatest difference of numbers in equally named rows.
double greatest_difference(const vector<Row>& a, const vector<Row>& b) {
  EXPECT_EQ(a.size(), b.size());
  double greatest = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    EXPECT_EQ(a[i].names, b[i].names);
    EXPECT_EQ(a[i].numbers.size(), b[i].numbers.size());
    for (size_t k = 0; k < std::min(a[i].numbers.size(), b[i].numbers.size()); ++k)
      greatest = std::max(greatest, std::abs(a[i].numbers[k] - b[i].numbers[k]));
  }
  return greatest;
}

/// Two balls that meet at 0.4 s and bounce off a floor, three in a row, and five of a group. Only bounces have losses.
string many_balls(const string& more, const string& duration = "2") {
  return "scene: 1\n"
         "defaults: {ball: {mass: 1, radius: 0.1, restitution: 0.9}}\n"
         "balls:\n"
         "  red: {position: [-1, 1, 0], velocity: [2, 1, 0], impulse: [0.5, 0, 0]}\n"
         "  blue: {position: [1, 1.05, 0], velocity: [-2, 1, 0]}\n"
         "  row: {repeat: 3, position: ['= i', 3, 1], velocity: [0.25, 0, 0]}\n"
         "groups: {gas: {count: 5, in: {min: [-2, 4, -2], max: [2, 6, 2]}, speed: 1, ball: {mass: 1, radius: 0.1}}}\n"
         "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
         "simulate: {duration: " +
         duration + "}\n" + more;
}

const string every_state =
    "output: {trajectory: {every: 0.01}, collisions: true, energy: {every: 0.1}, flights: true}\n";

void expect_run(const Workplace& here, const Words& words) {
  const Finished run = here.carom(words);
  ASSERT_EQ(run.code, 0) << run.err;
}

TEST(Start, GoesOnAlongTheParabolasOfARun) {
  const Workplace here;
  here.write("first.yaml", many_balls(every_state));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  const vector<Row> trajectory = rows_in(here.read("first/trajectory.csv"));
  const vector<Row> collisions = rows_in(here.read("first/collisions.csv"));

  for (const char* at : {"0", "0.3", "0.37", "1.2"}) {
    const double from = std::strtod(at, nullptr);
    here.write("second.yaml", many_balls(every_state + "start: {run: first, at: " + at + "}\n", to_string(2 - from)));
    expect_run(here, {"run", "second.yaml", "-o", string("second") + at});
    const string folder = string("second") + at;
    // Measured: 1.6e-14.
    EXPECT_LT(greatest_difference(later(trajectory, from), rows_in(here.read(folder + "/trajectory.csv"))), 1e-13)
        << at;
    EXPECT_LT(greatest_difference(later(collisions, from), rows_in(here.read(folder + "/collisions.csv"))), 1e-13)
        << at;
  }
}

// A bob that swings on a taut string, and a double pendulum on rods.
TEST(Start, OfStringsIsTheRunOfItsSceneFile) {
  for (const bool rods : {false, true}) {
    const Workplace here;
    const string tied = rods ? "strings: {a: {from: [0, 4, 0], to: red, length: 2.5, rod: true}, "
                               "b: {from: red, to: blue, length: 1.25, rod: true}}\n"
                             : "strings: {a: {from: [0, 4, 0], to: red, length: 2.5, restitution: 1}}\n";
    const string scene =
        "scene: 1\nballs:\n  red: {mass: 1, radius: 0.1, position: [1.5, 2, 0]}\n"
        "  blue: {mass: 1, radius: 0.1, position: [2.25, 1, 0]}\n" +
        tied + "simulate: {duration: 1.5}\noutput: {trajectory: {every: 0.1}, collisions: true, flights: true}\n";
    here.write("first.yaml", scene);
    expect_run(here, {"run", "first.yaml", "-o", "first"});

    for (const char* at : {"0.1", "0.37", "0.7", "1.2"}) {
      here.write("second.yaml", scene + "start: {run: first, at: " + at + "}\n");
      expect_run(here, {"run", "second.yaml", "-o", "second", "--force"});
      expect_run(here, {"run", "second/scene.yaml", "-o", "third", "--force"});
      for (const string file : {"trajectory.csv", "collisions.csv", "summary.csv"})
        EXPECT_EQ(here.read("second/" + file), here.read("third/" + file)) << at << ' ' << file;
      EXPECT_TRUE(rods || rows_in(here.read("second/collisions.csv")).empty()) << at;
    }
  }
}

TEST(Start, OfAFreeBallIsTheClosedFormAtAnyTime) {
  const Workplace here;
  const string ball =
      "scene: 1\ngravity: [0, -8, 0]\nsimulate: {duration: 1}\n"
      "balls: {red: {mass: 1, radius: 0.1, position: [1, 2, 3], velocity: [0.5, 4, 0]}}\n"
      "output: {trajectory: {every: 1}, flights: true}\n";
  here.write("first.yaml", ball);
  here.write("second.yaml", ball + "start: {run: first, at: 0.123456789}\n");
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  expect_run(here, {"run", "second.yaml", "-o", "second"});

  const vector<Row> rows = rows_in(here.read("second/trajectory.csv"));
  ASSERT_EQ(rows.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const double t = 0.123456789 + static_cast<double>(i);
    EXPECT_EQ(rows[i].numbers[0], static_cast<double>(i));
    EXPECT_NEAR(rows[i].numbers[1], 1 + 0.5 * t, 1e-15);
    EXPECT_NEAR(rows[i].numbers[2], 2 + 4 * t - 4 * t * t, 2e-15);
    EXPECT_NEAR(rows[i].numbers[5], 4 - 8 * t, 2e-15);
  }
}

TEST(Start, WithoutFlightsHasTheNumbersOfTheTable) {
  for (const char* layout : {"long", "wide"}) {
    const Workplace here;
    const string output = string("output: {trajectory: {every: 0.1, layout: ") + layout + "}}\n";
    here.write("first.yaml", many_balls(output));
    here.write("second.yaml", many_balls(output + "start: {run: first, at: 0.7}\n"));
    expect_run(here, {"run", "first.yaml", "-o", "first"});
    expect_run(here, {"run", "second.yaml", "-o", "second"});

    // The rows of the first instant.
    vector<Row> then = later(rows_in(here.read("first/trajectory.csv")), 0.7),
                now = rows_in(here.read("second/trajectory.csv"));
    const size_t rows = layout == string("long") ? 10 : 1;
    then.resize(rows);
    now.resize(rows);
    EXPECT_EQ(greatest_difference(then, now), 0) << layout;
  }
}

TEST(Start, WithoutATimeIsTheEndOfTheRun) {
  const Workplace here;
  here.write("first.yaml", many_balls("output: {trajectory: {every: 0.3}}\n"));
  here.write("second.yaml", many_balls("output: {trajectory: {every: 0.3}}\nstart: {run: first/}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  expect_run(here, {"run", "second.yaml", "-o", "second"});
  vector<Row> now = rows_in(here.read("second/trajectory.csv"));
  now.resize(10);
  EXPECT_EQ(greatest_difference(later(rows_in(here.read("first/trajectory.csv")), 2), now), 0);
}

TEST(Start, LeavesASceneThatRunsAlone) {
  const Workplace here;
  here.write("first.yaml", many_balls(every_state));
  here.write("second.yaml", many_balls(every_state + "start: {run: first, at: 0.37}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  expect_run(here, {"run", "second.yaml", "-o", "second"});
  expect_run(here, {"run", "second/scene.yaml", "-o", "third"});

  EXPECT_EQ(here.read("second/scene.yaml").find("start:"), string::npos);
  map<string, string> second = without_manifest(here.files("second")), third = without_manifest(here.files("third"));

  // These name the run by its folder.
  second.erase("summary.csv");
  third.erase("summary.csv");
  EXPECT_EQ(second, third);
}

TEST(Start, IsInTheManifestAndAChangedRunIsNoticed) {
  const Workplace here;
  here.write("first.yaml", many_balls(every_state));
  here.write("second.yaml", many_balls(every_state + "start: {run: first, at: 0.37}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  const Words again = {"run", "second.yaml", "-o", "second"};
  expect_run(here, again);

  EXPECT_NE(here.carom(again).out.find("up to date"), string::npos);

  const auto first = nlohmann::json::parse(here.read("first/manifest.json")),
             second = nlohmann::json::parse(here.read("second/manifest.json"));
  string flights;
  for (const auto& file : first["files"])
    if (file["name"] == "flights.bin") flights = file["sha256"];
  EXPECT_EQ(second["scene"]["start"],
            (nlohmann::json{{"run", "first"}, {"at", 0.37}, {"file", "flights.bin"}, {"sha256", flights}}));

  // Another first run makes another second one.
  expect_run(here, {"run", "first.yaml", "-o", "first", "--set", "balls.blue.velocity.x=-1", "--force"});
  const Finished renewed = here.carom(again);
  EXPECT_EQ(renewed.code, 0) << renewed.err;
  EXPECT_EQ(renewed.out.find("up to date"), string::npos);
}

TEST(Start, OfAnySweptTimeHasItsState) {
  const Workplace here;
  here.write("first.yaml", two_balls("output: {flights: true}\n"));
  here.write(
      "second.yaml",
      two_balls(
          "output: {collisions: true, trajectory: {every: 1}}\nstart: {run: first}\nmeasures: {x_m: balls.red.x_m}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first", "--set", "simulate.duration=0.4"});
  const Words sweep = {"sweep", "second.yaml", "--grid", "start.at=0,0.125,0.25", "--set", "simulate.duration=0.125",
                       "-o",    "sweep"};
  expect_run(here, sweep);

  // Red moves at 2 m/s from -1 m, and meets blue at 0.445 s.
  const vector<Row> rows = rows_in(here.read("sweep/summary.csv"));
  ASSERT_EQ(rows.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(rows[i].numbers.back(), -1 + 2 * 0.125 * static_cast<double>(i + 1)) << i;
  EXPECT_NE(here.carom(sweep).out.find("made        0 runs"), string::npos);

  // Not by a run in its own folder.
  const Finished within =
      here.carom({"sweep", "second.yaml", "--grid", "start.run=sweep/runs/r0001", "-o", "sweep", "--force"});
  EXPECT_EQ(within.code, 2);
  EXPECT_NE(within.err.find("the run `sweep/runs/r0001` lies in the folder of this sweep"), string::npos) << within.err;

  // After another former run the folder holds another sweep.
  expect_run(here, {"run", "first.yaml", "-o", "first", "--set", "balls.red.position.x=-1.5", "--force"});
  EXPECT_NE(here.carom(sweep).err.find("holds something other"), string::npos);
}

TEST(Start, ChecksWithoutWriting) {
  const Workplace here;
  here.write("first.yaml", many_balls(every_state));
  here.write("second.yaml", many_balls("start: {run: first, at: 0.5}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  const auto before = here.files();

  const Finished check = here.carom({"check", "second.yaml"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.out.find("  start       the run first at 0.5 s, by its flights.bin\n"
                           "  note        start: the impulse of `red` is not applied again: the velocities of the run "
                           "contain it\n"),
            string::npos)
      << check.out;
  EXPECT_EQ(here.files(), before);
}

/// The standard error of `check second.yaml` with such a start.
string error_of_start(const Workplace& here, const string& start) {
  here.write("second.yaml", many_balls("start: " + start + "\n"));
  const Finished check = here.carom({"check", "second.yaml"});
  EXPECT_EQ(check.code, 2) << start;
  return check.err;
}

TEST(Start, RefusesRunsThatHaveNoSuchState) {
  const Workplace here;
  here.write("first.yaml", many_balls("output: {trajectory: {every: 0.1}}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  expect_run(here, {"run", "first.yaml", "-o", "bare", "--only", "collisions"});
  EXPECT_EQ(
      error_of_start(here, "{run: first, at: 0.55}"),
      "second.yaml:10:25: error: the run `first` cannot be used: it has no flights, and its trajectory.csv has no "
      "rows at 0.55 s\n"
      "  10 | start: {run: first, at: 0.55}\n"
      "     |                         ^~~~\n"
      "     = the nearest rows are at 0.5 and 0.6 s\n"
      "     = or run it with `output.flights: true`, which has every time of motion along parabolas\n"
      "carom: 1 error\n");

  EXPECT_EQ(error_of_start(here, "{run: first, at: 2.5}"),
            "second.yaml:10:25: error: the run `first` cannot be used: it ended at 2 s, before 2.5 s\n"
            "  10 | start: {run: first, at: 2.5}\n"
            "     |                         ^~~\n"
            "     = expected `at` from 0 to 2 s\n"
            "carom: 1 error\n");

  const auto expect = [&](const string& run, const string& fault) {
    const string error = error_of_start(here, "{run: " + run + "}");
    EXPECT_NE(error.find(":14: error: the run `" + run + "` cannot be used: " + fault), string::npos) << error;
  };
  expect("bare", "it has neither flights nor a trajectory\n");
  expect("nowhere", "there is no such folder\n");
  expect("first.yaml", "it is not a folder\n");
  here.write("empty/a.txt", "a");
  expect("empty", "it holds no whole run: there is no manifest.json\n");
  here.write("failed/error.txt", "simulate.max_collisions is 5\n");
  expect("failed", "it has failed: simulate.max_collisions is 5\n");
  here.write("first/trajectory.csv", here.read("first/trajectory.csv") + "\n");
  expect("first", "trajectory.csv is missing or has changed\n");
}

TEST(Start, AppliesImpulsesOnce) {
  const string scene =
      "scene: 1\ngravity: [0, 0, 0]\nsimulate: {duration: 1, engine: ENGINE}\noutput: {trajectory: {every: 0.5}}\n"
      "balls: {red: {mass: 2, radius: 0.1, position: [0, 0, 0], velocity: [1, 0, 0], impulse: [6, 0, 0]}}\n";

  for (const char* engine : {"exact", "stepped", "book"}) {
    const Workplace here;
    string text = scene;
    text.replace(text.find("ENGINE"), 6, engine);
    here.write("first.yaml", text);
    here.write("second.yaml", text + "start: {run: first, at: 0.5}\n");
    here.write("again.yaml", text + "start: {run: first, at: 0}\n");
    expect_run(here, {"run", "first.yaml", "-o", "first"});
    expect_run(here, {"run", "second.yaml", "-o", "second"});
    for (const Row& row : rows_in(here.read("second/trajectory.csv"))) EXPECT_NEAR(row.numbers[4], 4, 1e-15) << engine;

    const Finished again = here.carom({"run", "again.yaml", "-o", "again"});
    if (engine == string("book")) {
      EXPECT_NE(again.err.find("the book's engine had not yet applied the impulses then"), string::npos);
      continue;
    }
    EXPECT_EQ(again.code, 0) << again.err;

    for (const Row& row : rows_in(here.read("again/trajectory.csv"))) EXPECT_EQ(row.numbers[4], 4) << engine;
  }
}

TEST(Start, RefusesToReplaceTheRunThatItBeginsWith) {
  const Workplace here;
  here.write("first.yaml", many_balls(every_state));
  here.write("second.yaml", many_balls("start: {run: first, at: 0.5}\n"));
  expect_run(here, {"run", "first.yaml", "-o", "first"});
  const Finished run = here.carom({"run", "second.yaml", "-o", "./first", "--force"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("holds the run that this one begins with, and would be replaced"), string::npos) << run.err;
}

const string lumps =
    "scene: 1\ngravity: [0, 0, 0]\nsimulate: {duration: 1, contact: merge}\n"
    "balls:\n"
    "  red: {mass: 1, radius: 0.1, position: [-1, 0, 0], velocity: [2, 0, 0]}\n";
const string blue_lump = "  blue: {mass: 1, radius: 0.1, position: [1, 0, 0], velocity: [-2, 0, 0]}\n";

TEST(Start, RefusesBodiesThatHaveMergedAndKeepsMassesOfTheScene) {
  for (const char* only : {"flights", "trajectory"}) {
    const Workplace here;
    here.write("first.yaml", lumps + blue_lump + "output: {flights: true, trajectory: {every: 0.25}}\n");
    here.write("both.yaml", lumps + blue_lump + "start: {run: first}\n");
    expect_run(here, {"run", "first.yaml", "-o", "first", "--only", only});

    const Finished both = here.carom({"check", "both.yaml"});
    EXPECT_EQ(both.code, 2);
    EXPECT_NE(both.err.find(": error: at 1 s of the run `blue` is out of the world: merged into another body, removed "
                            "by a region, or yet to appear\n"),
              string::npos)
        << both.err;
    EXPECT_EQ(here.carom({"check", "both.yaml", "--set", "start.at=0.25"}).code, 0);

    // Without what is gone the masses are those of the scene.
    here.write("red.yaml", lumps + "start: {run: first}\n");
    const Finished red = here.carom({"run", "red.yaml", "-o", "red"});
    EXPECT_EQ(red.code, 0) << red.err;
    EXPECT_NE(red.err.find("start: bodies of the run had merged by then; masses and sizes are those of this scene"),
              string::npos)
        << red.err;
  }
}

TEST(Start, RefusesBodiesThatARegionHasRemoved) {
  for (const char* only : {"flights", "trajectory"}) {
    const Workplace here;
    const string scene = two_balls(
        "regions: {hole: {radius: 0.2, position: [-0.5, 0, 0], on: [red], action: remove}}\n"
        "output: {flights: true, trajectory: {every: 0.25}}\n");
    here.write("first.yaml", scene);
    here.write("second.yaml", scene + "start: {run: first}\n");
    expect_run(here, {"run", "first.yaml", "-o", "first", "--only", only});
    const Finished second = here.carom({"check", "second.yaml"});
    EXPECT_EQ(second.code, 2);
    EXPECT_NE(second.err.find(": error: at 1 s of the run `red` is out of the world"), string::npos) << second.err;
  }
}

}  // namespace
}  // namespace carom::testing
