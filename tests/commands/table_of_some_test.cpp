// trajectory.csv of some of the bodies, and what reads it: by the real program.
#include <gtest/gtest.h>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

/// A ball, a group and a family, with these keys of `trajectory`.
string mixed(const string& keys) {
  return "scene: 1\ntitle: Mixed\nseed: 1\n"
         "balls:\n  big: {mass: 3, radius: 0.2, position: [0, 2, 0], velocity: [1, 0, 0]}\n"
         "  row: {repeat: 2, mass: 1, radius: 0.1, position: [=1 + i, 1, 0]}\n"
         "groups: {gas: {count: 3, ball: {mass: 1, radius: 0.05}, in: {min: [3, 0, 0], max: [4, 1, 1]}, speed: 1}}\n"
         "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
         "simulate: {duration: 1}\noutput: {trajectory: {every: 0.5" +
         keys + "}, energy: {every: 0.5}}\n";
}

/// The rows of a table that begin with a time and one of these names, and its head.
string rows_of(const string& table, const vector<string>& names) {
  std::istringstream lines(table);
  string line, kept;
  std::getline(lines, line);
  kept = line + "\n";
  while (std::getline(lines, line)) {
    const size_t first = line.find(',') + 1;
    if (contains(names, line.substr(first, line.find(',', first) - first))) kept += line + "\n";
  }
  return kept;
}

TEST(TableOfSome, HasTheRowsOfTheTableOfAll) {
  const Workplace here;
  here.write("all.yaml", mixed(""));
  ASSERT_EQ(here.carom({"run", "all.yaml", "-o", "all", "-q"}).code, 0);
  const string all = here.read("all/trajectory.csv");

  const vector<pair<string, vector<string>>> cases = {{"big", {"big"}},
                                                      {"row", {"row.0", "row.1"}},
                                                      {"row.1, big", {"big", "row.1"}},
                                                      {"gas", {"gas.0", "gas.1", "gas.2"}},
                                                      {"gas.2, row.0", {"row.0", "gas.2"}}};
  for (const auto& [on, names] : cases) {
    here.write("some.yaml", mixed(", on: [" + on + "]"));
    const Finished run = here.carom({"run", "some.yaml", "-o", "some", "-q", "--force"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(here.read("some/trajectory.csv"), rows_of(all, names)) << on;
    EXPECT_EQ(here.read("some/summary.csv").find("failed"), string::npos);

    // The resolved scene is the same, and so is its run.
    ASSERT_EQ(here.carom({"run", "some/scene.yaml", "-o", "again", "-q", "--force"}).code, 0);
    EXPECT_EQ(without_manifest(here.files("again")), without_manifest(here.files("some")));
  }
}

TEST(TableOfSome, HasTheirColumnsWhereItIsWide) {
  const Workplace here;
  here.write("some.yaml", mixed(", layout: wide, on: [gas.1, big]"));
  ASSERT_EQ(here.carom({"run", "some.yaml", "-o", "some", "-q"}).code, 0);
  const string table = here.read("some/trajectory.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "time_s,big.x_m,big.y_m,big.z_m,big.vx_m_per_s,big.vy_m_per_s,big.vz_m_per_s,"
            "gas.1.x_m,gas.1.y_m,gas.1.z_m,gas.1.vx_m_per_s,gas.1.vy_m_per_s,gas.1.vz_m_per_s");
  EXPECT_EQ(ranges::count(table, ','), 4 * 12);
  EXPECT_EQ(ranges::count(table, '\n'), 4);
  // An edit of `on` is another request.
  EXPECT_NE(here.carom({"run", "some.yaml", "-o", "some"}).out.find("up to date"), string::npos);
  here.write("some.yaml", mixed(", layout: wide, on: [gas.1]"));
  EXPECT_EQ(here.carom({"run", "some.yaml", "-o", "some"}).out.find("up to date"), string::npos);
}

TEST(TableOfSome, CountsInTheForecast) {
  const Workplace here;
  here.write("some.yaml", mixed(", on: [big]"));
  const Finished check = here.carom({"check", "some.yaml"});
  EXPECT_NE(check.out.find("3 trajectory rows"), string::npos) << check.out;
  // So it does against the limit of rows.
  here.write("long.yaml",
             "scene: 1\nballs: {big: {mass: 1, radius: 0.1, position: [0, 0, 0]}}\n"
             "groups: {gas: {count: 300, ball: {mass: 1, radius: 0.05}, in: {min: [3, 0, 0], "
             "max: [9, 9, 9]}}}\n"
             "simulate: {duration: 10000}\noutput: {trajectory: {every: 0.01}}\n");
  EXPECT_EQ(here.carom({"check", "long.yaml"}).code, 2);
  EXPECT_EQ(here.carom({"check", "long.yaml", "--set", "output.trajectory.on=[big]"}).code, 0);
}

TEST(TableOfSome, IsNoStartWithoutFlights) {
  const Workplace here;
  here.write("first.yaml", mixed(", on: [big]"));
  ASSERT_EQ(here.carom({"run", "first.yaml", "-o", "first", "-q"}).code, 0);
  here.write("second.yaml", mixed("") + "start: {run: first}\n");
  EXPECT_EQ(here.carom({"check", "second.yaml"}).err,
            "second.yaml:11:14: error: the run `first` cannot be used: it has no flights, and its trajectory.csv has "
            "rows of big alone\n"
            "  11 | start: {run: first}\n"
            "     |              ^~~~~\n"
            "     = run it with `output.flights: true`, or with `output.trajectory` without `on`\n"
            "carom: 1 error\n");

  // With flights it is.
  ASSERT_EQ(here.carom({"run", "first.yaml", "-o", "first", "-q", "--only", "trajectory,flights", "--force"}).code, 0);
  const Finished run = here.carom({"run", "second.yaml", "-o", "second", "-q"});
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST(TableOfSome, HasNoChartsOfAllBodies) {
  const Workplace here;
  here.write("some.yaml", mixed(", on: [big, row.1]"));
  ASSERT_EQ(here.carom({"run", "some.yaml", "-o", "some", "-q"}).code, 0);
  EXPECT_EQ(here.carom({"plot", "some"}).out,
            "some: Mixed\n"
            "  left out    heights: the run's trajectory.csv has rows of big, row.1 alone, by the key\n"
            "              output.trajectory.on\n"
            "  left out    speeds: the run's trajectory.csv has rows of big, row.1 alone, by the key\n"
            "              output.trajectory.on\n"
            "  left out    collisions: the run has no collisions.csv, which the key output.collisions gives\n"
            "  wrote       some/plots: energy, each as SVG and PNG\n");

  // A run draws its charts from the motion itself.
  here.write("all.yaml", mixed(""));
  for (const char* name : {"all", "some"})
    ASSERT_EQ(here.carom({"run", string(name) + ".yaml", "-o", name, "-q", "--force", "--only", "plots"}).code, 0);
  EXPECT_EQ(here.files("some/plots"), here.files("all/plots"));
}

TEST(TableOfSome, GivesItsOwnMeasuresAlone) {
  const Workplace here;
  for (const char* x : {"1", "2"}) {
    here.write("some.yaml", mixed(", on: [big]"));
    ASSERT_EQ(
        here.carom({"run", "some.yaml", "-o", string("runs") + x, "-q", "--set", string("balls.big.velocity.x=") + x})
            .code,
        0);
  }

  const Finished good = here.carom({"compare", "runs1", "runs2", "-o", "good", "--measures", "balls.big.x_m"});
  EXPECT_EQ(good.code, 0) << good.err;
  for (const string measure : {"balls.row.0.y_m", "count(y_m < 0)"}) {
    const Finished bad = here.carom({"compare", "runs1", "runs2", "-o", "bad", "--measures", measure});
    EXPECT_EQ(bad.code, 1);
    EXPECT_NE(bad.err.find("runs1/trajectory.csv has rows of big alone, which " + measure +
                           " needs more of: run its scene.yaml again without `on` in `trajectory`, or with the measure "
                           "in `measures`"),
              string::npos)
        << bad.err;
  }
}

TEST(TableOfSome, OfWhatIsNoBodyIsRefused) {
  const Workplace here;
  const auto error = [&](const string& keys) {
    here.write("some.yaml", mixed(keys));
    const string text = here.carom({"check", "some.yaml"}).err;
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(error(", on: [floor]"), "some.yaml:10:40: error: `floor` is a fixed thing: it has no rows");
  EXPECT_EQ(error(", on: [bigg]"), "some.yaml:10:40: error: nothing is named `bigg`");
  EXPECT_EQ(error(", on: [gas.3]"), "some.yaml:10:40: error: the group `gas` has no member `3`");
  EXPECT_NE(error(", on: []").find("some.yaml:10:39: error: "), string::npos) << error(", on: []");
}

/// Measures of contact and of time in every place where measures stand.
TEST(NewMeasures, AreColumnsOfSummariesSweepsAndComparisons) {
  const Workplace here;
  here.write(
      "drop.yaml",
      "scene: 1\ngravity: [0, -10, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [0, 1.35, 0], restitution: 1}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 2}\n"
      "measures: {push_N_s: impulse(floor), mean_m: mean(balls.b.y_m), "
      "late_N_s: 'impulse(floor, from: 1)', force_N: '= impulse(floor) / 2'}\n");
  here.write("sweep.yaml",
             "sweep: 1\nbase: drop.yaml\ngrid: {balls.b.mass: [2, 4]}\n"
             "compare:\n  measures: [push_N_s, 'impulse(b, floor, until: 1)', mean(balls.b.kinetic_J), force_N]\n"
             "  charts: [{x: balls.b.mass, y: push_N_s}]\n");

  ASSERT_EQ(here.carom({"run", "drop.yaml", "-o", "drop", "-q"}).code, 0);
  const string summary = here.read("drop/summary.csv");
  EXPECT_NE(summary.find(",push_N_s,mean_m,late_N_s,force_N\n"), string::npos) << summary;
  EXPECT_NE(summary.find(",40,"), string::npos) << summary;

  const Finished sweep = here.carom({"sweep", "sweep.yaml", "-o", "swept", "-q"});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  const string rows = here.read("swept/summary.csv");
  const string head = rows.substr(0, rows.find('\n'));
  EXPECT_TRUE(head.find("\"impulse(b, floor, until: 1)\",mean(balls.b.kinetic_J)") != string::npos) << head;
  EXPECT_TRUE(here.has("swept/comparison.xlsx"));

  // Nothing is run again for what the runs have measured.
  const Finished compare =
      here.carom({"compare", "swept", "-o", "compared", "--measures", "push_N_s,mean(balls.b.kinetic_J)"});
  EXPECT_EQ(compare.code, 0) << compare.err;

  // A window of collisions comes from their table: those at 0.5 and 1.5 s.
  const Finished late =
      here.carom({"compare", "swept", "-o", "late", "--measures", "hits(b, from: 1),hits(b, until: 0.4)"});
  EXPECT_EQ(late.code, 0) << late.err;
  const string table = here.read("late/summary.csv");
  EXPECT_NE(table.find("\"hits(b, from: 1)\",\"hits(b, until: 0.4)\""), string::npos) << table;
  EXPECT_NE(table.find(",1,0"), string::npos) << table;

  // What they have not is named.
  const Finished lacks = here.carom({"compare", "swept", "-o", "lacks", "--measures", "impulse(b)"});
  EXPECT_EQ(lacks.code, 1);
  EXPECT_NE(lacks.err.find("did not measure impulse(b): run its scene.yaml again with this in `measures`"),
            string::npos)
      << lacks.err;
}

TEST(NewMeasures, AreRefusedWithPlaceAndRemedy) {
  const Workplace here;
  here.write("drop.yaml",
             "scene: 1\nballs: {b: {mass: 2, radius: 0.1, position: [0, 1, 0]}}\nsimulate: {duration: 2}\n"
             "measures:\n  late: 'hits(b, from: 2)'\n  none: impulse(flor)\n  sum: '= 1 + mean(balls.b.y_m, from: 1, "
             "until: 1)'\n");

  EXPECT_EQ(here.carom({"check", "drop.yaml"}).err,
            "drop.yaml:5:9: error: `late`: `from` is 2 s but the scene ends at 2 s\n"
            "   5 |   late: 'hits(b, from: 2)'\n"
            "     |         ^~~~~~~~~~~~~~~~~~\n"
            "     = expected less\n"
            //
            "drop.yaml:6:9: error: `none`: nothing is named `flor`\n"
            "   6 |   none: impulse(flor)\n"
            "     |         ^~~~~~~~~~~~~\n"
            "     = there is `b`\n"
            //
            "drop.yaml:7:15: error: `mean(balls.b.y_m, from: 1, until: 1)`: `until` is 1 s but `from` is 1 s\n"
            "   7 |   sum: '= 1 + mean(balls.b.y_m, from: 1, until: 1)'\n"
            "     |               ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\n"
            "     = expected from < until\n"
            "carom: 3 errors\n");
}

}  // namespace
}  // namespace carom::testing
