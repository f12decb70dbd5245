// Scenes of regions, against their comments.
#include <gtest/gtest.h>

#include "engine/engine.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "std.h"

namespace carom::testing {
namespace {

struct Crossed {
  Scene scene;
  vector<RegionCrossing> crossings;
  Tally tally;
};

Crossed cross(const string& name) {
  Crossed run{load(name), {}, {}};
  const auto simulator = make_simulator(run.scene);
  while (simulator->time() < run.scene.simulate.duration) {
    simulator->advance_to(run.scene.simulate.duration);
    run.crossings.insert(run.crossings.end(), simulator->crossings().begin(), simulator->crossings().end());
  }
  run.tally = simulator->tally();
  return run;
}

TEST(Effusion, LosesAsManyBallsAsKineticTheorySays) {
  const string file = "effusion";
  const Crossed run = cross(file);
  const double mean = stated(file, "v = sqrt(8 / pi) = "), rate = stated(file, "of the centres, lose ");
  EXPECT_NEAR(mean, sqrt(8 / M_PI), 5e-4);
  EXPECT_NEAR(rate, 300 * mean * 0.64 / (4 * pow(1.98, 3)), 5e-3);
  int early = 0;
  for (const RegionCrossing& crossing : run.crossings) early += crossing.time < 3;
  // The mean, and four times the spread by chance.
  EXPECT_NEAR(early, stated(file, "at first. "), 4 * stated(file, "become fewer, and "));
  const double left = 300.0 - static_cast<double>(run.tally.changes.removed.bodies);
  EXPECT_GT(run.tally.changes.removed.energy / (300 - left), 1.5 * 1.1);  // J; on average 3/2 of m sigma^2 at first
}

TEST(Pockets, EndTheRunWithTheThirdBall) {
  const string file = "pockets";
  const Crossed run = cross(file);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->reason, EndReason::region);
  EXPECT_EQ(run.scene.roster.regions[run.tally.end->region], "p5");
  EXPECT_NEAR(run.tally.end->time, stated(file, "the run ends there, at t = "), 5e-5);
  ASSERT_EQ(run.crossings.size(), 3u);
  const char* const names[] = {"b4", "b6", "b1"};
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(run.scene.roster.name(run.crossings[k].body), names[k]);
  EXPECT_NEAR(run.tally.first_collision, stated(file, "the break at t = "), 5e-5);
  EXPECT_EQ(run.tally.changes.removed.bodies, 3u);
}

}  // namespace
}  // namespace carom::testing
