// Runs side by side: the table against the runs' own files, the workbook by an independent reader.
#include "compare/comparison.h"

#include <gtest/gtest.h>

#include "compare/comparison_testing.h"
#include "compare/outcomes.h"
#include "compare/scenarios.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "workbook/number_look.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

/// Six runs: three coefficients of restitution by two masses of the red ball.
class ComparisonOfSix : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    place = new Place;
    runs = six_runs(*place, "");
    plan.title = "Six runs";
    plan.parameters = {{"restitution.default", ""}, {"balls.red.mass", "kg"}};
    plan.measures = {"energy_lost_J", "collisions", "balls.red.speed_m_per_s", "balls.blue.kinetic_J"};
    plan.collisions = true;
    place->compare(plan, runs, "out");
  }
  static void TearDownTestSuite() {
    delete place;
    delete kept;
    runs.clear();
  }
  /// The workbook, read on first use.
  static const Json& book() {
    if (kept == nullptr) kept = new Json(place->workbook("out"));
    return *kept;
  }
  static const Json& sheet(const char* name) { return book()["sheets"][name]; }

  static inline Place* place;
  static inline Json* kept = nullptr;
  static inline ComparisonPlan plan;
  static inline vector<ComparedRun> runs;
};

TEST_F(ComparisonOfSix, SummaryIsEachRunsRowThenWhatVariedThenMeasures) {
  const auto rows = rows_of(place->read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 7u);
  const auto of_run = rows_of(place->read("r3/summary.csv"));
  const size_t columns = of_run[0].size();
  ASSERT_EQ(rows[0].size(), columns + 4);
  for (size_t k = 0; k < columns; ++k) EXPECT_EQ(rows[0][k], of_run[0][k]);

  EXPECT_EQ(rows[0][columns], "restitution.default");
  EXPECT_EQ(rows[0][columns + 1], "balls.red.mass");
  EXPECT_EQ(rows[0][columns + 2], "balls.red.speed_m_per_s");
  EXPECT_EQ(rows[0][columns + 3], "balls.blue.kinetic_J");

  EXPECT_EQ(rows[3][0], "r3");
  for (size_t k = 1; k < columns; ++k) EXPECT_EQ(rows[3][k], of_run[1][k]) << rows[0][k];
  EXPECT_EQ(rows[3][columns], "0.75");
  EXPECT_EQ(rows[3][columns + 1], "10");
  // Equal masses at 2 and -2 m/s leave at e times their speeds.
  EXPECT_EQ(rows[3][columns + 2], "1.5");
  EXPECT_EQ(rows[3][columns + 3], "11.25");
}

TEST_F(ComparisonOfSix, SameRunsGiveTheSameBytes) {
  place->compare(plan, runs, "again");
  EXPECT_EQ(place->read("again/comparison.xlsx"), place->read("out/comparison.xlsx"));
  EXPECT_EQ(place->read("again/summary.csv"), place->read("out/summary.csv"));
}

TEST_F(ComparisonOfSix, WorkbookHasItsSheetsAndOpensWithTheCharts) {
  EXPECT_EQ(book()["order"],
            Json({"Compare", "Pivot", "Summary", "Series", "Collisions", "Points", "Parameters", "About"}));
  EXPECT_EQ(book()["active"], "Compare");
  EXPECT_EQ(book()["created"], "2000-01-01 00:00:00");
}

TEST_F(ComparisonOfSix, ChartsHaveTitlesAxesAndALineForEachValue) {
  const Json& charts = sheet("Compare")["charts"];
  ASSERT_EQ(charts.size(), 4u);  // of three measures that differ, and energy over time
  EXPECT_EQ(charts[0]["kind"], "ScatterChart");
  EXPECT_EQ(charts[0]["title"], "energy lost (J) by restitution.default");
  EXPECT_EQ(charts[0]["x"], "restitution.default");
  EXPECT_EQ(charts[0]["y"], "energy lost (J)");
  ASSERT_EQ(charts[0]["series"].size(), 2u);
  EXPECT_EQ(charts[1]["y"], "balls.red speed (m/s)");
  EXPECT_EQ(charts[3]["title"], "kinetic energy (J) over time");
  ASSERT_EQ(charts[3]["series"].size(), 6u);
  EXPECT_EQ(charts[3]["series"][5]["name"], "restitution.default = 1, mass = 20 kg");
  // None covers another.
  for (size_t a = 0; a < charts.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      EXPECT_TRUE(charts[a]["row"] > charts[b]["last_row"] || charts[b]["row"] > charts[a]["last_row"] ||
                  charts[a]["column"] > charts[b]["last_column"] || charts[b]["column"] > charts[a]["last_column"])
          << a << " and " << b;
  // The first line's points: x and y of the runs with a red ball of 10 kg.
  const auto cell = [&](const string& range, int row) {
    EXPECT_TRUE(range.find("Points") != string::npos) << range;
    const int first = std::stoi(range.substr(range.find_last_of('$', range.find(':')) + 1));
    const int column = range[range.find('$') + 1] - 'A';
    return sheet("Points")["rows"][static_cast<size_t>(first - 1 + row)][static_cast<size_t>(column)];
  };
  for (int row = 0; row < 3; ++row) {
    const double e = 0.5 + 0.25 * row;
    EXPECT_EQ(cell(charts[0]["series"][0]["x"], row), e);
    EXPECT_NEAR(cell(charts[0]["series"][0]["y"], row).get<double>(), 40 * (1 - e * e), 1e-12);
    EXPECT_GT(charts[0]["row"].get<int>(), 0);
  }
}

TEST_F(ComparisonOfSix, FirstSheetHasTheHighestAndTheLowestRunAndTheCorrelations) {
  const Json& rows = sheet("Compare")["values"];
  EXPECT_EQ(rows[1][0], "6 runs; varied: restitution.default 0.5, 0.75, 1; balls.red.mass 10 kg, 20 kg");
  EXPECT_EQ(rows[2][0], "No run failed or is doubtful.");
  EXPECT_EQ(rows[3][0], "The same in all runs: collisions = 1.");

  // Heads, then the energy lost: 40 J (1 - e^2) for 10 kg, and 160/3 J (1 - e^2) for 20 kg.
  const auto filled = [](const Json& row) {
    Json cells = Json::array();
    for (const Json& cell : row)
      if (!cell.is_null()) cells.push_back(cell);
    return cells;
  };
  EXPECT_EQ(filled(rows[5]), Json({"measure", "highest", "run", "restitution.default", "mass", "lowest", "run",
                                   "restitution.default", "mass", "ρ restitution.default", "ρ mass"}));

  const Json lost = filled(rows[6]);
  EXPECT_EQ(lost[0], "energy lost (J)");
  EXPECT_NEAR(lost[1].get<double>(), 40, 1e-12);
  EXPECT_EQ(lost[2], "r2");
  EXPECT_EQ(lost[4], 20);
  EXPECT_NEAR(lost[5].get<double>(), 0, 1e-12);
  EXPECT_EQ(lost[6], "r5 +1");

  // Ranks of e are 1.5, 1.5, 3.5, 3.5, 5.5, 5.5, and those of the losses 5, 6, 3, 4, 1.5, 1.5.
  EXPECT_NEAR(lost[9].get<double>(), -16 / sqrt(16 * 17.0), 1e-12);
}

TEST_F(ComparisonOfSix, FirstSheetHasAHeatMapWithFormulas) {
  const Json& compare = sheet("Compare");
  size_t head = 0;
  while (compare["rows"][head][0] != "restitution.default \\ mass") ++head;
  EXPECT_EQ(compare["rows"][head - 1][0], "energy lost (J): down restitution.default, across balls.red.mass");
  EXPECT_EQ(compare["rows"][head][2], 10);
  EXPECT_EQ(compare["rows"][head + 1][0], 0.5);
  EXPECT_TRUE(compare["rows"][head + 1][2].get<string>().starts_with("=AVERAGEIFS("));
  EXPECT_NEAR(compare["values"][head + 1][2].get<double>(), 30, 1e-12);
}

TEST_F(ComparisonOfSix, SummarySheetHasParametersMeasuresThenWhatElseDiffers) {
  const Json& summary = sheet("Summary");
  const auto csv = rows_of(place->read("out/summary.csv"));

  // The columns of the table, by their heads.
  const vector<pair<string, string>> first = {{"run", "run"},
                                              {"restitution.default", "restitution.default"},
                                              {"balls.red.mass (kg)", "balls.red.mass"},
                                              {"energy lost (J)", "energy_lost_J"},
                                              {"collisions", "collisions"},
                                              {"balls.red speed (m/s)", "balls.red.speed_m_per_s"},
                                              {"balls.blue kinetic energy (J)", "balls.blue.kinetic_J"}};

  const Json& heads = summary["rows"][1];
  ASSERT_GT(heads.size(), first.size());
  for (size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(heads[k], first[k].first);
    const auto column = static_cast<size_t>(ranges::find(csv[0], first[k].second) - csv[0].begin());
    for (size_t i = 1; i < csv.size(); ++i) {
      const Json& value = summary["rows"][i + 1][k];
      if (k == 0)
        EXPECT_EQ(value, csv[i][column]);
      else  // 16 digits, however few are shown
        EXPECT_NEAR(value.get<double>(), std::stod(csv[i][column]), 1e-15 * std::abs(std::stod(csv[i][column])));
    }
  }

  // A column that is the same in all runs stands in the line above, and no other does.
  const string folded = summary["rows"][0][0];
  EXPECT_TRUE(
      folded.starts_with("The same in all runs: title: Two balls; engine: exact; status: done; duration (s): 1;"))
      << folded;
  for (size_t k = 1; k < csv[0].size(); ++k) {
    bool same = true;
    for (size_t i = 2; i < csv.size(); ++i) same = same && csv[i][k] == csv[1][k];

    const bool is_first = any_of(first, [&](auto& one) { return one.second == csv[0][k]; });
    const string label = k < 2 ? csv[0][k] : label_of(csv[0][k]);
    EXPECT_EQ(folded.find("; " + label + ": ") != string::npos || k == 1, same && !is_first && !csv[1][k].empty())
        << label;
    const bool is_column = contains(heads, Json(label));
    EXPECT_TRUE(is_first || is_column != same) << label;
  }

  EXPECT_EQ(summary["tables"].begin().key(), "Runs");
  EXPECT_TRUE(summary["tables"]["Runs"].get<string>().starts_with("A2:"));
  EXPECT_TRUE(summary["tables"]["Runs"].get<string>().ends_with("8"));
  EXPECT_EQ(summary["frozen"], "B3");

  // Varied columns are tinted, measured ones are not.
  EXPECT_EQ(summary["fills"][1], "FFFFF2CC");
  EXPECT_EQ(summary["fills"][2], "FFFFF2CC");
  EXPECT_TRUE(summary["fills"][3].is_null());
}

TEST_F(ComparisonOfSix, NumbersAreShownWithAboutFiveDigits) {
  // 0.5, 0.75 and 1; 10 and 20 kg; 0 to 40 J; one collision; 0.5 to 2 m/s.
  const Json& formats = sheet("Summary")["formats"];
  EXPECT_EQ(formats[1], "0.00");
  EXPECT_EQ(formats[2], "0");
  EXPECT_EQ(formats[3], "0.000");
  EXPECT_EQ(formats[4], "0");
  EXPECT_EQ(formats[5], "0.0000");
}

TEST_F(ComparisonOfSix, PrintedPagesAreWideAndRepeatTheirHeads) {
  EXPECT_EQ(sheet("Summary")["print"]["rows"], "$2:$2");
  EXPECT_EQ(sheet("Summary")["print"]["columns"], "$A:$A");
  EXPECT_EQ(sheet("Summary")["print"]["orientation"], "portrait");
  // The run, two parameters and four measures. Of numbers that only charts read there is one page.
  EXPECT_EQ(sheet("Summary")["print"]["area"], Json({"$A$1:$G$8"}));
  for (const char* name : {"Series", "Collisions", "Points"}) {
    const Json& page = sheet(name)["print"];
    EXPECT_EQ(page["orientation"], "landscape") << name;
    EXPECT_EQ(page["across"], nullptr) << name;  // 1 is the default
    EXPECT_TRUE(page["area"][0].get<string>().ends_with("$45")) << name;
  }
  for (const auto& [name, one] : book()["sheets"].items()) {
    EXPECT_EQ(one["print"]["foot"], "&A") << name;
    EXPECT_EQ(one["print"]["pages"], "Page &P of &N") << name;
  }
}

TEST_F(ComparisonOfSix, PivotIsTheFirstMeasureByTwoParameters) {
  const Json& pivot = sheet("Pivot");
  EXPECT_EQ(pivot["values"][3][0], "energy lost (J)");
  EXPECT_EQ(pivot["values"][4][1], 10);
  EXPECT_EQ(pivot["values"][4][2], 20);
  for (int row = 0; row < 3; ++row) {
    const double e = 0.5 + 0.25 * row;
    const Json& cells = pivot["values"][static_cast<size_t>(5 + row)];
    EXPECT_EQ(cells[0], e);
    // Half the reduced mass times the square of the closing speed, (1 - e^2) of it.
    EXPECT_NEAR(cells[1].get<double>(), 0.5 * 5 * 16 * (1 - e * e), 1e-12);
    EXPECT_NEAR(cells[2].get<double>(), 0.5 * 20.0 / 3 * 16 * (1 - e * e), 1e-12);
    EXPECT_TRUE(pivot["rows"][static_cast<size_t>(5 + row)][1].get<string>().starts_with("=AVERAGEIFS("));
  }
}

TEST_F(ComparisonOfSix, PivotTakesEqualNumbersForOne) {
  vector<ComparedRun> some = runs;
  for (ComparedRun& run : some)
    if (run.values[1] == "10") run.values[1] = run.id == "r1" ? "10.0" : "1e1";
  place->compare(plan, some, "equal");
  EXPECT_EQ(place->workbook("equal")["sheets"]["Pivot"]["values"], sheet("Pivot")["values"]);
}

TEST_F(ComparisonOfSix, PivotHasNoFormulasThatTakeTwoTextsForOne) {
  vector<ComparedRun> some = runs;
  for (const auto& [first, second] : {pair("a", "A"), pair("true", "b"), pair("a*", "b")}) {
    for (size_t k = 0; k < some.size(); ++k) some[k].values[1] = runs[k].values[1] == "10" ? first : second;
    place->compare(plan, some, "texts");
    const Json pivot = place->workbook("texts")["sheets"]["Pivot"];
    EXPECT_TRUE(pivot["rows"][5][1].is_number()) << first;
    EXPECT_EQ(pivot["values"][5][2], sheet("Pivot")["values"][5][2]);
  }
}

TEST_F(ComparisonOfSix, PivotSaysHowManyMeasuresItHas) {
  ComparisonPlan many = plan;
  many.measures = {"energy_lost_J", "collisions",    "max_overlap_m", "resting",
                   "balls.red.x_m", "balls.red.y_m", "frames"};
  place->compare(many, runs, "many");
  const string note = place->workbook("many")["sheets"]["Pivot"]["values"][1][0];
  EXPECT_TRUE(note.ends_with("; only the first 6 measures")) << note;
  EXPECT_EQ(sheet("Pivot")["values"][1][0].get<string>().find("measures"), string::npos);
}

TEST_F(ComparisonOfSix, ThereIsNoPivotUnlessTwoVaryByThemselves) {
  ComparisonPlan twice = plan;
  twice.measures = {"collisions"};
  vector<ComparedRun> some;
  for (const char* value : {"1", "2", "3"}) some.push_back({value, runs[0].folder, {value, string(value) + ".5"}});
  place->compare(twice, some, "together");
  EXPECT_EQ(place->workbook("together", true)["order"],
            Json({"Compare", "Summary", "Series", "Collisions", "Points", "Parameters", "About"}));
  twice.collisions = false;
  place->compare(twice, some, "together");
  EXPECT_EQ(place->workbook("together", true)["order"],
            Json({"Compare", "Summary", "Series", "Points", "Parameters", "About"}));
}

TEST_F(ComparisonOfSix, SeriesCollisionsAndParametersAreTheRuns) {
  const Json& series = sheet("Series")["rows"];
  EXPECT_EQ(series.size(), 12u);  // eleven instants
  EXPECT_EQ(series[0][0], "time (s)");
  EXPECT_EQ(series[0][1], "kinetic energy (J): restitution.default = 0.5, mass = 10 kg");
  EXPECT_EQ(series[1][1], 40);
  EXPECT_EQ(series[11][0], 1);

  const Json& collisions = sheet("Collisions")["rows"];
  EXPECT_EQ(collisions.size(), 7u);
  EXPECT_EQ(collisions[1][0], "r1");
  EXPECT_EQ(collisions[1][2], "body-body");
  EXPECT_EQ(sheet("Collisions")["filter"], "A1:P7");

  const Json& parameters = sheet("Parameters")["rows"];
  EXPECT_EQ(parameters[2], Json({"restitution.default", nullptr, 3, 0.5, 1}));
  EXPECT_EQ(parameters[3], Json({"balls.red.mass", "kg", 2, 10, 20}));
  bool found = false;
  for (const Json& row : parameters) {
    EXPECT_NE(row[0], "balls.red.restitution") << "it follows what was varied";
    found = found || (row[0] == "balls.blue.mass" && row[1] == "kg" && row[2] == 10);
  }
  EXPECT_TRUE(found);
}

TEST_F(ComparisonOfSix, WhatDiffersBehindACommaIsNotCommon) {
  place->run(two_balls, "one", {"title=\"Two balls, once\"", "balls.red.color=[0.1, 0.2, 0.3]"});
  place->run(two_balls, "other", {"title=\"Two balls, twice\"", "balls.red.color=[0.1, 0.2, 0.4]"});
  place->compare({"", {}, {}, {}, {}}, {{"a", *place / "one", {}}, {"b", *place / "other", {}}}, "comma");
  string common;
  const Json rows = place->workbook("comma")["sheets"]["Parameters"]["rows"];
  for (const Json& row : rows)
    if (row[0].is_string()) common += row[0].get<string>() + "\n";
  EXPECT_EQ(common.find("title\n"), string::npos) << common;
  EXPECT_EQ(common.find("balls.red.color\n"), string::npos) << common;
  EXPECT_NE(common.find("balls.red.mass\n"), string::npos) << common;
}

TEST_F(ComparisonOfSix, AboutDescribesEveryColumn) {
  string all;
  for (const Json& row : sheet("About")["rows"])
    if (row[1].is_string() && row[3].is_string()) all += row[1].get<string>() + "\n";
  const auto summary = rows_of(place->read("out/summary.csv")), collisions = rows_of(place->read("r1/collisions.csv"));
  for (const string& column : summary[0]) EXPECT_NE(("\n" + all).find("\n" + column + "\n"), string::npos) << column;
  for (const string& column : collisions[0]) EXPECT_NE(all.find(column + "\n"), string::npos) << column;
}

TEST_F(ComparisonOfSix, AFailedRunHasItsParametersAndNothingElse) {
  place->write("broken/error.txt", "no luck\n");
  vector<ComparedRun> some = {runs[0], {"r9", *place / "broken", {"-0.5", "=1+1"}}};
  place->compare(plan, some, "some");
  const string text = place->read("some/summary.csv");
  const auto rows = rows_of(text);
  EXPECT_TRUE(text.ends_with("\nr9,,,failed,,,,,,,,,,,,,,,,,,,,,,,,-0.5,'=1+1,,\n")) << text;
  const Json rows_of_sheet = place->workbook("some")["sheets"]["Summary"]["rows"];
  const Json &heads = rows_of_sheet[rows_of_sheet.size() - 3], &row = rows_of_sheet[rows_of_sheet.size() - 1];
  EXPECT_EQ(row[1], -0.5);
  EXPECT_EQ(row[2], "=1+1");
  EXPECT_EQ(row[static_cast<size_t>(ranges::find(heads, "status") - heads.begin())], "failed");
}

TEST_F(ComparisonOfSix, TextIsNoFormula) {
  place->run(two_balls, "formula", {"title==1+1"});
  place->compare({"=2+2", {{"title", ""}}, {}, {}, {}}, {{"=id", *place / "formula", {"=1+1"}}}, "text");
  const Json sheets = place->workbook("text")["sheets"];
  for (const auto& [name, sheet] : sheets.items())
    for (const Json& types : sheet["types"])
      for (const Json& type : types) EXPECT_NE(type, "f") << name;
  EXPECT_EQ(sheets["Summary"]["rows"][1][1], "=1+1");
  EXPECT_NE(place->read("text/summary.csv").find("\n'=id,'=1+1,"), string::npos);
}

TEST_F(ComparisonOfSix, WhatCannotBeReadIsReportedWithItsRemedy) {
  const auto error = [&](const ComparedRun& run) {
    try {
      place->compare(plan, {run}, "none");
    } catch (const std::exception& e) {
      return string(e.what());
    }
    return string();
  };

  EXPECT_TRUE(error({"x", *place / "nowhere", {"1", "1"}}).ends_with("cannot be opened: there is no such folder"));
  std::filesystem::create_directories(*place / "empty");
  EXPECT_TRUE(error({"x", *place / "empty", {"1", "1"}})
                  .ends_with("holds no whole run: run its scene again, or leave it "
                             "out"));

  place->run(two_balls, "silent", {"output={collisions: true}"});
  EXPECT_NE(
      error({"x", *place / "silent", {"1", "1"}}).find("silent has no trajectory.csv, needed for balls.red.speed_"),
      string::npos);
}

TEST_F(ComparisonOfSix, AWideTrajectoryGivesTheSame) {
  place->run(two_balls, "wide", {"output.trajectory.layout=wide"});
  place->compare(plan, {{"a", runs[0].folder, {"1", "1"}}, {"b", *place / "wide", {"1", "1"}}}, "wide_out");
  const auto rows = rows_of(place->read("wide_out/summary.csv"));
  EXPECT_EQ(vector(rows[1].begin() + 2, rows[1].end()), vector(rows[2].begin() + 2, rows[2].end()));
  const Json series = place->workbook("wide_out")["sheets"]["Series"]["rows"];
  EXPECT_EQ(series[0][3], "balls.red speed (m/s): a");
  EXPECT_EQ(series[0][6], "balls.red speed (m/s): b");
  for (size_t row = 1; row < series.size(); ++row) EXPECT_EQ(series[row][3], series[row][6]);
}

TEST_F(ComparisonOfSix, ManyRunsAreStreamed) {
  SLOW_WITH_SANITIZERS();
  vector<ComparedRun> many;
  for (int i = 0; i < 2100; ++i)
    many.push_back({"r" + to_string(i),
                    runs[static_cast<size_t>(i % 6)].folder,
                    {to_string(i / 6) + ".5", runs[static_cast<size_t>(i % 6)].values[1]}});

  place->compare(plan, many, "many");
  const Json sheets = place->workbook("many", true)["sheets"];
  EXPECT_TRUE(sheets["Summary"]["tables"].empty());
  EXPECT_TRUE(sheets["Summary"]["filter"].get<string>().starts_with("A2:"));
  EXPECT_EQ(sheets["Summary"]["height"], 2102);
  EXPECT_EQ(sheets["Collisions"]["height"], 2101);
  EXPECT_EQ(sheets["Compare"]["charts"], 4);
  EXPECT_EQ(rows_of(place->read("many/summary.csv"))[2100][27], "349.5");
}

TEST_F(ComparisonOfSix, ChartsOfThePlanAreDrawn) {
  ComparisonPlan own = plan;
  own.charts = {{"balls.red.mass", "max_speed_m_per_s", ""}, {"energy_lost_J", "balls.red.x_m", "restitution.default"}};
  place->compare(own, runs, "own");
  const Json charts = place->workbook("own")["sheets"]["Compare"]["charts"];

  ASSERT_EQ(charts.size(), 3u);
  EXPECT_EQ(charts[0]["x"], "balls.red.mass (kg)");
  EXPECT_EQ(charts[0]["series"].size(), 1u);
  EXPECT_EQ(charts[1]["title"], "balls.red x (m) by energy lost (J)");
  EXPECT_EQ(charts[1]["series"].size(), 3u);
  EXPECT_EQ(charts[1]["series"][1]["name"], "restitution.default = 0.75");
  EXPECT_EQ(sheet("Compare")["charts"][0]["series"][1]["name"], "balls.red.mass = 20 kg");

  // The name of an expression is no formula of a title.
  ComparisonPlan expressed = plan;
  expressed.measures = {"= energy_lost_J / collisions"};
  place->compare(expressed, runs, "expressed");
  const Json of_expression = place->workbook("expressed")["sheets"]["Compare"]["charts"];
  EXPECT_EQ(of_expression[0]["title"], "energy_lost_J / collisions by restitution.default");
  EXPECT_EQ(of_expression[0]["y"], "energy_lost_J / collisions");

  // Charts of what is not there are refused.
  own.charts = {{"balls.red.mas", "max_speed_m_per_s", ""}};
  EXPECT_THROW(check_charts(own), MeasureError);
  own.charts = {{"balls.red.mass", "max_speed", ""}};
  EXPECT_THROW(check_charts(own), MeasureError);
  own.charts = {{"balls.red.mass", "collisions", "balls.blue.mass"}};
  EXPECT_THROW(check_charts(own), MeasureError);
}

TEST(ComparisonOfScenes, WithLittleInCommonHasBarsByRunAndAListOfWhatDiffers) {
  const Place place;
  place.run(two_balls, "balls");
  place.run(
      "scene: 1\ntitle: A ball on a floor\nbodies: {cube: {mass: 1, box: [1, 1, 1], position: [0, 2, 0]}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 2}\n"
      "output: {energy: {every: 0.1}, collisions: true}\n",
      "cube");

  ComparisonPlan plan;
  plan.parameters = {{"balls.red.mass", "kg"},
                     {"balls.red.radius", "m"},
                     {"simulate.duration", "s"},
                     {"bodies.cube.mass", "kg"},
                     {"camera.eye.x", "m"}};
  place.compare(
      plan, {{"balls", place / "balls", {"10", "0.11", "1", "", ""}}, {"cube", place / "cube", {"", "", "2", "1", ""}}},
      "out");

  const Json book = place.workbook("out");
  EXPECT_EQ(book["order"], Json({"Compare", "Summary", "Series", "Points", "Parameters", "About"}));
  const Json& compare = book["sheets"]["Compare"];
  EXPECT_EQ(compare["charts"].size(), 4u);

  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(compare["charts"][k]["kind"], "BarChart");
    EXPECT_EQ(compare["charts"][k]["x"], "run");
  }
  EXPECT_EQ(compare["charts"][3]["series"][1]["name"], "cube");

  size_t row = 0;
  while (compare["rows"][row][0] != "What differs") ++row;
  const auto differs = [&](size_t down, size_t column) { return compare["rows"][row + down][column]; };
  EXPECT_EQ(differs(0, 21), "cube");
  EXPECT_EQ(differs(1, 0), "simulate.duration (s)");
  EXPECT_EQ(differs(1, 12), 1);
  EXPECT_EQ(differs(1, 21), 2);
  EXPECT_EQ(differs(2, 0), "balls.red.mass (kg)");
  EXPECT_EQ(differs(2, 21), "-");

  for (const Json& head : book["sheets"]["Summary"]["rows"][1]) EXPECT_NE(head, "balls.red.mass (kg)");
  EXPECT_NE(place.read("out/summary.csv").find(",balls.red.mass,"), string::npos);
}

TEST(Collisions, OfEachRunHaveTheSameShareOfTheSheet) {
  const Place place;
  const string gas =
      "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [-1, -1, -1], max: [1, 1, 1]}\n"
      "groups: {gas: {count: 40, ball: {mass: 1, radius: 0.1}, in: {min: [-1, -1, -1], max: [1, 1, 1]}, speed: 1}}\n"
      "simulate: {duration: 5}\noutput: {collisions: true}\n";
  place.run(gas, "gas");

  ComparisonPlan plan;
  plan.collisions = true;
  vector<ComparedRun> runs;
  for (int i = 0; i < 100; ++i) runs.push_back({"r" + to_string(i), place / "gas", {}});
  ASSERT_GT(rows_of(place.read("gas/collisions.csv")).size(), 201u);
  place.compare(plan, runs, "out");

  const Json rows = place.workbook("out")["sheets"]["Collisions"]["rows"];
  ASSERT_EQ(rows.size(), 20'001u);
  EXPECT_EQ(rows[200][0], "r0");
  EXPECT_EQ(rows[201][0], "r1");
  EXPECT_EQ(rows[20'000][0], "r99");
}

TEST(NumberLook, HasFiveDigitsOfTheGreatestAndTwoOfTheLeast) {
  const auto format = [](std::initializer_list<double> numbers) {
    NumberLook look;
    for (const double number : numbers) look.add(number);
    return look.format();
  };

  EXPECT_EQ(format({}), "General");
  EXPECT_EQ(format({std::nan("")}), "General");
  EXPECT_EQ(format({0}), "0");
  EXPECT_EQ(format({0.5, 0.75, 1}), "0.00");
  EXPECT_EQ(format({1, 2, 300}), "0");
  EXPECT_EQ(format({1, 123456}), "#,##0");

  EXPECT_EQ(format({13.450413223140497, 3.8}), "0.000");
  EXPECT_EQ(format({13.450413223140497, 7e-15, 0}), "0.000") << "rounding noise";
  EXPECT_EQ(format({0.9103908980619376, -2.5}), "0.0000");
  EXPECT_EQ(format({150.00000001, 0.0012345678}), "0.0000");

  EXPECT_EQ(format({1e7 + 0.1}), "#,##0");
  EXPECT_EQ(format({1e9 + 0.5}), "0.0000E+00");
  EXPECT_EQ(format({8.881784197001252e-16, 0}), "0.0000E+00");
  EXPECT_EQ(format({1.5e6, 1e-3}), "0.0000E+00");
  EXPECT_EQ(format({12345.678}), "#,##0");
  EXPECT_EQ(format({12345.678, 1.5}), "#,##0.0");
}

TEST(ChosenScenarios, AreSpreadOverTheGridAndNamedByIt) {
  ComparisonPlan plan;
  plan.parameters = {{"defaults.ball.restitution", ""}, {"balls.red.position.z", "m"}, {"seed", ""}};
  plan.seed = 2;
  Outcomes outcomes(plan, 0, 25 * 40 * 2);

  vector<size_t> points;
  for (int e = 0; e < 25; ++e)
    for (int z = 0; z < 40; ++z)
      for (int seed = 0; seed < 2; ++seed)
        points.push_back(
            outcomes.add(points.size(), {"r", "", {to_string(e), to_string(z) + ".5", to_string(seed)}}, false, {}));
  outcomes.finish();

  const ChosenScenarios chosen = chosen_scenarios(plan, outcomes, points, false);
  EXPECT_EQ(chosen.all, 1000u);
  ASSERT_EQ(chosen.names.size(), ChosenScenarios::most);
  // The four corners are among them.
  for (const char* corner : {"restitution = 0, position.z = 0.5 m", "restitution = 0, position.z = 39.5 m",
                             "restitution = 24, position.z = 0.5 m", "restitution = 24, position.z = 39.5 m"})
    EXPECT_NE(ranges::find(chosen.names, corner), chosen.names.end()) << corner;

  // Both repeats of a scenario belong to it.
  EXPECT_EQ(chosen.of_run[0], 0u);
  EXPECT_EQ(chosen.of_run[1], 0u);
  EXPECT_EQ(ranges::count(chosen.of_run, ChosenScenarios::none), 2000 - 16);
}

TEST(ShortNames, AreAsLongAsNeededToTellPathsApart) {
  using Names = vector<string>;
  EXPECT_EQ(short_names({"defaults.ball.restitution", "balls.red.position.z", "let.a"}),
            (Names{"restitution", "position.z", "a"}));
  EXPECT_EQ(short_names({"balls.red.mass", "balls.blue.mass"}), (Names{"red.mass", "blue.mass"}));
  EXPECT_EQ(short_names({"seed"}), Names{"seed"});
}

TEST(Spread, IsThatOfTheNumbers) {
  Spread spread;
  for (const double value : {1.0, 2.0, 4.0, std::nan("")}) spread.add(value);
  EXPECT_EQ(spread.count(), 3u);
  EXPECT_DOUBLE_EQ(spread.mean(), 7.0 / 3);
  EXPECT_DOUBLE_EQ(spread.sd(), sqrt(7.0 / 3));  // (16 + 1 + 25) / 9 / 2
  EXPECT_EQ(spread.min(), 1);
  EXPECT_EQ(spread.max(), 4);
  Spread one;
  one.add(5);
  EXPECT_EQ(one.mean(), 5);
  EXPECT_TRUE(std::isnan(one.sd()));
}

TEST(Repeats, AreARowAScenarioWithMeansAndErrorBars) {
  const Place place;
  ComparisonPlan plan{"Gas", {{"restitution.default", ""}, {"seed", ""}}, {"max_speed_m_per_s"}, {}, 1};
  const string gas =
      "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [-1, -1, -1], max: [1, 1, 1]}\n"
      "groups: {gas: {count: 5, ball: {mass: 1, radius: 0.1}, in: {min: [-1, -1, -1], max: [1, 1, 1]}, speed: 1}}\n"
      "simulate: {duration: 0.5}\noutput: {collisions: true}\n";

  vector<ComparedRun> runs;
  vector<double> speeds;
  // The seed varies slowest: a scenario's runs are not adjacent.
  for (const char* seed : {"1", "2", "3"})
    for (const char* e : {"0.9", "1"}) {
      const string id = "r" + to_string(runs.size() + 1);
      const RunResult result = place.run(gas, id, {string("seed=") + seed, string("restitution.default=") + e});
      if (string(e) == "0.9") speeds.push_back(result.summary.max_speed);
      runs.push_back({id, place / id, {e, seed}});
    }

  place.compare(plan, runs, "out");
  const auto rows = rows_of(place.read("out/repeats.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], (vector<string>{"restitution.default", "n", "max_speed_m_per_s.mean", "max_speed_m_per_s.sd",
                                     "max_speed_m_per_s.min", "max_speed_m_per_s.max"}));

  const double mean = (speeds[0] + speeds[1] + speeds[2]) / 3;
  double squares = 0;
  for (const double speed : speeds) squares += (speed - mean) * (speed - mean);
  EXPECT_EQ(rows[1][0], "0.9");
  EXPECT_EQ(rows[1][1], "3");
  EXPECT_NEAR(std::stod(rows[1][2]), mean, 1e-14);
  EXPECT_NEAR(std::stod(rows[1][3]), sqrt(squares / 2), 1e-14);
  EXPECT_EQ(std::stod(rows[1][4]), *ranges::min_element(speeds));
  EXPECT_EQ(std::stod(rows[1][5]), *ranges::max_element(speeds));

  // In the workbook: a sheet, and error bars.
  const Json book = place.workbook("out");
  EXPECT_EQ(book["order"][2], "Repeats");
  EXPECT_EQ(book["sheets"]["Repeats"]["rows"].size(), 3u);
  const Json& series = book["sheets"]["Compare"]["charts"][0]["series"];
  ASSERT_EQ(series.size(), 3u);  // the means, and a bar for each
  EXPECT_TRUE(series[0]["bar"].is_null());
  EXPECT_NEAR(series[1]["bar"].get<double>(), sqrt(squares / 2), 1e-12);
}

}  // namespace
}  // namespace carom::testing
