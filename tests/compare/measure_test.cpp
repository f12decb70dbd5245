// Measures: their names, and their values against the motion.
#include "run/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/compared_run.h"
#include "compare/comparison_testing.h"
#include "scene/scene.h"

namespace carom::testing {
namespace {

const std::string mixed =
    "scene: 1\ngravity: [0, 0, 0]\n"
    "balls: {red: {mass: 3, radius: 0.1, position: [-1, 0, 0], velocity: [0.3, 0.4, 1.2]}}\n"
    "bodies: {box: {mass: 1, box: [0.1, 0.1, 0.1], position: [5, 0, 0]}}\n"
    "groups: {gas: {count: 3, ball: {mass: 2, radius: 0.1}, in: {min: [7, 0, 0], max: [9, 1, 1]}, speed: 1}}\n"
    "simulate: {duration: 1}\noutput: {trajectory: {every: 0.5}}\n";

Scene scene_of(const Place& place, const std::string& yaml) {
  place.write("scene.yaml", yaml);
  return load_scene(place / "scene.yaml");
}

std::string error_of(const std::string& name, const Scene& scene) {
  try {
    parse_measure(name, scene);
  } catch (const MeasureError& error) {
    return error.what();
  }
  return "";
}

TEST(MeasureNames, AreColumnsOrBodies) {
  const Place place;
  const Scene scene = scene_of(place, mixed);
  for (const char* name :
       {"energy_lost_J", "frames", "balls.red.x_m", "bodies.box.kinetic_J", "groups.gas.2.vy_m_per_s"})
    EXPECT_EQ(error_of(name, scene), "") << name;
}

TEST(MeasureNames, ThatMeanNothingHaveAnErrorEach) {
  const Place place;
  const Scene scene = scene_of(place, mixed);
  EXPECT_EQ(error_of("energy_lost", scene), "no measure `energy_lost`; did you mean `energy_lost_J`?");
  EXPECT_EQ(error_of("title", scene), "`title` of summary.csv is text, not a measure");
  EXPECT_EQ(error_of("balls.rde.x_m", scene), "`balls.rde.x_m`: balls has no `rde`; did you mean `red`?");
  EXPECT_EQ(
      error_of("balls.red.speed", scene),
      "`balls.red.speed`: no quantity `speed`; the quantities are x_m, y_m, z_m, vx_m_per_s, vy_m_per_s, vz_m_per_s, "
      "speed_m_per_s, kinetic_J");
  EXPECT_EQ(error_of("balls.red", scene), "`balls.red` has no quantity: expected one such as balls.NAME.speed_m_per_s");
  EXPECT_EQ(error_of("groups.gas.x_m", scene), "`groups.gas.x_m` has no member: expected one such as groups.gas.0.x_m");
  EXPECT_EQ(error_of("groups.gas.3.x_m", scene), "`groups.gas.3.x_m`: the members of `gas` are 0 to 2");
  EXPECT_EQ(error_of("balls.red.0.x_m", scene), "`balls.red.0.x_m`: balls has no `red.0`; did you mean `red`?");
  EXPECT_NE(error_of("", scene), "");
  EXPECT_NE(error_of("...", scene), "");
}

TEST(MeasureValues, OfAFreeBodyAreItsMotions) {
  const Place place;
  const Scene scene = scene_of(place, mixed);
  const auto value = [&](const char* name) {
    return value_of(parse_measure(name, scene), scene, scene.initial, Summary{});
  };
  EXPECT_EQ(value("balls.red.x_m"), -1);
  EXPECT_EQ(value("balls.red.vz_m_per_s"), 1.2);
  EXPECT_DOUBLE_EQ(value("balls.red.speed_m_per_s"), 1.3);
  EXPECT_DOUBLE_EQ(value("balls.red.kinetic_J"), 1.5 * 1.69);
}

TEST(MeasureValues, AreTheSameFromTheStateAndFromTheTrajectory) {
  const Place place;
  const std::vector<std::string> names = {"balls.red.y_m",           "balls.red.speed_m_per_s",
                                          "groups.gas.1.vx_m_per_s", "groups.gas.2.kinetic_J",
                                          "max_speed_m_per_s",       "first_collision_s"};
  ComparisonPlan plan{"", {}, names, {}, {}};
  std::vector<double> from_state;
  place.write("run.yaml", mixed);
  const Scene scene = load_scene(place / "run.yaml");
  RunSettings settings;
  settings.measure = [&](const Scene& of, const State& end, const Summary& summary) {
    for (const Measure& measure : measures_of(plan)) from_state.push_back(value_of(measure, of, end, summary));
    return std::vector<Measured>();
  };
  run_scene({&scene, place / "run", 0}, choose_engine(scene), settings, {[] {}, [](double, auto, auto) {}});
  const RunRecord run = read_run({"run", place / "run", {}}, measures_of(plan));
  ASSERT_EQ(run.measures.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (std::isnan(from_state[k]))
      EXPECT_TRUE(std::isnan(run.measures[k])) << names[k];
    else
      EXPECT_EQ(run.measures[k], from_state[k]) << names[k];
  }
}

TEST(MeasureValues, OfAJointBodyArePartOfNoOther) {
  const Place place;
  const std::string sticking =
      "scene: 1\ngravity: [0, 0, 0]\n"
      "balls:\n"
      "  red: {mass: 1, radius: 0.1, position: [-1, 0, 0], velocity: [2, 0, 0]}\n"
      "  blue: {mass: 1, radius: 0.1, position: [1, 0, 0]}\n"
      "simulate: {duration: 2, contact: merge}\noutput: {trajectory: {every: 0.5}}\n";
  place.run(sticking, "run");
  const auto measures =
      measures_of({"", {}, {"balls.red.vx_m_per_s", "balls.blue.vx_m_per_s", "balls.red.kinetic_J"}, {}, {}});
  const RunRecord run = read_run({"run", place / "run", {}}, measures);
  EXPECT_EQ(run.measures[0], 1);
  EXPECT_TRUE(std::isnan(run.measures[1]));
  EXPECT_TRUE(std::isnan(run.measures[2])) << "a trajectory does not tell what a joint body weighs";
}

TEST(MeasureLabels, HaveTheirUnits) {
  EXPECT_EQ(label_of("energy_lost_J"), "energy lost (J)");
  EXPECT_EQ(label_of("momentum_drift_kg_m_per_s"), "momentum drift (kg m/s)");
  EXPECT_EQ(label_of("balls.red_one.speed_m_per_s"), "balls.red_one speed (m/s)");
  EXPECT_EQ(label_of("collisions"), "collisions");
  EXPECT_EQ(unit_of("impulse_N_s"), "N s");
  EXPECT_EQ(unit_of("first_collision_s"), "s");
}

TEST(SummaryColumns, AreThoseOfTheFile) {
  const Place place;
  place.run(two_balls, "run");
  std::string header;
  for (const SummaryColumn& column : summary_columns())
    header += (header.empty() ? "" : ",") + std::string(column.name);
  EXPECT_TRUE(place.read("run/summary.csv").starts_with(header + "\n"));
}

}  // namespace
}  // namespace carom::testing
