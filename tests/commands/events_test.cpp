// Events in the report and in --json.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

const string scene =
    "scene: 1\nsimulate: {duration: 2}\ngravity: [0, 0, 0]\n"
    "balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0], velocity: [1, 0, 0]}}\n"
    "regions: {gate: {radius: 1, position: [2, 1, 0]}, far: {radius: 1, position: [9, 0, 0]}}\n"
    "forces:\n  - {uniform: [0, 0, 1], from: {region: gate}}\n  - {uniform: [0, 0, 1], from: {region: far}}\n"
    "output: {energy: true}\n";

TEST(EventsOfARun, AreInItsReportAndInJson) {
  const Workplace here;
  here.write("gates.yaml", scene);
  const Finished run = here.carom({"run", "gates.yaml", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto events = nlohmann::json::parse(run.out).at("scenes").at(0).at("events");
  EXPECT_EQ(events.size(), 2u);
  EXPECT_NEAR(events.at("{region: gate}").get<double>(), 1, 1e-13);
  EXPECT_TRUE(events.at("{region: far}").is_null());

  const Finished again = here.carom({"run", "gates.yaml", "-o", "again"});
  EXPECT_NE((again.out + again.err).find("events      {region: gate} at 1 s; {region: far} did not happen"),
            string::npos)
      << again.out;
}

}  // namespace
}  // namespace carom::testing
