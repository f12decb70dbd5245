// Outcomes with known best points, shapes and correlations.
#include "compare/findings.h"

#include <gtest/gtest.h>

#include "compare/charts.h"
#include "compare/heat_map.h"
#include "std.h"

namespace carom::testing {
namespace {

/// A plan of the parameters a, b, ... and the measures collisions and energy_lost_J, and its outcomes.
struct Made {
  Made(const vector<vector<string>>& points, const vector<vector<double>>& values) {
    for (size_t p = 0; p < points.front().size(); ++p) plan.parameters.push_back({string(1, char('a' + p)), ""});
    plan.measures = {"collisions", "energy_lost_J"};
    plan.measures.resize(values.front().size());
    outcomes.emplace(plan, values.front().size(), points.size());
    for (size_t i = 0; i < points.size(); ++i) outcomes->add(i, {"r" + to_string(i), "", points[i]}, true, values[i]);
    outcomes->finish();
  }
  Findings findings(bool unrelated = false) const { return findings_of(*outcomes, plan.measures.size(), unrelated); }
  vector<Chart> charts() const { return chosen_charts(plan, measures_of(plan), *outcomes, findings()); }

  ComparisonPlan plan;
  optional<Outcomes> outcomes;
};

/// A Latin hypercube of n points: each parameter has n values, in an order of its own.
Made hypercube(size_t n) {
  vector<vector<string>> points;
  vector<vector<double>> values;
  for (size_t i = 0; i < n; ++i) {
    const size_t b = (i * 7 + 3) % n;
    points.push_back({to_string(i) + ".5", to_string(b) + ".25"});
    values.push_back({double(b), double(i) * double(i)});
  }
  return {points, values};
}

/// Every combination of values.
Made grid(size_t rows, size_t columns) {
  vector<vector<string>> points;
  vector<vector<double>> values;
  for (size_t i = 0; i < rows; ++i)
    for (size_t k = 0; k < columns; ++k) {
      points.push_back({to_string(i), to_string(k)});
      values.push_back({double(10 * i + k)});
    }
  return {points, values};
}

TEST(Findings, RankTheTenHighestAndTheTenLowestPoints) {
  vector<vector<string>> points;
  vector<vector<double>> values;
  for (int i = 0; i < 40; ++i) {
    points.push_back({to_string(i)});
    values.push_back({double(i * 17 % 40)});
  }
  const Made made(points, values);
  const MeasureFinding finding = made.findings().measures[0];

  ASSERT_EQ(finding.highest.size(), 10u);
  ASSERT_EQ(finding.lowest.size(), 10u);
  for (size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(values[finding.highest[k]][0], 39 - double(k));
    EXPECT_EQ(values[finding.lowest[k]][0], double(k));
  }
}

TEST(Findings, OfFewPointsRankEachOnce) {
  const Made made({{"1"}, {"2"}, {"3"}, {"4"}}, {{5}, {7}, {5}, {6}});
  const MeasureFinding finding = made.findings().measures[0];
  EXPECT_EQ(finding.highest, (vector<size_t>{1, 3, 0, 2}));
  EXPECT_TRUE(finding.lowest.empty());
  EXPECT_EQ(finding.at_highest, 1u);
  EXPECT_EQ(finding.at_lowest, 2u);
}

TEST(Findings, LeaveOutPointsWithoutAValue) {
  const double nan = numeric_limits<double>::quiet_NaN();
  const Made made({{"1"}, {"2"}, {"3"}}, {{nan}, {2}, {1}});
  EXPECT_EQ(made.findings().measures[0].points, 2u);
  EXPECT_EQ(made.findings().measures[0].highest, (vector<size_t>{1, 2}));
}

TEST(Findings, TakeEqualValuesUpToRoundingForConstant) {
  const Made made({{"1"}, {"2"}, {"3"}}, {{0.3, 1}, {0.1 + 0.2, 1 + 1e-9}, {0.3, 1}});
  const Findings findings = made.findings();
  EXPECT_TRUE(findings.measures[0].is_constant);
  EXPECT_FALSE(findings.measures[1].is_constant);
  EXPECT_EQ(shown_findings(findings, 9).size(), 1u);
  // Constants have no chart.
  ASSERT_EQ(made.charts().size(), 1u);
  EXPECT_EQ(made.charts()[0].y, "energy_lost_J");
}

TEST(Findings, NameTheParameterThatOrdersAMeasure) {
  const Made made = hypercube(40);
  const Findings findings = made.findings();
  ASSERT_EQ(findings.parameters.size(), 2u);
  EXPECT_EQ(findings.measures[0].strongest, 1u);
  EXPECT_DOUBLE_EQ(findings.measures[0].correlations[1], 1);
  EXPECT_EQ(findings.measures[1].strongest, 0u);
  EXPECT_DOUBLE_EQ(findings.measures[1].correlations[0], 1);
}

TEST(Findings, NameNoParameterWhereCorrelationIsChance) {
  // A parabola about the middle: no rank correlation with the parameter.
  vector<vector<string>> points;
  vector<vector<double>> values;
  for (int i = -20; i <= 20; ++i) {
    points.push_back({to_string(i)});
    values.push_back({double(i * i)});
  }
  const MeasureFinding finding = Made(points, values).findings().measures[0];
  EXPECT_NEAR(finding.correlations[0], 0, 1e-15);
  EXPECT_FALSE(finding.strongest);
}

TEST(Variety, OfOneParameterOrSeveralInStepIsALine) {
  EXPECT_EQ(variety_of(*Made({{"1", "8"}, {"2", "6"}, {"3", "1"}}, {{1}, {2}, {3}}).outcomes), Variety::line);
  EXPECT_EQ(variety_of(*Made({{"1"}, {"2"}}, {{1}, {2}}).outcomes), Variety::line);
}

TEST(Variety, OfAGridIsAPlaneEvenWithHolesAndOfAHypercubeSamples) {
  EXPECT_EQ(variety_of(*grid(5, 4).outcomes), Variety::plane);
  EXPECT_EQ(variety_of(*Made({{"1", "1"}, {"1", "2"}, {"2", "1"}}, {{1}, {2}, {3}}).outcomes), Variety::plane);
  EXPECT_EQ(variety_of(*hypercube(11).outcomes), Variety::samples);
  EXPECT_EQ(variety_of(*Made({{"1"}}, {{1}}).outcomes), Variety::runs);
}

TEST(Variety, OfAHypercubeTimesAGridHasAllParameters) {
  // Each sample of a and b with two values of c: none of a and b decides the other.
  vector<vector<string>> points;
  vector<vector<double>> values;
  for (size_t i = 0; i < 30; ++i)
    for (const char* c : {"1", "2"}) {
      const size_t b = (i * 7 + 3) % 30;
      points.push_back({to_string(i) + ".5", to_string(b) + ".25", c});
      values.push_back({double(b)});
    }
  const Findings findings = Made(points, values).findings();
  EXPECT_EQ(findings.variety, Variety::samples);
  EXPECT_EQ(findings.parameters, (vector<size_t>{0, 1, 2}));
  EXPECT_EQ(findings.measures[0].strongest, 1u);
}

TEST(Variety, OfTextsThatNumbersDecideHasTheNumbersAlone) {
  // Words that go with each sample are no parameter of their own; words of a grid are.
  EXPECT_EQ(Made({{"one", "1"}, {"two", "2"}, {"three", "3"}}, {{1}, {2}, {3}}).findings().parameters,
            vector<size_t>{1});
  EXPECT_EQ(Made({{"x", "1"}, {"y", "1"}, {"x", "2"}, {"y", "2"}}, {{1}, {2}, {3}, {4}}).findings().parameters,
            (vector<size_t>{1, 0}));
}

TEST(Findings, TakeEqualRunsUpToRoundingForEqualRanks) {
  // Rows of equal values but for their last bits, which no parameter explains.
  vector<vector<string>> points;
  vector<vector<double>> values;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) {
      points.push_back({to_string(i), to_string(k)});
      values.push_back({1 + 0.1 * i + 1e-15 * k});
    }
  const MeasureFinding finding = Made(points, values).findings().measures[0];
  EXPECT_DOUBLE_EQ(finding.correlations[0], 1);
  EXPECT_NEAR(finding.correlations[1], 0, 1e-15);
  EXPECT_EQ(finding.at_highest, 6u);
  EXPECT_EQ(finding.top, 30u);
}

TEST(Findings, NameNoParameterOfFourRuns) {
  // Four values are in order by chance in 2 of 24 cases, five in 2 of 120.
  EXPECT_FALSE(Made({{"1"}, {"2"}, {"3"}, {"4"}}, {{1}, {2}, {3}, {4}}).findings().measures[0].strongest);
  EXPECT_TRUE(Made({{"1"}, {"2"}, {"3"}, {"4"}, {"5"}}, {{1}, {2}, {3}, {4}, {5}}).findings().measures[0].strongest);
}

TEST(Charts, OfSamplesAreAScatterForEachParameterWithoutLines) {
  const Made made = hypercube(30);
  const vector<Chart> charts = made.charts();
  ASSERT_EQ(charts.size(), 4u);
  // The parameter that matters most comes first.
  EXPECT_EQ(charts[0].x, "b");
  EXPECT_EQ(charts[1].x, "a");
  EXPECT_EQ(charts[2].x, "a");
  for (const Chart& chart : charts) {
    const ChartData data = chart_data(chart, made.plan, measures_of(made.plan), *made.outcomes, Variety::samples);
    EXPECT_FALSE(data.joined);
    EXPECT_EQ(data.lines.size(), 1u);
    EXPECT_EQ(data.x.size(), 30u);
  }
}

TEST(Charts, OfALargeGridHaveLinesForValuesFromTheFirstToTheLast) {
  const Made made = grid(25, 25);
  const Chart chart = made.charts().at(0);
  const ChartData data = chart_data(chart, made.plan, measures_of(made.plan), *made.outcomes, Variety::plane);
  ASSERT_EQ(data.lines.size(), 8u);
  EXPECT_EQ(data.lines.front().name, "b = 0");
  EXPECT_EQ(data.lines.back().name, "b = 24");
  EXPECT_EQ(data.note, "8 of 25 values of b");
  EXPECT_TRUE(data.joined);
  EXPECT_EQ(data.lines.back().y[3], 54);  // 10 * 3 + 24
}

TEST(HeatMap, OfManyValuesHasEvenlySpacedOnesWithBothEnds) {
  const Made made = grid(30, 4);
  const HeatMap map = heat_map(*made.outcomes, {0, 1}, 0, 10);
  EXPECT_EQ(map.rows.size(), 10u);
  EXPECT_EQ(map.rows.front(), 0u);
  EXPECT_EQ(map.rows.back(), 29u);
  EXPECT_EQ(map.columns.size(), 4u);
  for (size_t row = 0; row < map.rows.size(); ++row)
    for (size_t column = 0; column < 4; ++column) EXPECT_EQ(map.mean(row, column), double(10 * map.rows[row] + column));
}

TEST(HeatMap, IsMadeOfGridsAlone) {
  EXPECT_TRUE(heat_map_parameters(grid(3, 3).plan, *grid(3, 3).outcomes));
  EXPECT_FALSE(heat_map_parameters(hypercube(20).plan, *hypercube(20).outcomes));
}

}  // namespace
}  // namespace carom::testing
