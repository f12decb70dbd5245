// The work of each force is in the report and in --json, and sums to the total.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

/// Bodies fall, bounce and come to rest, or follow curves; the caller gives `simulate` and the forces.
string falling(const string& simulate, const string& forces) {
  return "scene: 1\nsimulate: {" + simulate +
         "}\nplanes: {floor: {point: [0, 0, 0], normal: [0.3, 1, 0]}}\nrestitution: {default: 0.5}\nforces:\n" +
         forces +
         "balls:\n  a: {mass: 1, radius: 0.1, position: [0.5, 1, 0]}\n"
         "  b: {mass: 2, radius: 0.1, position: [2.5, 2, 0.1], velocity: [-1, 0, 0]}\n";
}

const string gust = "  - uniform: [3, 0, 0]\n    from: 0.5\n    until: 1.2\n", air = "  - drag: {linear: 0.3}\n";
const string pull = "  - attractor: {center: [1, 1, 1], strength: 2, softening: 0.1}\n",
             damper = "  - spring: {anchor: [0, 2, 0], stiffness: 20, rest_length: 0.5, damping: 0.4}\n    on: [a]\n",
             dense_air = "  - drag: {quadratic: 0.2}\n    on: [b]\n";

struct Balance {
  Json work;
  double missing = 0;  // J: of the kinetic energy's change, what neither forces nor impacts account for
};

Balance balance(const Workplace& here, const string& scene) {
  here.write("falling.yaml", scene + "output: {energy: {every: 1}}\n");
  const Finished run = here.carom({"run", "falling.yaml", "--json"});
  EXPECT_EQ(run.code, 0) << run.err;
  const Json entry = Json::parse(run.out).at("scenes").at(0);
  Balance balance{entry.at("work"), 0};
  for (const auto& [force, work] : balance.work.items()) balance.missing += work.get<double>();
  balance.missing -= entry.at("summary").at("energy_lost_J").get<double>();
  // Kinetic energies: the second cell of energy.csv's rows, of which the first is 1 J.
  const string table = here.read("output/falling/energy.csv");
  const size_t last = table.rfind('\n', table.size() - 2) + 1;
  balance.missing -= std::stod(table.substr(table.find(',', last) + 1)) - 1;
  return balance;
}

vector<string> names(const Json& work) {
  vector<string> all;
  for (const auto& [force, value] : work.items()) all.push_back(force);
  return all;
}

TEST(WorkOfForces, AndLossesOfImpactsAreTheChangeOfKineticEnergy) {
  const Workplace here;
  const Balance balance = testing::balance(here, falling("duration: 2", gust + air));
  EXPECT_EQ(names(balance.work), (vector<string>{"forces.0.uniform_J", "forces.1.drag_J", "gravity_J"}));
  EXPECT_GT(balance.work["gravity_J"], 0);
  EXPECT_LT(balance.work["forces.1.drag_J"], 0);
  EXPECT_NEAR(balance.missing, 0, 1e-12);
}

TEST(WorkOfForces, HasTheWindsInIt) {
  const Workplace here;
  const Balance balance =
      testing::balance(here, falling("duration: 2", "  - drag: {linear: 0.3, wind: [40, 0, 5]}\n" + gust));
  EXPECT_GT(balance.work["forces.0.drag_J"], 1);
  EXPECT_NEAR(balance.missing, 0, 1e-11);
}

TEST(WorkOfForces, AddsUpAlongCurvesToo) {
  const Workplace here;
  const Balance balance = testing::balance(here, falling("duration: 2", pull + gust + damper + air + dense_air));
  EXPECT_EQ(balance.work.size(), 6u);
  EXPECT_LT(balance.work["forces.4.drag_J"], 0);
  EXPECT_NEAR(balance.missing, 0, 1e-9);  // measured: 3e-11
}

// Without restitution they merge on the floor, which the merged ball overlaps until it is lifted.
TEST(WorkOfForces, OnBodiesThatMergeIsTheirPartsAndMergingHasItsOwn) {
  const Workplace here;
  string scene = falling("duration: 2, engine: exact, contact: merge", gust + air);
  scene.replace(scene.find("default: 0.5"), 12, "default: 0");
  const Balance balance = testing::balance(here, scene);
  EXPECT_EQ(balance.work.size(), 4u);
  EXPECT_GT(std::abs(balance.work["merging_J"].get<double>()), 0.01);
  EXPECT_NEAR(balance.missing, 0, 1e-12);
}

TEST(WorkOfForces, IsALineOfTheReportWhereThereAreForces) {
  const Workplace here;
  here.write("spring.yaml",
             "scene: 1\ngravity: [0, 0, 0]\nsimulate: {duration: 1}\nballs: {a: {mass: 1, radius: 0.1, position: "
             "[1, 0, 0]}}\nforces: [{spring: {anchor: [0, 0, 0], stiffness: 2.4674011002723395}}]\n");  // pi^2 / 4
  EXPECT_NE(here.carom({"run", "spring.yaml"}).out.find("\n  work        1.234 J of forces.0.spring\n"), string::npos);
}

}  // namespace
}  // namespace carom::testing
