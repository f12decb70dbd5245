// The numbers that the charts of a run show, and their files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "export/export_testing.h"
#include "export/plot_axis.h"
#include "export/run_charts.h"
#include "scene/fields.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

/// So many bodies of one mass or several, at rest at y = 0, 1, ...
Scene scene_of(Entity bodies, const vector<double>& masses = {1}) {
  Scene scene = small_scene();
  scene.world.mass.clear();
  scene.initial.position.clear();
  for (Entity body = 0; body < bodies; ++body) {
    scene.world.mass.push_back(masses[body % masses.size()]);
    scene.initial.position.push_back(Vec3(0, body, 0));
  }
  scene.initial.velocity.assign(bodies, Vec3::Zero());
  scene.world.radius.assign(bodies, 0.1);
  scene.world.restitution.assign(bodies, 1);
  scene.roster.bodies = {{"gas", 0, bodies, true, {}}};
  return scene;
}

/// Velocities in so many dimensions, spread evenly.
Vec3 some_velocity(size_t body, int dimensions) {
  Vec3 v = Vec3::Zero();
  for (int axis = 0; axis < dimensions; ++axis) v[axis] = 3 * std::sin(static_cast<double>(body) * (axis + 1) + axis);
  return v;
}

SpeedsChart speeds_of(const Scene& scene, int dimensions) {
  SpeedsChart speeds(scene);
  for (size_t body = 0; body < scene.world.mass.size(); ++body)
    speeds.add(scene.world.mass[body], some_velocity(body, dimensions));
  return speeds;
}

double integral_of_curve(const PlotSeries& curve) {
  double sum = 0;
  for (size_t i = 1; i < curve.points.size(); ++i)
    sum += (curve.points[i].x - curve.points[i - 1].x) * (curve.points[i].y + curve.points[i - 1].y) / 2;
  return sum;
}

TEST(SpeedsChart, BarsHoldEveryBodyOnce) {
  for (const Entity bodies : {1u, 2u, 29u, 1000u}) {
    const Scene scene = scene_of(bodies);
    EXPECT_EQ(speeds_of(scene, 3).histogram().total(), bodies);
    // All at rest.
    SpeedsChart resting(scene);
    resting.add(scene.initial);
    EXPECT_EQ(resting.histogram().total(), bodies);
    EXPECT_EQ(resting.histogram().counts.size(), 1u);
  }
}

TEST(SpeedsChart, MaxwellsCurveIntegratesToTheNumberOfBodiesInEveryDimension) {
  for (const int dimensions : {1, 2, 3}) {
    for (const auto& masses : {vector<double>{1}, {0.5, 2, 7}}) {
      const Scene scene = scene_of(600, masses);
      const SpeedsChart speeds = speeds_of(scene, dimensions);
      const Plot plot = speeds.plot();
      ASSERT_EQ(plot.series.size(), 2u);
      EXPECT_EQ(plot.series[1].name, "Maxwell, " + to_string(dimensions) + "-D");
      // The chart ends where the curve has 1 % of its peak. Measured: 0.8 % of the bodies are beyond.
      EXPECT_NEAR(integral_of_curve(plot.series[1]) / speeds.histogram().width, 600, 0.01 * 600) << dimensions;
      double bodies = 0;
      constexpr double width = 0.001;
      for (double v = width / 2; v < 40; v += width) bodies += speeds.maxwell(v, width);
      // Measured: 5e-7.
      EXPECT_NEAR(bodies / 600, 1, 1e-6) << dimensions;
    }
  }
}

TEST(SpeedsChart, MaxwellsCurveHasTheKineticEnergyOfTheBodies) {
  const Scene scene = scene_of(600);
  const SpeedsChart speeds = speeds_of(scene, 3);
  double energy = 0, of_curve = 0;
  for (size_t body = 0; body < 600; ++body) energy += some_velocity(body, 3).squaredNorm() / 2;
  constexpr double width = 0.001;
  for (double v = width / 2; v < 40; v += width) of_curve += speeds.maxwell(v, width) * v * v / 2;
  EXPECT_NEAR(of_curve / energy, 1, 1e-6);
}

TEST(SpeedsChart, HasNoCurveForFewBodiesNorForResting) {
  const Scene few = scene_of(29), resting = scene_of(100);
  EXPECT_FALSE(speeds_of(few, 3).has_maxwell());
  EXPECT_FALSE(speeds_of(resting, 0).has_maxwell());
  Scene merging = scene_of(100);
  merging.simulate.contact.merge = true;
  EXPECT_FALSE(speeds_of(merging, 3).has_maxwell());
  EXPECT_TRUE(speeds_of(resting, 3).has_maxwell());
}

TEST(CollisionsChart, RatesTimesTheirIntervalsSumToTheCollisions) {
  const Scene scene = small_scene();
  for (const int count : {0, 1, 7, 40'000}) {
    CollisionsChart chart(scene);
    for (int i = 0; i < count; ++i)
      chart.add(scene.simulate.duration * i / count, i % 3 == 0 ? CollisionKind::body_fixed : CollisionKind::body_body);
    // The end of the run belongs to the last interval, and the end of bounces is no collision.
    chart.add(scene.simulate.duration, CollisionKind::merge);
    chart.add(0.2, CollisionKind::taut);
    chart.add(0.1, CollisionKind::rest);
    double collisions = 0;
    for (const PlotSeries& series : chart.plot().series)
      for (size_t i = 1; i < series.points.size(); i += 2)
        collisions += (series.points[i].high - series.points[i].low) * (series.points[i].x - series.points[i - 1].x);
    EXPECT_NEAR(collisions, count + 2, 1e-12 * (count + 2));
    EXPECT_EQ(chart.histogram(CollisionKind::body_fixed).total(), static_cast<uint64_t>((count + 2) / 3));
    EXPECT_EQ(chart.histogram(CollisionKind::merge).total(), 1u);
    EXPECT_EQ(chart.histogram(CollisionKind::taut).total(), 1u);
  }
}

TEST(CollisionsChart, OfARunWithoutDurationHasNoRate) {
  Scene scene = small_scene();
  scene.simulate.duration = 0;
  CollisionsChart chart(scene);
  chart.add(0, CollisionKind::body_body);
  EXPECT_TRUE(chart.plot().series.empty());
}

TEST(ThinnedLine, KeepsEveryExtremeWithAFewPointsForEachColumn) {
  ThinnedLine line(0, 1);
  double lowest = 0, highest = 0;
  constexpr int instants = 200'000;
  for (int i = 0; i <= instants; ++i) {
    const double y = std::sin(i * 1.3) * i;
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
    line.add(i / static_cast<double>(instants), y);
  }

  const vector<PlotPoint> points = line.points();
  EXPECT_LE(points.size(), 4u * ThinnedLine::columns);
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  EXPECT_EQ(low->y, lowest);
  EXPECT_EQ(high->y, highest);

  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; }));
  EXPECT_EQ(points.front().x, 0);
  EXPECT_EQ(points.back().x, 1);
}

TEST(HeightsChart, OfFewBodiesHasALineForEach) {
  const Scene scene = scene_of(HeightsChart::most_lines);
  HeightsChart heights(scene);
  heights.add(0, scene.initial);
  heights.add(scene.simulate.duration, scene.initial);
  const Plot plot = heights.plot();
  ASSERT_EQ(plot.series.size(), HeightsChart::most_lines);
  EXPECT_EQ(plot.series[3].name, "gas.3");
  EXPECT_EQ(plot.series[3].points.back().y, 3);
}

TEST(HeightsChart, OfManyBodiesHasTheirMedianAndQuarters) {
  const Scene scene = scene_of(101);
  HeightsChart heights(scene);
  heights.add(0, scene.initial);
  const Plot plot = heights.plot();
  ASSERT_EQ(plot.series.size(), 3u);
  const PlotPoint &all = plot.series[0].points[0], &half = plot.series[1].points[0];
  EXPECT_EQ(all.low, 0);
  EXPECT_EQ(half.low, 25);
  EXPECT_EQ(plot.series[2].points[0].y, 50);
  EXPECT_EQ(half.high, 75);
  EXPECT_EQ(all.high, 100);
}

TEST(HeightsChart, OfAnyNumberOfInstantsHasOneForEachColumnAndTheLast) {
  const Scene scene = scene_of(9);
  HeightsChart heights(scene);
  const vector<double> some(9, 1.0);
  for (int i = 0; i <= 50'000; ++i) heights.add(scene.simulate.duration * i / 50'000, some);
  const vector<PlotPoint> points = heights.plot().series[2].points;
  EXPECT_EQ(points.size(), ThinnedLine::columns + 1u);
  EXPECT_EQ(points.back().x, scene.simulate.duration);
}

TEST(HeightsChart, LeavesOutBodiesThatBecamePartOfOthers) {
  const Scene scene = scene_of(2);
  State merged = scene.initial;
  merged.part_of = {1, 1};
  merged.mass = {0, 2};
  HeightsChart heights(scene);
  heights.add(0, scene.initial);
  heights.add(scene.simulate.duration, merged);
  EXPECT_EQ(heights.plot().series[0].points.size(), 1u);
  EXPECT_EQ(heights.plot().series[1].points.size(), 2u);
  SpeedsChart speeds(scene);
  speeds.add(merged);
  EXPECT_EQ(speeds.histogram().total(), 1u);
}

TEST(PlotAxis, TicksAreRoundAndTheirTextsExact) {
  const auto texts = [](const PlotAxis& axis) {
    vector<string> all;
    for (const PlotTick& tick : axis.ticks) all.push_back(tick.text);
    return all;
  };

  using Texts = vector<string>;
  EXPECT_EQ(texts(linear_axis(0, 0.3, 6)), (Texts{"0", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30"}));
  EXPECT_EQ(texts(linear_axis(-1, 1, 6)), (Texts{"-1.0", "-0.5", "0", "0.5", "1.0"}));
  EXPECT_EQ(texts(linear_axis(0, 3, 6, 1)), (Texts{"0", "1", "2", "3"}));

  const PlotAxis large = linear_axis(0, 2.5e6, 6), small = linear_axis(0, 4e-5, 6);
  EXPECT_EQ(texts(large), (Texts{"0", "0.5", "1.0", "1.5", "2.0", "2.5"}));
  EXPECT_EQ(large.label("energy", "J"), "energy (10⁶ J)");
  EXPECT_EQ(texts(small), (Texts{"0", "10", "20", "30", "40"}));
  EXPECT_EQ(small.label("height y", "m"), "height y (10⁻⁶ m)");
}

TEST(PlotAxis, OfValuesThatDifferByRoundingHasRoomAroundThem) {
  for (const double value : {0.0, 40.0, -3e-20, 5e300, 1e-320}) {
    const PlotAxis axis = linear_axis(value, value * (1 + 1e-15), 6);
    EXPECT_LT(axis.from, axis.to) << value;
    EXPECT_GE(axis.ticks.size(), 2u) << value;
    EXPECT_LE(axis.ticks.size(), 8u) << value;
  }
}

TEST(Charts, AreThoseOfTheTableOfOutputs) {
  vector<string> names;
  for (const RunChart& chart : run_charts())
    for (const char* ending : {".svg", ".png"}) names.push_back(string(chart.name) + ending);
  const auto listed = parts_of(plot_files.names);
  EXPECT_EQ(names, vector<string>(listed.begin(), listed.end()));
  EXPECT_TRUE(plot_files.has("speeds.svg"));
  for (const char* name : {"speeds", "speeds.pdf", "energy.svg|energy.png", ""}) EXPECT_FALSE(plot_files.has(name));
}

TEST(Charts, ShowTheRowsOfTheTablesThatTheSceneLists) {
  Scene scene = small_scene();
  scene.output.plots = true;
  EXPECT_EQ(RunCharts(scene).ticks.energy.count(), plot_instants);
  scene.output.energy = EnergyOutput{0.1};
  scene.output.trajectory = TrajectoryOutput{0.05};
  EXPECT_EQ(RunCharts(scene).ticks.energy.count(), 3);
  EXPECT_EQ(RunCharts(scene).ticks.heights.count(), 5);
  // Also of tables that --only leaves out.
  scene.output = restricted(scene.output, {"plots"});
  EXPECT_FALSE(scene.output.energy);
  EXPECT_EQ(RunCharts(scene).ticks.energy.count(), 3);
}

TEST(Charts, OfARunAreFilesOfItsFolderWithTheSameBytesEachTime) {
  Scene scene = small_scene();
  scene.output.plots = true;
  const TempFolder here;
  run(scene, here / "a");
  run(scene, here / "b");

  set<string> listed;
  const auto manifest = nlohmann::json::parse(read(here / "a/manifest.json"));
  for (const auto& file : manifest["files"]) listed.insert(file["name"]);

  for (const string_view name : parts_of(plot_files.names)) {
    const string path = "plots/" + string(name), bytes = read(here / ("a/" + path));
    EXPECT_EQ(bytes, read(here / ("b/" + path))) << path;
    EXPECT_TRUE(bytes.starts_with(path.ends_with(".png") ? "\x89PNG\r\n\x1a\n" : "<?xml")) << path;
    EXPECT_TRUE(listed.contains(path)) << path;
  }
}

TEST(Charts, WithoutGnuplotAreRefusedBeforeTheFolderIsMade) {
  Scene scene = small_scene();
  scene.output.plots = true;
  const TempFolder here;
  const string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  EXPECT_EQ(error_of([&] { Exports(scene, here / "run"); }),
            "the plots need gnuplot, which is not on the PATH\n  install it (on Debian: apt install gnuplot-nox)");
  setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(names_in(here.path()).empty());
}

}  // namespace
}  // namespace carom
