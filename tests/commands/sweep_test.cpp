// carom sweep, gather and submit, by the real program.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "scene/scene.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;
using Files = map<string, string>;

const string grid =
    "sweep: 1\ntitle: Offsets\nbase: balls.yaml\n"
    "grid:\n  balls.red.position.z: {from: 0, to: 0.05, count: 3}\n  balls.red.mass: [5, 10]\n"
    "compare: {measures: [energy_lost_J, balls.red.speed_m_per_s]}\n";

/// A folder with balls.yaml and, of this text, offsets.yaml.
void prepare(const Workplace& here, const string& sweep = grid) {
  here.write("balls.yaml", two_balls());
  here.write("offsets.yaml", sweep);
}

/// Files that are equal however a sweep was run: all except the runs' manifests, which have times.
bool lasts(const string& name) {
  return !(name.find("runs/") != string::npos && name.ends_with("manifest.json"));
}

/// The names of files that differ between two folders but must be equal.
vector<string> differing(const Workplace& here, const string& a, const string& b) {
  vector<string> out;
  const auto hold = [&](const string& one, const string& other) {
    for (const auto& [name, bytes] : here.files(one)) {
      const size_t begin = name.find(one);
      const string within = begin == string::npos ? name : name.substr(begin + one.size() + 1);
      if (lasts(within) && here.read(other + "/" + within) != bytes) out.push_back(within);
    }
  };
  hold(a, b);
  hold(b, a);
  return out;
}

using Names = vector<string>;

vector<string> lines_of(const string& text) {
  vector<string> lines;
  for (size_t i = 0; i < text.size();) {
    const size_t end = std::min(text.find('\n', i), text.size());
    lines.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return lines;
}

/// The cells of summary.csv, a map from column to text a run.
vector<map<string, string>> rows_of(const string& text) {
  vector<map<string, string>> rows;
  const auto cells = [](const string& line) {
    vector<string> out(1);
    for (const char c : line) c == ',' ? out.emplace_back() : out.back() += c;
    return out;
  };

  const vector<string> lines = lines_of(text);
  const vector<string> names = cells(lines.at(0));
  for (size_t i = 1; i < lines.size(); ++i) {
    const vector<string> values = cells(lines[i]);
    rows.emplace_back();
    for (size_t k = 0; k < names.size(); ++k) rows.back()[names[k]] = values.at(k);
  }

  return rows;
}

TEST(Sweep, WritesARunAFolderAndWhatComparesThem) {
  const Workplace here;
  prepare(here);
  const Finished sweep = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_EQ(sweep.err, "");
  EXPECT_TRUE(sweep.out.starts_with("offsets: Offsets\n  runs        6 runs; done\n")) << sweep.out;

  for (const string name : {"summary.csv", "comparison.xlsx", "index.html", "manifest.json",
                            "runs/r0001/trajectory.csv", "runs/r0006/manifest.json", "runs/r0006/scene.yaml"})
    EXPECT_TRUE(here.has("output/offsets/" + name)) << name;
  const vector<string> rows = lines_of(here.read("output/offsets/summary.csv"));
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_TRUE(rows[0].ends_with(
      ",frames,stepped_contact_s,removed_J,ended_by,energy_absorbed_J,contact_made_J,appeared_J,balls.red."
      "position.z,balls.red.mass,balls.red.speed_m_per_s"))
      << rows[0];
  EXPECT_TRUE(rows[4].starts_with("r0004,")) << rows[4];
  EXPECT_NE(rows[4].find(",0.025,10,"), string::npos) << rows[4];
}

TEST(Sweep, RunHasTheBytesOfTheSameSceneRunAlone) {
  const Workplace here;
  prepare(here);
  here.carom({"sweep", "offsets.yaml", "-q"});
  here.carom({"run", "balls.yaml", "--set", "balls.red.position.z=0.025", "--set", "balls.red.mass=10", "-o", "alone"});
  EXPECT_EQ(here.files("output/offsets/runs/r0004").size(), 6u);
  for (const auto& [name, bytes] : here.files("alone")) {
    if (name.ends_with("manifest.json")) continue;
    EXPECT_EQ(here.read("output/offsets/runs/r0004/" + name.substr(name.rfind('/') + 1)), bytes) << name;
  }
}

TEST(Sweep, SecondCallIsUpToDateAndTouchesNothing) {
  const Workplace here;
  prepare(here);
  here.carom({"sweep", "offsets.yaml", "-q"});
  const Files before = here.files("output");
  const Finished again = here.carom({"sweep", "offsets.yaml"});
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.err, "");
  EXPECT_EQ(again.out, "offsets: Offsets\n  up to date  6 runs, output/offsets\n");
  EXPECT_EQ(here.files("output"), before);
}

TEST(Sweep, RunsOnlyWhatIsMissing) {
  const Workplace here;
  prepare(here);
  here.carom({"sweep", "offsets.yaml", "-q"});
  const Files before = here.files("output");
  here.shell("rm output/offsets/runs/r0002/trajectory.csv output/offsets/runs/r0005/energy.csv");
  const string kept = here.read("output/offsets/runs/r0001/manifest.json");
  const Json again = Json::parse(here.carom({"sweep", "offsets.yaml", "--json", "--progress", "none"}).out);
  EXPECT_EQ(again["made"], 2);
  EXPECT_EQ(here.read("output/offsets/runs/r0001/manifest.json"), kept);
  for (const auto& [name, bytes] : before)
    EXPECT_TRUE(name.ends_with("manifest.json") || here.files("output").at(name) == bytes) << name;
}

TEST(Sweep, ReportsAPathWithoutEffectUnlessAMeasureUsesIt) {
  const Workplace here;
  const auto said = [&](const string& measure, const string& path) {
    here.write("balls.yaml",
               two_balls("let: {k: 2, twice: = 2 * k, idle: 3}\nmeasures: {m: '" + measure + "'}\n" + tables));
    const Finished sweep =
        here.carom({"sweep", "balls.yaml", "--grid", path, "-o", "sweep", "--force", "--progress", "none", "-q"});
    EXPECT_EQ(sweep.code, 0) << sweep.err;
    return sweep.err;
  };

  const auto idle = [](const string& path) {
    return "carom: " + path + " has no effect on the motion: its value is not used\n";
  };
  EXPECT_EQ(said("= hits(red)", "let.k=1,2"), idle("let.k"));
  EXPECT_EQ(said("= hits(red) * let.k", "let.k=1,2"), "");
  EXPECT_EQ(said("= hits(red) * let.twice", "let.k=1,2"), "") << "by another value";
  EXPECT_EQ(said("let.k", "let.k=1,2"), "");
  EXPECT_EQ(said("= 1 + count(y_m < let.k)", "let.k=1,2"), "");
  EXPECT_EQ(said("= hits(red) * let.k", "let.idle=1,2"), idle("let.idle"));
  EXPECT_EQ(said("= hits(red)", "measures.m=hits(red),hits(blue)"), "");
}

TEST(Sweep, OfARepeatGoesThroughZero) {
  const Workplace here;
  here.write("row.yaml",
             "scene: 1\ngravity: [0, 0, 0]\nballs:\n  w: {repeat: 0, mass: 1, radius: 0.1, position: [= i, 0, 0]}\n"
             "forces: [{uniform: [1, 0, 0], on: [w]}]\nsimulate: {duration: 1}\noutput: {energy: {every: 1}}\n"
             "measures: {most: max(balls.w.x_m), hit: hits(w), many: count(balls.w.x_m > 0), met: first(w)}\n");
  ASSERT_EQ(here.carom({"sweep", "row.yaml", "--grid", "balls.w.repeat=0:2:3", "-o", "sweep", "-q"}).code, 0);
  string table;
  for (auto& row : rows_of(here.read("sweep/summary.csv")))
    table += row["most"] + "|" + row["hit"] + "|" + row["many"] + "|" + row["met"] + "; ";
  EXPECT_EQ(table, "|0|0|; 0.5|0|1|; 1.5|0|2|; ");  // x = i + t^2 / 2
}

TEST(Sweep, PlanShowsRunsAndWritesNothing) {
  const Workplace here;
  prepare(here);
  const Finished plan = here.carom({"sweep", "offsets.yaml", "--plan", "--progress", "none"});
  EXPECT_EQ(plan.code, 0);
  EXPECT_NE(plan.out.find("\n  r0004    new                 0.025              10\n"), string::npos) << plan.out;
  EXPECT_NE(plan.out.find("to do       6 of 6 runs\n"), string::npos) << plan.out;
  EXPECT_FALSE(here.has("output"));
  here.carom({"sweep", "offsets.yaml", "-q"});
  const Json json = Json::parse(here.carom({"sweep", "offsets.yaml", "--plan", "--json"}).out);
  EXPECT_EQ(json["runs"][3], Json::parse(R"({"run": "r0004", "state": "done",
                                            "values": {"balls.red.position.z": 0.025, "balls.red.mass": 10}})"));
}

TEST(Sweep, OneFailingRunStopsNoOther) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\nset: {room: {min: [-1.15, -1, -1], max: [1.15, 1, 1]}}\n"
          "grid: {simulate.max_collisions: [100, 1, 200]}\n");

  const Finished sweep = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_EQ(sweep.code, 3);
  EXPECT_TRUE(sweep.err.starts_with("carom: r0002: the run failed: more than simulate.max_collisions = 1"))
      << sweep.err;
  EXPECT_TRUE(here.has("output/offsets/runs/r0002/error.txt"));
  EXPECT_TRUE(here.has("output/offsets/runs/r0003/trajectory.csv"));

  // Its row says so.
  const vector<string> rows = lines_of(here.read("output/offsets/summary.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_TRUE(rows[2].starts_with("r0002,,,failed,")) << rows[2];

  // It is tried again; the others are not.
  const Json again = Json::parse(here.carom({"sweep", "offsets.yaml", "--json", "--progress", "none"}).out);
  EXPECT_EQ(again["made"], 0);
  EXPECT_EQ(again["failed"].size(), 1u);
}

TEST(Sweep, AllScenariosAreCheckedBeforeTheFirstIsRun) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\nlist:\n  - {balls.red.mass: 2}\n  - {balls.red.mas: 2}\n"
          "  - {balls.red.position.x: 0.95}\n");
  const Finished sweep = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_EQ(sweep.code, 2);
  EXPECT_NE(sweep.err.find("offsets.yaml:5:6: error: unknown key `mas` in `ball`"), string::npos) << sweep.err;
  EXPECT_FALSE(here.has("output"));
  const Finished measures = here.carom({"sweep", "offsets.yaml", "--grid", "balls.red.mass=1,2"});
  EXPECT_EQ(measures.code, 2);
}

TEST(Sweep, WrongMeasureIsFoundBeforeAnythingIsRun) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.mass: [1, 2]}\n"
          "compare: {measures: [balls.rde.speed_m_per_s]}\n");
  const Finished sweep = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_EQ(sweep.code, 2);
  EXPECT_TRUE(sweep.err.starts_with("offsets.yaml:4:22: error: ")) << sweep.err;
  EXPECT_NE(sweep.err.find("red"), string::npos) << sweep.err;
  EXPECT_FALSE(here.has("output"));
}

TEST(Sweep, PathThatABlockDoesNotSetHasTheBasesValue) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\nruns:\n  - grid: {balls.red.mass: [5, 7]}\n"
          "  - grid: {balls.red.position.z: [0.05]}\n");
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  const string summary = here.read("output/offsets/summary.csv");

  auto rows = rows_of(summary);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["balls.red.mass"], "5");
  EXPECT_EQ(rows[0]["balls.red.position.z"], "0");
  EXPECT_EQ(rows[2]["balls.red.mass"], "10");
  EXPECT_EQ(rows[2]["balls.red.position.z"], "0.05");

  // The same by another route.
  ASSERT_EQ(here.carom({"gather", "output/offsets", "-q"}).code, 0);
  EXPECT_EQ(here.read("output/offsets/summary.csv"), summary);

  ASSERT_EQ(here.carom({"compare", "output/offsets", "-o", "again", "-q"}).code, 0);
  EXPECT_EQ(here.read("again/summary.csv"), summary);
}

/// Sweeps of four masses of the red ball that write only energies.
string masses(const string& values, const string& more = "") {
  return "sweep: 1\nbase: balls.yaml\nonly: [energy]\ngrid: {balls.red.mass: [" + values + "]}\n" + more;
}

TEST(Sweep, RunsOfAnotherSweepAreNeverTakenForItsOwn) {
  const Workplace here;
  prepare(here, masses("10, 20, 30, 40"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  prepare(here, masses("1, 2, 3, 4"));
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 2);

  // Half of the runs.
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q", "--shard", "1/2", "--force"}).code, 0);
  const Finished gathered = here.carom({"gather", "output/offsets", "-q"});
  EXPECT_EQ(gathered.code, 1);
  EXPECT_NE(gathered.err.find("2 of 4 runs are missing: r0002 and r0004"), string::npos) << gathered.err;

  // The other half.
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q", "--shard", "2/2"}).code, 0);
  ASSERT_EQ(here.carom({"gather", "output/offsets", "-q"}).code, 0);
  for (auto& row : rows_of(here.read("output/offsets/summary.csv")))
    EXPECT_EQ(std::stod(row["energy_start_J"]), 2 * std::stod(row["balls.red.mass"]) + 20);
}

TEST(Sweep, RunThatWasReplacedIsNotUpToDateAndNotGathered) {
  const Workplace here;
  prepare(here, masses("1, 2"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  ASSERT_EQ(
      here.shell("rm -r output/offsets/runs/r0001 && cp -r output/offsets/runs/r0002 output/offsets/runs/r0001").code,
      0);

  const Finished again = here.carom({"sweep", "offsets.yaml", "-q"});
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.err,
            "carom: offsets.yaml: the folder output/offsets/runs/r0001 holds something other than this run\n"
            "  write elsewhere with -o, or overwrite it with --force\n");
  EXPECT_EQ(here.carom({"gather", "output/offsets", "-q"}).code, 1);
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q", "--force"}).code, 0);
  EXPECT_EQ(here.carom({"gather", "output/offsets", "-q"}).code, 0);
}

TEST(Sweep, ForceRunsAgainAndANewMeasureRunsWhatLacksIt) {
  const Workplace here;
  prepare(here, masses("1, 2"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);

  const auto made = [&](const vector<string>& more) {
    vector<string> words = {"sweep", "offsets.yaml", "--json", "--progress", "none"};
    words.insert(words.end(), more.begin(), more.end());
    return Json::parse(here.carom(words).out)["made"];
  };

  EXPECT_EQ(made({}), 0);
  EXPECT_EQ(made({"--force"}), 2);

  // A measure that every run has.
  prepare(here, masses("1, 2", "compare: {measures: [energy_end_J]}\n"));
  EXPECT_EQ(made({}), 0);

  // A measure that needs the runs again.
  prepare(here, masses("1, 2", "compare: {measures: [balls.red.vx_m_per_s]}\n"));
  EXPECT_EQ(made({}), 2);
  EXPECT_EQ(made({}), 0);

  for (auto& row : rows_of(here.read("output/offsets/summary.csv")))
    EXPECT_LT(std::stod(row["balls.red.vx_m_per_s"]), 0) << row["run"];
}

TEST(Sweep, FolderThatCannotBeWrittenIsOneFailingRun) {
  const Workplace here;
  prepare(here, masses("1, 2, 3"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  ASSERT_EQ(here.shell("rm output/offsets/runs/r000*/energy.csv").code, 0);
  const Finished sweep = here.shell("flock output/offsets/runs/r0001 $CAROM sweep offsets.yaml -j 1 --progress none");
  EXPECT_EQ(sweep.code, 3) << sweep.err;
  EXPECT_NE(sweep.err.find("r0001: the run failed: "), string::npos) << sweep.err;
  const auto rows = rows_of(here.read("output/offsets/summary.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("status"), "failed");
  EXPECT_EQ(rows[2].at("status"), "done");
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
}

TEST(Sweep, MeshesCountByTheirBytes) {
  const Workplace here;
  const auto tetrahedron = [](const string& size) {
    return "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nv 0 0 " + size + "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  };
  here.write("a/pin.obj", tetrahedron("1"));
  here.write("b/pin.obj", tetrahedron("2"));
  prepare(here,
          "sweep: 1\nbase: balls.yaml\nonly: [frames]\nset: {output.frames: {fps: 1, size: [16, 16], samples: 1}}\n"
          "grid: {balls.red.mesh: [a/pin.obj, b/pin.obj]}\n");
  const auto sweep = [&] { return Json::parse(here.carom({"sweep", "offsets.yaml", "--json"}).out); };

  EXPECT_EQ(sweep()["made"], 2);
  EXPECT_EQ(here.read("output/offsets/runs/r0001/pin.obj"), tetrahedron("1"));
  EXPECT_EQ(here.read("output/offsets/runs/r0002/pin.obj"), tetrahedron("2"));
  EXPECT_EQ(sweep()["made"], 0);

  // The mesh of one run changes.
  here.write("b/pin.obj", tetrahedron("3"));
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 2);
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q", "--force"}).code, 0);
  EXPECT_EQ(here.read("output/offsets/runs/r0002/pin.obj"), tetrahedron("3"));
}

TEST(Sweep, TextsAndNumbersStandInTheTableAsTheirValues) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\nonly: [energy]\n"
          "grid: {balls.red.position.z: [+0.1, 0], balls.red.color: [\"red\", blue, green]}\n"
          "skip: [{balls.red.color: [red, 'blue'], balls.red.position.z: 0.1}]\n");
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  string table;
  for (auto& row : rows_of(here.read("output/offsets/summary.csv")))
    table += row["balls.red.position.z"] + " " + row["balls.red.color"] + "; ";
  EXPECT_EQ(table, "0.1 green; 0 red; 0 blue; 0 green; ");
}

TEST(Sweep, AllErrorsOfAllScenariosAreShownOnce) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\n"
          "grid: {balls.red.mass: [1, a, -3], simulate.duration: [-1, 2], balls.blue.radius: [q, 0.1]}\n");

  const Finished sweep = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_EQ(sweep.code, 2);
  for (const char* place : {"3:28", "3:31", "3:56", "3:84"})
    EXPECT_NE(sweep.err.find(string("offsets.yaml:") + place + ": error: "), string::npos) << sweep.err;
  EXPECT_NE(sweep.err.find("carom: 4 errors: nothing was run\n"), string::npos) << sweep.err;

  const Json json = Json::parse(here.carom({"sweep", "offsets.yaml", "--json"}).out);
  EXPECT_EQ(json["status"], "wrong");

  prepare(here, masses("1, 2", "compare: {measures: [balls.rde.x_m, energy_lst_J]}\n"));
  const Finished measures = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_NE(measures.err.find("offsets.yaml:5:22: error: "), string::npos) << measures.err;
  EXPECT_NE(measures.err.find("offsets.yaml:5:37: error: "), string::npos) << measures.err;
}

TEST(Sweep, LastValueOfAPathThatIsSetTwiceCounts) {
  const Workplace here;
  prepare(here, masses("1, 2", "set: {simulate.duration: 2}\n"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "--set", "simulate.duration=1.5", "-q"}).code, 0);
  ASSERT_EQ(here.carom({"gather", "output/offsets", "-q"}).code, 0);
  for (auto& row : rows_of(here.read("output/offsets/summary.csv"))) EXPECT_EQ(row["duration_s"], "1.5");
}

TEST(Sweep, RepeatsThatAreNoMoreLeaveNoTable) {
  const Workplace here;
  prepare(here, masses("1, 2", "repeat: {seeds: 2}\n"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  EXPECT_TRUE(here.has("output/offsets/repeats.csv"));
  prepare(here, masses("1, 2"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q", "--force"}).code, 0);
  EXPECT_FALSE(here.has("output/offsets/repeats.csv"));
}

TEST(Sweep, MeasureOfABodyThatAScenarioLacksIsAnEmptyCell) {
  const Workplace here;
  here.write("gas.yaml",
             "scene: 1\nroom: {min: [-1, -1, -1], max: [1, 1, 1]}\n"
             "groups: {gas: {count: 3, ball: {mass: 1, radius: 0.1}, in: {min: [-1, -1, -1], max: [1, 1, 1]}, "
             "arrange: random, speed: 1}}\nsimulate: {duration: 1}\n");
  here.write("s.yaml",
             "sweep: 1\nbase: gas.yaml\ngrid: {groups.gas.count: [3, 2]}\ncompare: {measures: [groups.gas.2.x_m]}\n");
  const Finished sweep = here.carom({"sweep", "s.yaml", "-q"});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  const auto rows = rows_of(here.read("output/s/summary.csv"));
  EXPECT_NE(rows[0].at("groups.gas.2.x_m"), "");
  EXPECT_EQ(rows[1].at("groups.gas.2.x_m"), "");
}

TEST(Sweep, PlanOfAPartHasItsRunsAlone) {
  const Workplace here;
  prepare(here, masses("1, 2, 3, 4, 5"));
  const auto ids = [&](const string& part) {
    const Finished plan = here.carom({"sweep", "offsets.yaml", "--plan", "--json", "--shard", part});
    const Json document = Json::parse(plan.out);
    string out;
    for (const Json& run : document["runs"]) out += run["run"].get<string>() + " ";
    return out;
  };
  EXPECT_EQ(ids("1/2"), "r0001 r0003 r0005 ");
  EXPECT_EQ(ids("2/2"), "r0002 r0004 ");
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "--plan", "-q"}).out, "");
}

TEST(Gather, RefusesAFolderThatHoldsSomethingElse) {
  const Workplace here;
  prepare(here, masses("1, 2"));
  ASSERT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "run"}).code, 0);
  const auto before = here.files("run");

  const Finished gathered = here.carom({"gather", "run", "output/offsets"});
  EXPECT_EQ(gathered.code, 2);
  EXPECT_EQ(gathered.err, "carom: the folder run holds something else; nothing was gathered\n");
  EXPECT_EQ(here.files("run"), before);

  // A user's own file of that name does not belong to the sweep.
  here.write("own/sweep.yaml", "# by hand\n" + masses("1, 2"));
  here.write("own/balls.yaml", two_balls());
  EXPECT_EQ(here.carom({"gather", "own"}).code, 2);
  EXPECT_EQ(here.files("own").size(), 2u);
}

TEST(Submit, WrongSweepIsExitCode2AndForceIsPassedOn) {
  const Workplace here;
  prepare(here, "sweep: 1\nbase: balls.yaml\ngird: {balls.red.mass: [1, 2]}\n");
  const Finished wrong = here.carom({"submit", "offsets.yaml", "--slurm"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(wrong.err.starts_with("offsets.yaml:3:1: error: unknown key `gird`")) << wrong.err;
  prepare(here, masses("1, 2"));
  const Finished forced = here.carom({"submit", "offsets.yaml", "--slurm", "--force"});
  EXPECT_NE(forced.out.find(" --force --jobs "), string::npos) << forced.out;
  EXPECT_EQ(Json::parse(here.carom({"submit", "offsets.yaml", "--slurm", "--force", "--json"}).out)["script"],
            forced.out);
}

TEST(Sweep, NumberOfJobsChangesNoByte) {
  const Workplace here;
  prepare(here);
  here.carom({"sweep", "offsets.yaml", "-j", "1", "-o", "one", "-q"});
  here.carom({"sweep", "offsets.yaml", "-j", "3", "-o", "three", "-q"});
  EXPECT_EQ(differing(here, "one", "three"), Names{});
}

TEST(Sweep, EqualScenariosAreCopiesAndCamerasShareASimulation) {
  const Workplace here;
  prepare(here,
          "sweep: 1\nbase: balls.yaml\nlist:\n"
          "  - {camera.fov: 30}\n  - {camera.fov: 60}\n  - {camera.fov: 30}\n");
  here.write("balls.yaml", two_balls("camera: {eye: [0, 1, -4], target: [0, 0, 0]}\n"
                                     "output: {collisions: true, frames: {fps: 4, size: [64, 36], samples: 1}}\n"));

  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  const auto run = [&](const string& id) { return here.files("output/offsets/runs/" + id); };
  // A copy has the times of its original too.
  EXPECT_EQ(here.read("output/offsets/runs/r0001/manifest.json"), here.read("output/offsets/runs/r0003/manifest.json"));
  EXPECT_EQ(run("r0001").size(), run("r0003").size());
  EXPECT_NE(here.read("output/offsets/runs/r0001/frames/frame_00001.png"),
            here.read("output/offsets/runs/r0002/frames/frame_00001.png"));

  const Json one = Json::parse(here.read("output/offsets/runs/r0001/manifest.json"));
  const Json two = Json::parse(here.read("output/offsets/runs/r0002/manifest.json"));
  EXPECT_EQ(one["wall_times_s"]["simulate"], two["wall_times_s"]["simulate"]);  // one and the same

  // A run by itself has the same pictures.
  here.carom({"run", "balls.yaml", "--set", "camera.fov=60", "-o", "alone", "-q"});
  EXPECT_EQ(here.read("alone/frames/frame_00003.png"), here.read("output/offsets/runs/r0002/frames/frame_00003.png"));
}

TEST(Sweep, FolderOfAnotherSweepIsNotOverwrittenWithoutForce) {
  const Workplace here;
  prepare(here);
  here.carom({"sweep", "offsets.yaml", "-q"});
  const Files before = here.files("output");
  here.write("offsets.yaml", "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.mass: [1, 2]}\n");
  const Finished refused = here.carom({"sweep", "offsets.yaml", "--progress", "none"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--force"), string::npos) << refused.err;
  EXPECT_EQ(here.files("output"), before);
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "--force", "-q"}).code, 0);
  EXPECT_FALSE(here.has("output/offsets/runs/r0003"));
  EXPECT_EQ(lines_of(here.read("output/offsets/summary.csv")).size(), 3u);
}

TEST(Sweep, VariesASceneFromTheCommandLine) {
  const Workplace here;
  prepare(here);
  const Finished sweep = here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1:2:3", "--grid",
                                     "balls.red.position.z=0,0.01", "--set", "simulate.duration=1", "-q"});
  EXPECT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_TRUE(here.has("output/balls.sweep/runs/r0006/summary.csv"));
}

TEST(Sweep, VariesNumbersOfLetAndTakesExpressionsOfThem) {
  const Workplace here;
  here.write("row.yaml", R"(scene: 1
let: {r: 0.1, n: 2}
balls: {row: {repeat: = n, radius: = r, mass: 1, position: [= 3 * r * i, 0, 0]}}
simulate: {duration: 0.1}
output: {energy: {every: 0.1}}
)");

  const Finished run = here.carom({"sweep", "row.yaml", "--grid", "let.n=1:3:3", "--grid", "let.r=0.2,= n / 8", "-q"});
  ASSERT_EQ(run.code, 0) << run.err;

  std::istringstream table(here.files("output/row.sweep").at("summary.csv"));
  string line, ends;
  for (std::getline(table, line); std::getline(table, line);) {
    const size_t last = line.rfind(','), before = line.rfind(',', last - 1);
    ends += line.substr(before) + "\n";
  }
  EXPECT_EQ(ends, ",1,0.2\n,1,0.125\n,2,0.2\n,2,0.25\n,3,0.2\n,3,0.375\n");

  EXPECT_NE(here.carom({"sweep", "row.yaml", "-o", "q", "--grid", "let.q=1,2"}).err.find("`let` has no `q`"),
            string::npos);
  EXPECT_NE(here.carom({"sweep", "row.yaml", "-o", "q", "--grid", "let.r=1,= q"}).err.find("no number is named `q`"),
            string::npos);
}

TEST(Sweep, InterruptedIsResumedByTheSameCommand) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  prepare(here, "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.position.z: {from: 0, to: 0.2, count: 401}}\n");
  const Finished stopped = here.interrupted({"sweep", "offsets.yaml", "--progress", "none"},
                                            "output/offsets/runs/r0005/manifest.json", SIGTERM);
  EXPECT_EQ(stopped.code, 143);
  EXPECT_NE(stopped.err.find("the same command runs what is missing"), string::npos) << stopped.err;
  EXPECT_FALSE(here.has("output/offsets/summary.csv"));
  for (const auto& [name, bytes] : here.files("output")) EXPECT_FALSE(name.ends_with(".part")) << name;
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "-q"}).code, 0);
  here.carom({"sweep", "offsets.yaml", "-o", "whole", "-q"});
  EXPECT_EQ(differing(here, "output/offsets", "whole"), Names{});
}

TEST(Gather, PartsHaveTheBytesOfTheWhole) {
  const Workplace here;
  prepare(here, grid + "repeat: {seeds: 2}\n");
  here.carom({"sweep", "offsets.yaml", "-o", "whole", "-q"});
  for (const string part : {"1/3", "2/3", "3/3"})
    EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "--shard", part, "-o", "parts", "-q"}).code, 0);
  EXPECT_FALSE(here.has("parts/summary.csv"));
  const Finished gather = here.carom({"gather", "parts", "--progress", "none"});
  EXPECT_EQ(gather.code, 0) << gather.err;
  EXPECT_EQ(differing(here, "whole", "parts"), Names{});
}

TEST(Gather, KilledPartIsMissedAndRepeated) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  prepare(here, "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.position.z: {from: 0, to: 0.2, count: 301}}\n");
  here.carom({"sweep", "offsets.yaml", "-o", "whole", "-q"});
  const vector<string> first = {"sweep", "offsets.yaml", "--shard", "1/2", "-o", "parts", "-q"};
  EXPECT_EQ(here.interrupted(first, "parts/runs/r0003/manifest.json", SIGKILL).code, 1000 + SIGKILL);
  EXPECT_EQ(here.carom({"sweep", "offsets.yaml", "--shard", "2/2", "-o", "parts", "-q"}).code, 0);

  const Finished early = here.carom({"gather", "parts", "--progress", "none"});
  EXPECT_EQ(early.code, 1);
  EXPECT_NE(early.err.find(" of 301 runs are missing: "), string::npos) << early.err;
  EXPECT_FALSE(here.has("parts/summary.csv"));
  EXPECT_EQ(here.carom(first).code, 0);
  EXPECT_EQ(here.carom({"gather", "parts", "-q"}).code, 0);
  EXPECT_EQ(differing(here, "whole", "parts"), Names{});
}

TEST(Gather, BringsPartsFromOtherFolders) {
  const Workplace here;
  prepare(here);
  here.carom({"sweep", "offsets.yaml", "-o", "whole", "-q"});
  here.carom({"sweep", "offsets.yaml", "--shard", "1/2", "-o", "a", "-q"});
  here.carom({"sweep", "offsets.yaml", "--shard", "2/2", "-o", "b", "-q"});
  EXPECT_EQ(here.carom({"gather", "all", "a", "b", "-q"}).code, 0);
  EXPECT_EQ(differing(here, "whole", "all"), Names{});
  here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "other", "-q"});
  EXPECT_EQ(here.carom({"gather", "all", "other"}).code, 2);
  EXPECT_EQ(here.carom({"gather", "nothing"}).code, 2);
}

TEST(Gather, TaskOfAJobArrayDoesItsPart) {
  const Workplace here;
  prepare(here);
  const Finished task = here.shell(
      "SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_MIN=4 SLURM_ARRAY_TASK_STEP=3 SLURM_ARRAY_TASK_COUNT=2 "
      "\"$CAROM\" sweep offsets.yaml --progress none");
  EXPECT_EQ(task.code, 0) << task.err;
  EXPECT_NE(task.out.find("part 2 of 2 done"), string::npos) << task.out;
}

TEST(Submit, ScriptRunsItsPartsAndGathers) {
  const Workplace here;
  prepare(here);
  const Finished script = here.carom({"submit", "offsets.yaml", "--slurm", "--parts", "2", "-o", "a b"});
  EXPECT_EQ(script.code, 0) << script.err;
  here.write("job.sh", script.out);
  // An sbatch that runs its script at once.
  here.write("bin/sbatch",
             "#!/bin/sh\ncase \"$*\" in\n*--wrap*) for w; do :; done; eval \"$w\" >&2 ;;\n"
             "*) for i in 1 2; do SLURM_ARRAY_TASK_ID=$i sh job.sh >&2; done ;;\nesac\necho 7\n");
  const Finished submitted = here.shell("chmod +x bin/sbatch; PATH=$PWD/bin:$PATH sh job.sh");
  EXPECT_EQ(submitted.code, 0) << submitted.err;
  EXPECT_EQ(submitted.out, "parts: job 7; gather: job 7\n");
  EXPECT_EQ(lines_of(here.read("a b/summary.csv")).size(), 7u) << submitted.err;
}

TEST(SweepScenes, BowlingLosesTheClosedFormsEnergy) {
  const Workplace here;
  const Finished sweep =
      here.carom({"sweep", SCENES_DIR "/sweeps/bowling.yaml", "--only", "energy", "-o", "out", "-q"});
  EXPECT_EQ(sweep.code, 0) << sweep.err;
  const auto rows = rows_of(here.read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 18u);
  for (const auto& row : rows) {
    const double e = std::stod(row.at("defaults.ball.restitution")), z = std::stod(row.at("balls.red.position.z"));
    EXPECT_NEAR(std::stod(row.at("energy_lost_J")), 20 * (1 - e * e) * (1 - z * z / (8 * 0.11 * 0.11)), 1e-13);
  }
}

TEST(SweepScenes, WhatLiesOnTheBasketballIsShotUpByTheClosedForm) {
  const Workplace here;
  EXPECT_EQ(here.carom({"sweep", SCENES_DIR "/sweeps/ball_on_ball.yaml", "-o", "out", "-q"}).code, 0);
  const auto rows = rows_of(here.read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 6u);
  for (const auto& row : rows) {
    const double m = std::stod(row.at("balls.tennis_ball.mass")), big = 0.62;
    EXPECT_NEAR(std::stod(row.at("max_speed_m_per_s")), (3 * big - m) / (big + m) * 2.800949838893942, 1e-13);
  }
}

TEST(SweepScenes, GasPressureSeparatesChanceFromSize) {
  const Workplace here;
  EXPECT_EQ(here.carom({"sweep", SCENES_DIR "/sweeps/gas_pressure.yaml", "-o", "out", "-q"}).code, 0);
  const auto rows = rows_of(here.read("out/repeats.csv"));
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) {
    const double sd = std::stod(row.at("body_body.sd")), n = std::stod(row.at("body_body.mean"));
    EXPECT_GT(sd, sqrt(n) / 3) << n;
    EXPECT_LT(sd, sqrt(n) * 3) << n;
  }
}

}  // namespace
}  // namespace carom::testing
