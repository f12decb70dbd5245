// Measures: their names, and their values against the motion.
#include "run/measure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "compare/compared_run.h"
#include "compare/comparison_testing.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

const string mixed =
    "scene: 1\ngravity: [0, 0, 0]\n"
    "balls: {red: {mass: 3, radius: 0.1, position: [-1, 0, 0], velocity: [0.3, 0.4, 1.2]}}\n"
    "bodies: {box: {mass: 1, box: [0.1, 0.1, 0.1], position: [5, 0, 0]}}\n"
    "groups: {gas: {count: 3, ball: {mass: 2, radius: 0.1}, in: {min: [7, 0, 0], max: [9, 1, 1]}, speed: 1}}\n"
    "simulate: {duration: 1}\noutput: {trajectory: {every: 0.5}}\n";

Scene scene_of(const Place& place, const string& yaml) {
  place.write("scene.yaml", yaml);
  return load_scene(place / "scene.yaml");
}

string error_of(const string& name, const Scene& scene) {
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
  EXPECT_EQ(error_of("max(balls.red)", scene),
            "`max(balls.red)` has no quantity: expected one such as balls.NAME.speed_m_per_s");
  EXPECT_EQ(error_of("max(balls.red.y_m, 3)", scene),
            "`max(balls.red.y_m, 3)`: expected one quantity, such as max(balls.NAME.y_m)");

  EXPECT_EQ(error_of("hits(red, rde)", scene), "`hits(red, rde)`: nothing is named `rde`; did you mean `red`?");
  EXPECT_EQ(error_of("hits()", scene), "`hits()`: expected one or two names, such as hits(red, blue)");
  EXPECT_EQ(error_of("max(balls.red.y_m) / 2", scene),
            "`max(balls.red.y_m) / 2`: arithmetic begins with `=`, such as '= max(balls.red.y_m) / 2'");
  EXPECT_EQ(error_of("count(y_m)", scene), "`count(y_m)`: expected a comparison, such as count(y_m < 0)");

  EXPECT_EQ(error_of("first(red", scene),
            "`first(red` lacks a closing parenthesis; in YAML, a measure with a comma needs quotes");
  EXPECT_EQ(error_of("= 1 +", scene), "`= 1 +`: the expression ends too early; expected a number or a name after it");
  EXPECT_EQ(error_of("= let.r", scene), "`let` has no `r`");
  EXPECT_EQ(error_of("= hits(red) + nothing", scene),
            "`= hits(red) + nothing`: no number is named `nothing`; expected a measure, let.NAME or a number");

  EXPECT_EQ(error_of("groups.gas.x_m", scene), "`groups.gas.x_m` has no member; expected one such as groups.gas.0.x_m");
  EXPECT_EQ(error_of("groups.gas.3.x_m", scene), "`groups.gas.3.x_m`: the members of `gas` are 0 to 2");
  EXPECT_EQ(error_of("balls.red.0.x_m", scene), "`balls.red.0.x_m`: balls has no `red.0`; did you mean `red`?");
  EXPECT_EQ(error_of("regions.hole.entries", scene), "`regions.hole.entries`: no region is named `hole`");

  EXPECT_NE(error_of("", scene), "");
  EXPECT_NE(error_of("...", scene), "");
}

/// The text that the error of a scene's own measure marks.
string marked(const Place& place, const string& measure) {
  place.write("scene.yaml", mixed + "let: {k: 2}\nmeasures:\n  m: \"" + measure + "\"\n");
  LoadOptions options;
  options.measure_fault = measure_fault;
  try {
    load_scene(place / "scene.yaml", options);
  } catch (const SceneError& error) {
    const string text = error.what();
    const size_t line = text.find('\n') + 1, marks = text.find('\n', line) + 1;
    const size_t first = text.find('^', marks), end = text.find_first_not_of("^~", first);
    return text.substr(line + first - marks, end - first);
  }
  return "no error";
}

TEST(OwnMeasures, ErrorsMarkTheFaultyPartOfAnExpression) {
  const Place place;
  const pair<string, string> all[] = {
      {"= 1 + let.q", "let.q"},
      {"= hits(red) + nothing", "nothing"},
      {"=  2 * hits(red, rde) / 3", "hits(red, rde)"},
      {"= max(1, 2) + balls.red.speed", "balls.red.speed"},
      {"= hits(red) ** 2", "**"},
      {"= collisions + sqrt(1, 2)", "sqrt"},
      // Within a product, a count or a sum.
      {"= 2 * groups.gas.3.x_m", "groups.gas.3.x_m"},
      {"= 1 + count(y_m < let.h)", "let.h"},
      {"count(y_m < 2 * let.h)", "let.h"},
      {"count(groups.gas.y_m < 2 let.k)", "let.k"},
      {"= frames + 1e999", "1e999"},
      {"= 1 +", "+"},
      // The whole is wrong.
      {"balls.rde.x_m", "\"balls.rde.x_m\""},
      {"=", "\"=\""},
  };

  for (const auto& [measure, text] : all) EXPECT_EQ(marked(place, measure), text) << measure;
}

/// The values of measures, as the run itself finds them.
vector<Measured> measured(const Place& place, const string& yaml, const vector<string>& names) {
  const Scene scene = scene_of(place, yaml);
  RunSettings settings;
  for (const string& name : names) settings.measures.push_back(parse_measure(name, scene));
  return run_scene({&scene, place / "run", 0}, choose_engine(scene), settings, {[] {}, [](const RunProgress&) {}})
      .facts.measures;
}

TEST(MeasureValues, AreTheSameFromTheRunAndFromItsTables) {
  const Place place;
  const vector<string> names = {"balls.red.y_m",
                                "balls.red.speed_m_per_s",
                                "groups.gas.1.vx_m_per_s",
                                "groups.gas.2.kinetic_J",
                                "hits(red, gas)",
                                "first(gas, red)",
                                "hits(room)",
                                "hits(gas, room.x_max)",
                                "count(x_m > 7.5)",
                                "count(groups.gas.y_m <= 1 / 2)",
                                "= hits(room) / max(1, collisions)"};

  const string yaml = mixed + "room: {min: [-2, -1, -1], max: [9, 1, 2]}\n";
  const string long_run =
      std::regex_replace(yaml, std::regex("duration: 1\\}\noutput: \\{"), "duration: 40}\noutput: {collisions: true, ");
  const vector<Measured> of_run = measured(place, long_run, names);
  ASSERT_EQ(of_run.size(), names.size());
  const RunRecord with = read_run({"run", place / "run", {}}, measures_of({"", {}, names, {}, {}}));

  // The same run without its own measures: its tables have them.
  place.write("run/manifest.json", std::regex_replace(place.read("run/manifest.json"),
                                                      std::regex("\"measures\": \\{[^}]*\\}"), "\"measures\": {}"));
  const RunRecord without = read_run({"run", place / "run", {}}, measures_of({"", {}, names, {}, {}}));

  for (size_t k = 0; k < names.size(); ++k) {
    EXPECT_EQ(with.measures[k], of_run[k].value) << names[k];
    EXPECT_EQ(without.measures[k], of_run[k].value) << names[k];
  }
  EXPECT_GT(of_run[6].value, 0);
}

TEST(MeasureValues, OfARunWithoutBodiesAtItsEndAreThoseOfNone) {
  const Place place;
  // It leaves at 0.5 s, and the last rows of its trajectory are from before.
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {red: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [2, 0, 0]}}\n"
      "regions: {hole: {position: [2, 0, 0], box: [2, 2, 2], action: remove}}\nsimulate: {duration: 1}\n"
      "output: {trajectory: {every: 0.2}}\n";
  const vector<string> names = {"count(x_m < 7.5)", "balls.red.x_m"};
  place.run(yaml, "run");
  EXPECT_EQ(rows_of(place.read("run/trajectory.csv")).back()[0], "0.4");
  const RunRecord run = read_run({"run", place / "run", {}}, measures_of({"", {}, names, {}, {}}));
  EXPECT_EQ(run.measures[0], 0);
  EXPECT_TRUE(std::isnan(run.measures[1]));
}

TEST(MeasureValues, OfAStringCountForBothOfItsBodies) {
  const Place place;
  const vector<string> names = {"first(red, line)", "first(line, blue)", "hits(red, line)", "hits(blue, line)",
                                "hits(line)",       "hits(blue)",        "first(red, blue)"};

  // 3 m apart after 2 s, they exchange their velocities, and again where they meet.
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\n"
      "balls:\n"
      "  red: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [-1, 0, 0]}\n"
      "  blue: {mass: 1, radius: 0.1, position: [1, 0, 0]}\n"
      "strings: {line: {from: red, to: blue, length: 3, restitution: 1}}\n"
      "simulate: {duration: 6}\noutput: {collisions: true}\n";

  const double expected[] = {2, 2, 1, 1, 1, 2, 4.8};
  const vector<Measured> of_run = measured(place, yaml, names);
  place.write("run/manifest.json", std::regex_replace(place.read("run/manifest.json"),
                                                      std::regex("\"measures\": \\{[^}]*\\}"), "\"measures\": {}"));
  const RunRecord stored = read_run({"run", place / "run", {}}, measures_of({"", {}, names, {}, {}}));

  for (size_t k = 0; k < names.size(); ++k) {
    EXPECT_NEAR(of_run[k].value, expected[k], 1e-14) << names[k];
    EXPECT_EQ(stored.measures[k], of_run[k].value) << names[k];
  }
}

TEST(MeasureValues, OfAFreeBodyAreItsMotions) {
  const Place place;
  const auto values = measured(
      place, mixed,
      {"balls.red.x_m", "balls.red.vz_m_per_s", "balls.red.speed_m_per_s", "balls.red.kinetic_J", "max(balls.red.x_m)",
       "time_of_min(balls.red.x_m)", "= 2 * balls.red.kinetic_J / balls.red.speed_m_per_s ^ 2", "first(red, gas)",
       "= hits(red) / hits(gas, red)", "count(x_m < 0)"});
  const double expected[] = {-0.7, 1.2, 1.3, 1.5 * 1.69, -0.7, 0, 3};
  for (size_t k = 0; k < std::size(expected); ++k) EXPECT_DOUBLE_EQ(values[k].value, expected[k]) << values[k].name;
  EXPECT_TRUE(std::isnan(values[7].value)) << "they never meet";
  EXPECT_TRUE(std::isnan(values[8].value)) << "0 / 0";
  EXPECT_EQ(values[9].value, 1);
}

TEST(MeasureValues, OfThingsThatAreRepeatedNoTimeAreThoseOfAnEmptyGroup) {
  const Place place;
  const vector<pair<string, string>> all = {{"hits(THING)", "0"},
                                            {"hits(THING, v)", "0"},
                                            {"count(KIND.THING.x_m < 9)", "0"},
                                            {"first(THING)", "nan"},
                                            {"min(KIND.THING.x_m)", "nan"},
                                            {"max(KIND.THING.x_m)", "nan"},
                                            {"= hits(THING) + 1", "1"},
                                            // Of strings, planes and regions.
                                            {"hits(s)", "0"},
                                            {"hits(p)", "0"},
                                            {"regions.r.entries", "0"},
                                            {"regions.r.inside", "0"},
                                            {"regions.r.first_s", "nan"},
                                            {"time_of_max(KIND.THING.y_m)", "nan"}};

  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\n"
      "balls: {v: {mass: 1, radius: 0.1, position: [0, 0, 0]},\n"
      "  w: {repeat: 0, mass: 1, radius: 0.1, position: [= i, 0, 9]}}\n"
      "groups: {g: {count: 0, ball: {mass: 1, radius: 0.1}, in: {min: [7, 0, 0], max: [9, 1, 1]}}}\n"
      "planes: {p: {repeat: 0, point: [= i, 0, 0], normal: [1, 0, 0]}}\n"
      "strings: {s: {repeat: 0, from: [= i, 1, 0], to: v}}\n"
      "regions: {r: {repeat: 0, radius: 1, position: [= i, 0, 0]}}\n"
      "simulate: {duration: 1, stop: [{region: r}]}\noutput: {collisions: true}\n";

  // Each measure of a ball, and of a group.
  for (const auto& [kind, thing] : {pair("balls", "w"), pair("groups", "g")}) {
    vector<string> names;
    for (const auto& [name, value] : all)
      names.push_back(
          std::regex_replace(std::regex_replace(name, std::regex("THING"), thing), std::regex("KIND"), kind));

    const vector<Measured> values = measured(place, yaml, names);
    ASSERT_EQ(values.size(), all.size());
    for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(fmt::format("{}", values[i].value), all[i].second) << names[i];
  }

  const Scene scene = scene_of(place, yaml);
  EXPECT_TRUE(scene.world.regions.empty());
  EXPECT_NE(error_of("max(groups.w.x_m)", scene), "") << "a ball is no group";
  EXPECT_NE(error_of("hits(r)", scene), "") << "a region is no thing";
  EXPECT_NE(error_of("balls.w.0.x_m", scene), "") << "the member is absent";
}

TEST(OwnMeasures, AreTheLastColumnsOfTheSummary) {
  const Place place;
  place.run(std::regex_replace(mixed, std::regex("scene: 1"),
                               "scene: 1\nlet: {twice: 2}\nmeasures: {end: balls.red.x_m, more: '= twice * let.twice', "
                               "twice: '= 2 * end'}"),
            "run");
  const string summary = place.read("run/summary.csv");
  EXPECT_NE(summary.find(",ended_by,energy_absorbed_J,contact_made_J,appeared_J,end,more,twice\n"), string::npos)
      << summary;
  EXPECT_NE(summary.find(",duration,0,0,0,-0.7,-2.8,-1.4\n"), string::npos) << summary;
}

TEST(OwnMeasures, AreColumnsOfAComparisonByTheirNames) {
  const Place place;
  place.run(std::regex_replace(mixed, std::regex("scene: 1"), "scene: 1\nmeasures: {end: balls.red.x_m}"), "run");
  ComparisonPlan plan;
  plan.own = {"end"};
  const auto measures = measures_of(plan);
  ASSERT_EQ(measures.size(), 1u);
  EXPECT_EQ(read_run({"run", place / "run", {}}, measures).measures[0], -0.7);
}

TEST(MeasureValues, OfAJointBodyArePartOfNoOther) {
  const Place place;
  const string sticking =
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
  EXPECT_EQ(label_of("max(balls.red.y_m)"), "maximum balls.red y (m)");
  EXPECT_EQ(label_of("time_of_min(balls.red.speed_m_per_s)"), "time of the minimum balls.red speed (s)");
  EXPECT_EQ(label_of("first(red, blue)"), "first hit of red, blue (s)");
  EXPECT_EQ(label_of("= hits(red) / 2"), "hits(red) / 2");
  EXPECT_EQ(unit_of("max(balls.red.kinetic_J)"), "J");
  EXPECT_EQ(unit_of("impulse_N_s"), "N s");
  EXPECT_EQ(unit_of("first_collision_s"), "s");
}

TEST(SummaryColumns, AreThoseOfTheFile) {
  const Place place;
  place.run(two_balls, "run");
  string header;
  for (const SummaryColumn& column : summary_columns()) header += (header.empty() ? "" : ",") + string(column.name);
  EXPECT_TRUE(place.read("run/summary.csv").starts_with(header + "\n"));
}

}  // namespace
}  // namespace carom::testing
