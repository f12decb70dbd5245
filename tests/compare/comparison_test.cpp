// Runs side by side: the table against the runs' own files, the workbook by an independent reader.
#include "compare/comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/comparison_testing.h"
#include "compare/outcomes.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

/// Six runs: three coefficients of restitution by two masses of the red ball.
class ComparisonOfSix : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    place = new Place;
    int number = 0;
    for (const char* e : {"0.5", "0.75", "1"})
      for (const char* mass : {"10", "20"}) {
        const std::string id = "r" + std::to_string(++number);
        place->run(two_balls, id, {std::string("restitution.default=") + e, std::string("balls.red.mass=") + mass});
        runs.push_back({id, *place / id, {e, mass}});
      }
    plan.title = "Six runs";
    plan.parameters = {{"restitution.default", ""}, {"balls.red.mass", "kg"}};
    plan.measures = {"energy_lost_J", "collisions", "balls.red.speed_m_per_s", "balls.blue.kinetic_J"};
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
  static inline std::vector<ComparedRun> runs;
};

TEST_F(ComparisonOfSix, SummaryIsEachRunsRowThenWhatVariedThenMeasures) {
  const auto rows = rows_of(place->read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 7u);
  const auto of_run = rows_of(place->read("r3/summary.csv"));
  const std::size_t columns = of_run[0].size();
  ASSERT_EQ(rows[0].size(), columns + 4);
  for (std::size_t k = 0; k < columns; ++k) EXPECT_EQ(rows[0][k], of_run[0][k]);
  EXPECT_EQ(rows[0][columns], "restitution.default");
  EXPECT_EQ(rows[0][columns + 1], "balls.red.mass");
  EXPECT_EQ(rows[0][columns + 2], "balls.red.speed_m_per_s");
  EXPECT_EQ(rows[0][columns + 3], "balls.blue.kinetic_J");
  EXPECT_EQ(rows[3][0], "r3");
  for (std::size_t k = 1; k < columns; ++k) EXPECT_EQ(rows[3][k], of_run[1][k]) << rows[0][k];
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
  EXPECT_EQ(book()["order"], Json({"Compare", "Summary", "Pivot", "Series", "Collisions", "Parameters", "About"}));
  EXPECT_EQ(book()["active"], "Compare");
  EXPECT_EQ(book()["created"], "2000-01-01 00:00:00");
}

TEST_F(ComparisonOfSix, ChartsHaveTitlesAxesAndALineForEachValue) {
  const Json& charts = sheet("Compare")["charts"];
  ASSERT_EQ(charts.size(), 5u);  // four measures, and energy over time
  EXPECT_EQ(charts[0]["kind"], "ScatterChart");
  EXPECT_EQ(charts[0]["title"], "energy lost (J) by restitution.default");
  EXPECT_EQ(charts[0]["x"], "restitution.default");
  EXPECT_EQ(charts[0]["y"], "energy lost (J)");
  ASSERT_EQ(charts[0]["series"].size(), 2u);
  EXPECT_EQ(charts[2]["y"], "balls.red speed (m/s)");
  EXPECT_EQ(charts[4]["title"], "kinetic energy (J) over time");
  EXPECT_EQ(charts[4]["series"].size(), 6u);
  // None covers another, or the numbers below.
  for (std::size_t a = 0; a < charts.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_TRUE(charts[a]["row"] > charts[b]["last_row"] || charts[b]["row"] > charts[a]["last_row"] ||
                  charts[a]["column"] > charts[b]["last_column"] || charts[b]["column"] > charts[a]["last_column"])
          << a << " and " << b;
  // The first line's points: x and y of the runs with a red ball of 10 kg.
  const auto cell = [&](const std::string& range, int row) {
    const int first = std::stoi(range.substr(range.find_last_of('$', range.find(':')) + 1));
    const int column = range[range.find('$') + 1] - 'A';
    return sheet("Compare")["rows"][static_cast<std::size_t>(first - 1 + row)][static_cast<std::size_t>(column)];
  };
  for (int row = 0; row < 3; ++row) {
    const double e = 0.5 + 0.25 * row;
    EXPECT_EQ(cell(charts[0]["series"][0]["x"], row), e);
    EXPECT_NEAR(cell(charts[0]["series"][0]["y"], row).get<double>(), 40 * (1 - e * e), 1e-12);
    EXPECT_GT(charts[0]["row"].get<int>(), 0);
  }
}

TEST_F(ComparisonOfSix, SummarySheetIsATableOfNumbers) {
  const Json& summary = sheet("Summary");
  EXPECT_EQ(summary["tables"], Json({{"Runs", "A1:AB7"}}));
  EXPECT_EQ(summary["frozen"], "B2");
  const auto rows = rows_of(place->read("out/summary.csv"));
  for (std::size_t i = 1; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      const Json& value = summary["rows"][i][k];
      if (k < 4 || rows[0][k] == "ended_by")
        EXPECT_EQ(value, rows[i][k]);
      else if (rows[i][k].empty())
        EXPECT_TRUE(value.is_null());
      else  // 16 digits
        EXPECT_NEAR(value.get<double>(), std::stod(rows[i][k]), 1e-15 * std::abs(std::stod(rows[i][k]))) << rows[0][k];
    }
  // Varied columns are tinted, measured ones are not.
  EXPECT_EQ(summary["fills"][24], "FFFFF2CC");
  EXPECT_EQ(summary["fills"][25], "FFFFF2CC");
  EXPECT_TRUE(summary["fills"][26].is_null());
}

TEST_F(ComparisonOfSix, PivotIsTheFirstMeasureByTwoParameters) {
  const Json& pivot = sheet("Pivot");
  EXPECT_EQ(pivot["values"][3][0], "energy lost (J)");
  EXPECT_EQ(pivot["values"][4][1], 10);
  EXPECT_EQ(pivot["values"][4][2], 20);
  for (int row = 0; row < 3; ++row) {
    const double e = 0.5 + 0.25 * row;
    const Json& cells = pivot["values"][static_cast<std::size_t>(5 + row)];
    EXPECT_EQ(cells[0], e);
    // Half the reduced mass times the square of the closing speed, (1 - e^2) of it.
    EXPECT_NEAR(cells[1].get<double>(), 0.5 * 5 * 16 * (1 - e * e), 1e-12);
    EXPECT_NEAR(cells[2].get<double>(), 0.5 * 20.0 / 3 * 16 * (1 - e * e), 1e-12);
    EXPECT_TRUE(pivot["rows"][static_cast<std::size_t>(5 + row)][1].get<std::string>().starts_with("=AVERAGEIFS("));
  }
}

TEST_F(ComparisonOfSix, ThereIsNoPivotUnlessTwoVaryByThemselves) {
  ComparisonPlan twice = plan;
  twice.measures = {"collisions"};
  std::vector<ComparedRun> some;
  for (const char* value : {"1", "2", "3"}) some.push_back({value, runs[0].folder, {value, std::string(value) + ".5"}});
  place->compare(twice, some, "together");
  EXPECT_EQ(place->workbook("together", true)["order"],
            Json({"Compare", "Summary", "Series", "Collisions", "Parameters", "About"}));
}

TEST_F(ComparisonOfSix, SeriesCollisionsAndParametersAreTheRuns) {
  const Json& series = sheet("Series")["rows"];
  EXPECT_EQ(series.size(), 12u);  // eleven instants
  EXPECT_EQ(series[0][0], "time_s");
  EXPECT_EQ(series[0][1], "r1.kinetic_J");
  EXPECT_EQ(series[1][1], 40);
  EXPECT_EQ(series[11][0], 1);
  const Json& collisions = sheet("Collisions")["rows"];
  EXPECT_EQ(collisions.size(), 7u);
  EXPECT_EQ(collisions[1][0], "r1");
  EXPECT_EQ(collisions[1][2], "body-body");
  EXPECT_EQ(sheet("Collisions")["filter"], "A1:P7");
  const Json& parameters = sheet("Parameters")["rows"];
  EXPECT_EQ(parameters[1][2], "balls.red.mass (kg)");
  EXPECT_EQ(parameters[2], Json({"r1", 0.5, 10, nullptr, "restitution.default", nullptr, 3, 0.5, 1}));
  bool found = false;
  for (const Json& row : parameters) {
    EXPECT_NE(row[4], "balls.red.restitution") << "it follows what was varied";
    found = found || (row[4] == "balls.blue.mass" && row[5] == "kg" && row[6] == 10);
  }
  EXPECT_TRUE(found);
}

TEST_F(ComparisonOfSix, WhatDiffersBehindACommaIsNotCommon) {
  place->run(two_balls, "one", {"title=\"Two balls, once\"", "balls.red.color=[0.1, 0.2, 0.3]"});
  place->run(two_balls, "other", {"title=\"Two balls, twice\"", "balls.red.color=[0.1, 0.2, 0.4]"});
  place->compare({"", {}, {}, {}, {}}, {{"a", *place / "one", {}}, {"b", *place / "other", {}}}, "comma");
  std::string common;
  const Json rows = place->workbook("comma")["sheets"]["Parameters"]["rows"];
  for (const Json& row : rows)
    if (row[2].is_string()) common += row[2].get<std::string>() + "\n";
  EXPECT_EQ(common.find("title\n"), std::string::npos) << common;
  EXPECT_EQ(common.find("balls.red.color\n"), std::string::npos) << common;
  EXPECT_NE(common.find("balls.red.mass\n"), std::string::npos) << common;
}

TEST_F(ComparisonOfSix, AboutDescribesEveryColumn) {
  std::string all;
  for (const Json& row : sheet("About")["rows"])
    if (row[1].is_string() && row[3].is_string()) all += row[1].get<std::string>() + "\n";
  const auto summary = rows_of(place->read("out/summary.csv")), collisions = rows_of(place->read("r1/collisions.csv"));
  for (const std::string& column : summary[0])
    EXPECT_NE(("\n" + all).find("\n" + column + "\n"), std::string::npos) << column;
  for (const std::string& column : collisions[0]) EXPECT_NE(all.find(column + "\n"), std::string::npos) << column;
}

TEST_F(ComparisonOfSix, AFailedRunHasItsParametersAndNothingElse) {
  place->write("broken/error.txt", "no luck\n");
  std::vector<ComparedRun> some = {runs[0], {"r9", *place / "broken", {"-0.5", "=1+1"}}};
  place->compare(plan, some, "some");
  const std::string text = place->read("some/summary.csv");
  const auto rows = rows_of(text);
  EXPECT_TRUE(text.ends_with("\nr9,,,failed,,,,,,,,,,,,,,,,,,,,,-0.5,'=1+1,,\n")) << text;
  const Json row = place->workbook("some")["sheets"]["Summary"]["rows"][2];
  EXPECT_EQ(row[3], "failed");
  EXPECT_EQ(row[24], -0.5);
}

TEST_F(ComparisonOfSix, TextIsNoFormula) {
  place->run(two_balls, "formula", {"title==1+1"});
  place->compare({"=2+2", {{"title", ""}}, {}, {}, {}}, {{"=id", *place / "formula", {"=1+1"}}}, "text");
  const Json sheets = place->workbook("text")["sheets"];
  for (const auto& [name, sheet] : sheets.items())
    for (const Json& types : sheet["types"])
      for (const Json& type : types) EXPECT_NE(type, "f") << name;
  EXPECT_EQ(sheets["Summary"]["rows"][1][1], "=1+1");
  EXPECT_NE(place->read("text/summary.csv").find("\n'=id,'=1+1,"), std::string::npos);
}

TEST_F(ComparisonOfSix, WhatCannotBeReadIsReportedWithItsRemedy) {
  const auto error = [&](const ComparedRun& run) {
    try {
      place->compare(plan, {run}, "none");
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_TRUE(error({"x", *place / "nowhere", {"1", "1"}}).ends_with("cannot be opened: there is no such folder"));
  std::filesystem::create_directories(*place / "empty");
  EXPECT_TRUE(error({"x", *place / "empty", {"1", "1"}})
                  .ends_with("holds no whole run: run its scene again, or leave it "
                             "out"));
  place->run(two_balls, "silent", {"output={collisions: true}"});
  EXPECT_NE(
      error({"x", *place / "silent", {"1", "1"}}).find("silent has no trajectory.csv, needed for balls.red.speed_"),
      std::string::npos);
}

TEST_F(ComparisonOfSix, AWideTrajectoryGivesTheSame) {
  place->run(two_balls, "wide", {"output.trajectory.layout=wide"});
  place->compare(plan, {{"a", runs[0].folder, {"1", "1"}}, {"b", *place / "wide", {"1", "1"}}}, "wide_out");
  const auto rows = rows_of(place->read("wide_out/summary.csv"));
  EXPECT_EQ(std::vector(rows[1].begin() + 2, rows[1].end()), std::vector(rows[2].begin() + 2, rows[2].end()));
  const Json series = place->workbook("wide_out")["sheets"]["Series"]["rows"];
  EXPECT_EQ(series[0][3], "a.balls.red.speed_m_per_s");
  EXPECT_EQ(series[0][6], "b.balls.red.speed_m_per_s");
  for (std::size_t row = 1; row < series.size(); ++row) EXPECT_EQ(series[row][3], series[row][6]);
}

TEST_F(ComparisonOfSix, ManyRunsAreStreamed) {
  std::vector<ComparedRun> many;
  for (int i = 0; i < 2100; ++i)
    many.push_back({"r" + std::to_string(i),
                    runs[static_cast<std::size_t>(i % 6)].folder,
                    {std::to_string(i / 6) + ".5", runs[static_cast<std::size_t>(i % 6)].values[1]}});
  place->compare(plan, many, "many");
  const Json sheets = place->workbook("many", true)["sheets"];
  EXPECT_TRUE(sheets["Summary"]["tables"].empty());
  EXPECT_EQ(sheets["Summary"]["filter"], "A1:AB2101");
  EXPECT_EQ(sheets["Summary"]["height"], 2101);
  EXPECT_EQ(sheets["Collisions"]["height"], 2101);
  EXPECT_EQ(sheets["Compare"]["charts"], 5);
  EXPECT_EQ(rows_of(place->read("many/summary.csv"))[2100][24], "349.5");
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
  own.charts = {{"balls.red.mas", "max_speed_m_per_s", ""}};
  EXPECT_THROW(check_charts(own), MeasureError);
  own.charts = {{"balls.red.mass", "max_speed", ""}};
  EXPECT_THROW(check_charts(own), MeasureError);
  own.charts = {{"balls.red.mass", "collisions", "balls.blue.mass"}};
  EXPECT_THROW(check_charts(own), MeasureError);
}

TEST(Spread, IsThatOfTheNumbers) {
  Spread spread;
  for (const double value : {1.0, 2.0, 4.0, std::nan("")}) spread.add(value);
  EXPECT_EQ(spread.count(), 3u);
  EXPECT_DOUBLE_EQ(spread.mean(), 7.0 / 3);
  EXPECT_DOUBLE_EQ(spread.sd(), std::sqrt(7.0 / 3));  // (16 + 1 + 25) / 9 / 2
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
  const std::string gas =
      "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [-1, -1, -1], max: [1, 1, 1]}\n"
      "groups: {gas: {count: 5, ball: {mass: 1, radius: 0.1}, in: {min: [-1, -1, -1], max: [1, 1, 1]}, speed: 1}}\n"
      "simulate: {duration: 0.5}\noutput: {collisions: true}\n";
  std::vector<ComparedRun> runs;
  std::vector<double> speeds;
  // The seed varies slowest: a scenario's runs are not adjacent.
  for (const char* seed : {"1", "2", "3"})
    for (const char* e : {"0.9", "1"}) {
      const std::string id = "r" + std::to_string(runs.size() + 1);
      const RunResult result =
          place.run(gas, id, {std::string("seed=") + seed, std::string("restitution.default=") + e});
      if (std::string(e) == "0.9") speeds.push_back(result.summary.max_speed);
      runs.push_back({id, place / id, {e, seed}});
    }
  place.compare(plan, runs, "out");
  const auto rows = rows_of(place.read("out/repeats.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"restitution.default", "n", "max_speed_m_per_s.mean", "max_speed_m_per_s.sd",
                                      "max_speed_m_per_s.min", "max_speed_m_per_s.max"}));
  const double mean = (speeds[0] + speeds[1] + speeds[2]) / 3;
  double squares = 0;
  for (const double speed : speeds) squares += (speed - mean) * (speed - mean);
  EXPECT_EQ(rows[1][0], "0.9");
  EXPECT_EQ(rows[1][1], "3");
  EXPECT_NEAR(std::stod(rows[1][2]), mean, 1e-14);
  EXPECT_NEAR(std::stod(rows[1][3]), std::sqrt(squares / 2), 1e-14);
  EXPECT_EQ(std::stod(rows[1][4]), *std::min_element(speeds.begin(), speeds.end()));
  EXPECT_EQ(std::stod(rows[1][5]), *std::max_element(speeds.begin(), speeds.end()));
  const Json book = place.workbook("out");
  EXPECT_EQ(book["order"][2], "Repeats");
  EXPECT_EQ(book["sheets"]["Repeats"]["rows"].size(), 3u);
  const Json& series = book["sheets"]["Compare"]["charts"][0]["series"];
  ASSERT_EQ(series.size(), 3u);  // the means, and a bar for each
  EXPECT_TRUE(series[0]["bar"].is_null());
  EXPECT_NEAR(series[1]["bar"].get<double>(), std::sqrt(squares / 2), 1e-12);
}

}  // namespace
}  // namespace carom::testing
