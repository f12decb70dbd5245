// Tables in other forms, and what reads them: by the real program, and by pandas.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

const string german = R"({separator: ";", decimal: ","})",
             german_gzip = R"({format: csv.gz, separator: ";", decimal: ","})";

/// Ten balls of which one leaves by a region, for 1 s. `more`: further keys of the scene.
string scene(const string& more = "") {
  return "scene: 1\ntitle: \"Balls; 1,5 m high\"\nseed: 3\nrestitution: 0.8\n"
         "groups: {gas: {count: 10, ball: {mass: 1, radius: 0.05}, in: {min: [0, 0, 0], max: [1, 1, 1]}, speed: 1}}\n"
         "room: {min: [0, 0, 0], max: [1, 1, 1]}\n"
         "regions: {low: {position: [0.5, 0.1, 0.5], box: [1, 0.2, 1]}}\nmeasures: {entries: regions.low.entries}\n"
         "simulate: {duration: 1}\n"
         "output: {trajectory: {every: 0.05}, collisions: true, energy: {every: 0.02}, contacts: {every: 0.1}, "
         "regions: true}\n" +
         more;
}

const vector<string> tables = {"trajectory", "collisions", "energy", "contacts", "regions"};

void run(const Workplace& here, const string& file, const string& form, const string& folder,
         const vector<string>& more = {}) {
  vector<string> words = {"run", file, "-q", "-o", folder, "--set", "output.tables=" + form};
  words.insert(words.end(), more.begin(), more.end());
  const Finished run = here.carom(words);
  ASSERT_EQ(run.code, 0) << run.err;
}

TEST(TablesInOtherForms, HoldWhatCsvHoldsToThePandasReader) {
  const Workplace here;
  here.write("scene.yaml", scene());
  run(here, "scene.yaml", "csv", "csv");
  run(here, "scene.yaml", "csv.gz", "gz");
  run(here, "scene.yaml", german, "german");
  run(here, "scene.yaml", german_gzip, "german_gz");
  run(here, "scene.yaml", "xlsx", "xlsx");
  for (const string& table : tables) {
    EXPECT_FALSE(here.has("gz/" + table + ".csv"));
    EXPECT_EQ(here.read("xlsx/" + table + ".csv"), here.read("csv/" + table + ".csv"));
  }
  const Finished done = here.shell("/usr/bin/python3 " SOURCE_DIR "/tests/commands/read_tables.py");
  EXPECT_EQ(done.code, 0) << done.err;
  // Five tables and the summary in each of four forms.
  EXPECT_TRUE(done.out.ends_with(" in 24 tables\n")) << done.out;
}

TEST(TablesInOtherForms, HaveTheSameBytesForAnyThreadsAndWhenRunAgain) {
  const Workplace here;
  here.write("scene.yaml", scene());
  for (const string& form : {string("csv.gz"), string("xlsx"), german_gzip}) {
    run(here, "scene.yaml", form, "a", {"--threads", "1", "--force"});
    run(here, "scene.yaml", form, "b", {"--threads", "3", "--force"});
    run(here, "a/scene.yaml", form, "c", {"--force"});
    EXPECT_EQ(without_manifest(here.files("a")), without_manifest(here.files("b"))) << form;
    EXPECT_EQ(without_manifest(here.files("a")), without_manifest(here.files("c"))) << form;
    const Finished again = here.carom({"run", "scene.yaml", "-o", "a", "--set", "output.tables=" + form});
    EXPECT_NE(again.out.find("up to date"), string::npos) << again.out;
  }
}

/// What commands make of two runs, by name.
map<string, string> results_of(const string& form) {
  const Workplace here;
  here.write("scene.yaml", scene());
  here.write("next.yaml",
             "scene: 1\ndefaults: {ball: {mass: 1, radius: 0.05}}\nballs: {gas: {repeat: 10, position: [=i, 0, 0]}}\n"
             "start: {run: a, at: 0.5}\nsimulate: {duration: 0.1}\noutput: {trajectory: {every: 0.1}}\n");
  run(here, "scene.yaml", form, "a", {"--set", "restitution.default=0.5"});
  run(here, "scene.yaml", form, "b", {"--set", "restitution.default=0.75"});
  map<string, string> results;
  results["diff"] = here.carom({"diff", "a", "b"}).out;
  results["diff of one"] = here.carom({"diff", "a", "a"}).out;

  const Finished compare = here.carom({"compare", "a", "b", "-o", "c", "-q", "--collisions", "--measures",
                                       "groups.gas.0.x_m,entries,hits(gas.1),collisions"});
  EXPECT_EQ(compare.code, 0) << compare.err;
  results["workbook"] = here.read("c/comparison.xlsx");
  EXPECT_EQ(here.carom({"plot", "a", "-q"}).code, 0);
  for (const auto& [name, bytes] : here.files("a/plots")) results[name] = bytes;

  const Finished start = here.carom({"run", "next.yaml", "-q", "-o", "next"});
  EXPECT_EQ(start.code, 0) << start.err;
  results["start"] = here.read("next/trajectory.csv");
  return results;
}

TEST(TablesInOtherForms, AreReadLikeCsvByAllCommands) {
  const auto right = results_of("csv");
  EXPECT_NE(right.at("diff").find("collisions"), string::npos);
  EXPECT_GT(right.at("workbook").size(), 5000U);
  EXPECT_GT(right.at("start").size(), 500U);
  EXPECT_TRUE(right.contains("speeds.svg") || right.contains("a/plots/speeds.svg"));
  for (const string& form : {string("csv.gz"), german, german_gzip, string("xlsx")}) {
    const auto results = results_of(form);
    ASSERT_EQ(results.size(), right.size());
    for (const auto& [name, bytes] : right) EXPECT_TRUE(results.at(name) == bytes) << form << ": " << name;
  }
}

TEST(TablesInOtherForms, AreRefusedWhenDamaged) {
  const Workplace here;
  here.write("scene.yaml", scene());
  run(here, "scene.yaml", "csv.gz", "a");
  run(here, "scene.yaml", "csv.gz", "b", {"--seed", "4"});
  const string whole = here.read("a/collisions.csv.gz");
  here.write("a/collisions.csv.gz", whole.substr(0, whole.size() - 9));
  const Finished compare = here.carom({"compare", "a", "b", "-o", "c"});
  EXPECT_EQ(compare.code, 2);
  EXPECT_NE(compare.err.find("collisions.csv.gz has changed since the run"), string::npos) << compare.err;
  const Finished again = here.carom({"run", "scene.yaml", "-o", "a", "--set", "output.tables=csv.gz"});
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("with a changed file, collisions.csv.gz"), string::npos) << again.err;
}

TEST(TablesInOtherForms, StayWhenPicturesAreDrawnAgain) {
  const Workplace here;
  here.write("scene.yaml", scene("camera: {eye: [0.5, 0.5, -3], target: [0.5, 0.5, 0]}\n"));
  const vector<string> small = {"--set", "output.frames.fps=2", "--set", "output.frames.size=[32, 18]"};
  for (const string& form : {string("csv.gz"), string("xlsx")}) {
    run(here, "scene.yaml", form, "a", {small[0], small[1], small[2], small[3], "--force"});
    const auto before = here.files("a");
    const Finished render = here.carom({"render", "a", "-q", "--set", "camera.fov=20"});
    ASSERT_EQ(render.code, 0) << render.err;

    auto after = here.files("a");
    for (const auto& [name, bytes] : before) {
      if (name.find("csv") != string::npos || name.find("xlsx") != string::npos) {
        EXPECT_TRUE(after[name] == bytes) << name;
      }
    }
    EXPECT_EQ(before.size(), after.size());

    const Finished refused = here.carom({"render", "a", "--set", "output.tables=csv"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("render writes no tables"), string::npos) << refused.err;
  }
}

TEST(TablesInOtherForms, OfARunThatIsReplacedAreRemoved) {
  const Workplace here;
  here.write("scene.yaml", scene());
  run(here, "scene.yaml", "csv.gz", "a");
  run(here, "scene.yaml", "xlsx", "a", {"--force"});
  EXPECT_FALSE(here.has("a/energy.csv.gz"));
  EXPECT_TRUE(here.has("a/tables.xlsx"));
  run(here, "scene.yaml", "csv", "a", {"--force"});
  EXPECT_FALSE(here.has("a/tables.xlsx"));
  // --only leaves the form as it is.
  run(here, "scene.yaml", "csv.gz", "b", {"--only", "energy"});
  EXPECT_TRUE(here.has("b/energy.csv.gz"));
  EXPECT_FALSE(here.has("b/trajectory.csv.gz"));
}

TEST(TablesInOtherForms, OfASweepHaveItsBasesDialect) {
  const Workplace here;
  here.write("base.yaml", scene() + "");
  here.write("sweep.yaml", "sweep: 1\nbase: base.yaml\nset: {output.tables: " + german + "}\n" +
                               "grid: {restitution.default: [0.5, 0.75]}\nrepeat: {seeds: 2}\n"
                               "compare: {measures: [max_speed_m_per_s]}\n");
  const Finished sweep = here.carom({"sweep", "sweep.yaml", "-q", "-o", "s"});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_TRUE(here.read("s/summary.csv").starts_with("run;title;engine;"));
  EXPECT_NE(here.read("s/summary.csv").find("\nr0001;\"Balls; 1,5 m high\";exact;"), string::npos);
  EXPECT_TRUE(here.read("s/repeats.csv").starts_with("restitution.default;n;max_speed_m_per_s.mean;"));
  EXPECT_NE(here.read("s/repeats.csv").find("\n0,5;2;"), string::npos);

  // Shards of it, gathered, have the same bytes.
  for (const char* part : {"1/2", "2/2"})
    ASSERT_EQ(here.carom({"sweep", "sweep.yaml", "-q", "-o", "g", "--shard", part}).code, 0);
  ASSERT_EQ(here.carom({"gather", "g", "-q"}).code, 0);
  for (const char* file : {"summary.csv", "repeats.csv", "comparison.xlsx"})
    EXPECT_TRUE(here.read(string("g/") + file) == here.read(string("s/") + file)) << file;
}

TEST(TablesInOtherForms, SkippedRunsHaveItToo) {
  const Workplace here;
  string base = scene();
  base.replace(base.rfind('}'), 1, ", tables: " + german + "}");
  here.write("base.yaml", base);
  here.write("sweep.yaml",
             "sweep: 1\nbase: base.yaml\nskip_invalid: true\ngrid: {groups.gas.ball.radius: [0.05, 5]}\n");
  const Finished sweep = here.carom({"sweep", "sweep.yaml", "-q", "-o", "s"});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_TRUE(here.read("s/skipped.csv").starts_with("run;error\nr0002;")) << here.read("s/skipped.csv");
  // It is read back where the runs are compared.
  const Finished again = here.carom({"sweep", "sweep.yaml", "-o", "s"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("r0002: 10 balls of radius 5 do not fit"), string::npos) << again.out;
}

TEST(TablesInOtherForms, WrongOnesAreErrorsWithARemedy) {
  const Workplace here;
  here.write("parquet.yaml", "scene: 1\nsimulate: {duration: 1}\noutput: {tables: parquet}\n");
  EXPECT_EQ(here.carom({"run", "parquet.yaml"}).err,
            "parquet.yaml:3:18: error: `format` is `parquet`\n"
            "   3 | output: {tables: parquet}\n"
            "     |                  ^~~~~~~\n"
            "     = expected csv, csv.gz or xlsx\n"
            "     = There is no Parquet. `tables: csv.gz` in `output` is compact, and pandas and R read it as it is.\n"
            "carom: 1 error; nothing was run\n");

  here.write("commas.yaml", "scene: 1\nsimulate: {duration: 1}\noutput: {tables: {decimal: \",\"}}\n");
  EXPECT_EQ(here.carom({"check", "commas.yaml"}).err,
            "commas.yaml:3:28: error: the separator of cells and the decimal mark are both commas\n"
            "   3 | output: {tables: {decimal: \",\"}}\n"
            "     |                            ^~~\n"
            "     = expected `{separator: \";\", decimal: \",\"}`, as spreadsheets with decimal commas have it\n"
            "carom: 1 error\n");

  here.write("format.yaml", "scene: 1\nsimulate: {duration: 1}\noutput: {format: csv.gz}\n");
  EXPECT_NE(here.carom({"run", "format.yaml"}).err.find("`format` is a key of `tables`"), string::npos);
}

TEST(LargeTables, AreNamedAheadAndAfterwards) {
  const Workplace here;
  here.write(
      "scene.yaml",
      "scene: 1\ngroups: {gas: {count: 2731, ball: {mass: 1, radius: 0.01}, in: {min: [0, 0, 0], max: [9, 9, 9]}}}\n"
      "gravity: [0, 0, 0]\nsimulate: {duration: 1}\noutput: {trajectory: {every: 0.5, layout: wide}, tables: xlsx}\n");
  const string text =
      "trajectory.csv will have 16,387 columns, and a spreadsheet shows 16,384, so that tables.xlsx will "
      "have only the first ones; smaller by `layout: long`, fewer bodies by `trajectory.on` or `tables: "
      "csv.gz`, for pandas and the like";

  const auto in_one_line = [](const string& lines) {
    std::istringstream words(lines);
    string line, word;
    while (words >> word) line += (line.empty() ? "" : " ") + word;
    return line;
  };

  EXPECT_NE(in_one_line(here.carom({"check", "scene.yaml"}).out).find("large " + text), string::npos);
  string written = text;
  written.replace(written.find("will have"), 9, "has");
  written.replace(written.find("will have"), 9, "has");
  EXPECT_NE(in_one_line(here.carom({"run", "scene.yaml"}).out).find("large " + written), string::npos);

  // The sheet has what fits, and says so.
  const Finished sheet = here.shell(
      "/usr/bin/python3 -c \"import openpyxl; s = openpyxl.load_workbook('output/scene/tables.xlsx')['Trajectory']; "
      "print(s['A1'].value, s.max_row, s.max_column, s['A2'].value, s['A3'].value, s.freeze_panes)\"");
  EXPECT_EQ(sheet.out,
            "The first 3 of 3 rows and 16,384 of 16,387 columns; trajectory.csv has all. 5 16384 time_s 0 B3\n")
      << sheet.err;

  // Of rows only the count is at hand.
  const Finished rows = here.carom({"check", "scene.yaml", "--json", "--set", "output.trajectory.every=0.002", "--set",
                                    "output.trajectory.layout=long"});
  const Json tables = Json::parse(rows.out).at("scenes").at(0).at("tables");
  EXPECT_EQ(tables.at("trajectory"), (Json{{"rows", 501 * 2731}, {"columns", 8}}));

  const Finished check = here.carom({"check", "scene.yaml", "--set", "output.tables=csv.gz", "--set",
                                     "output.trajectory.every=0.002", "--set", "output.trajectory.layout=long"});
  EXPECT_NE(
      in_one_line(check.out).find("trajectory.csv.gz will have 1,368,231 rows, and a spreadsheet shows 1,048,576; "
                                  "smaller by a longer `trajectory.every` or fewer bodies by `trajectory.on`"),
      string::npos)
      << check.out;
}

TEST(StandardInput, IsASceneOfItsOwn) {
  const Workplace here;
  here.write("scene.json", R"({"scene": 1, "balls": {"a": {"mass": 1, "radius": 0.1, "position": [0, 1, 0]}},
                               "planes": {"floor": {"point": [0, 0, 0], "normal": [0, 1, 0]}},
                               "simulate": {"duration": 1}})");
  const Finished piped = here.shell("cat scene.json | \"$CAROM\" run -");
  EXPECT_EQ(piped.code, 0) << piped.err;
  ASSERT_EQ(here.carom({"run", "scene.json"}).code, 0);
  EXPECT_EQ(without_manifest(here.files("output/stdin")), without_manifest(here.files("output/scene")));
  EXPECT_NE(here.shell("\"$CAROM\" run - < scene.json").out.find("up to date"), string::npos);
  EXPECT_EQ(here.shell("\"$CAROM\" check - < scene.json").code, 0);

  // Another scene does not replace it.
  const Finished other = here.shell("sed 's/\"mass\": 1/\"mass\": 2/' scene.json | \"$CAROM\" run -");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("-: the folder output/stdin holds another run"), string::npos) << other.err;
  EXPECT_EQ(here.shell("sed 's/\"mass\": 1/\"mass\": 2/' scene.json | \"$CAROM\" run - -q -o other").code, 0);
}

TEST(StandardInput, ErrorsNameTheirPlace) {
  const Workplace here;
  const Finished wrong = here.shell("printf 'scene: 1\\nsimulate: {duration: 1}\\nbals: 3\\n' | \"$CAROM\" run -");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(wrong.err.starts_with("-:3:1: error: unknown key `bals` in the scene\n")) << wrong.err;
  const Finished empty = here.carom({"run", "-"});
  EXPECT_EQ(empty.code, 2);
  EXPECT_TRUE(empty.err.starts_with("-: error: the file is empty") || empty.err.starts_with("-")) << empty.err;
  EXPECT_NE(here.carom({"run", "-", "--watch"}).err.find("--watch needs a file"), string::npos);
  EXPECT_FALSE(here.has("output"));
}

}  // namespace
}  // namespace carom::testing
