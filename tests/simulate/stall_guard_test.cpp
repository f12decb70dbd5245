#include "simulate/impact/stall_guard.h"

#include <gtest/gtest.h>

#include "simulate/simulation_error.h"
#include "std.h"

namespace carom {
namespace {

/// Counts impacts while the clock, at 5 s of 10, creeps by 5e-15 s each. Gives the error, or nothing.
string creep(double e, int impacts, bool moving = false) {
  StallGuard guard(2, 10);
  double now = 5;
  try {
    for (int k = 0; k < impacts; ++k, now += 5e-15) {
      guard.note_restitution(e, moving);
      guard.count(StallGuard::Happened::impact, now);
    }
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

TEST(StallGuard, LetsElasticImpactsGoOn) {
  EXPECT_EQ(creep(1, 4'000'000), "");
}

TEST(StallGuard, StopsLossyImpactsThatHardlyMoveTheClock) {
  EXPECT_EQ(creep(0.5, 1'500'000), "");
  EXPECT_TRUE(creep(0.5, 2'500'000)
                  .ends_with("(jammed, or inelastic collapse): give them room, raise their "
                             "restitution, or simulate.rest_speed"));
}

TEST(StallGuard, NamesRestitutionAboveOne) {
  EXPECT_TRUE(creep(1.5, 2'500'000)
                  .ends_with("(restitution above 1 adds energy at every collision): lower it, or "
                             "shorten simulate.duration"));
}

TEST(StallGuard, NamesMovingThingsThatCloseInOnElasticBodies) {
  EXPECT_TRUE(creep(1, 2'500'000, true)
                  .ends_with("(things that move close in on them): end or slow their `motion` before, or shorten "
                             "simulate.duration"));
  EXPECT_TRUE(creep(0.5, 2'500'000, true)
                  .ends_with("(jammed, or inelastic collapse): give them room, end or slow `motion` before, or raise "
                             "their restitution"));
}

TEST(StallGuard, NamesCrossingsOfRegions) {
  StallGuard guard(2, 10);
  string error;
  try {
    for (int k = 0; k < 2'500'000; ++k) guard.count(StallGuard::Happened::region_crossed, 5);
  } catch (const SimulationError& stopped) {
    error = stopped.what();
  }
  EXPECT_EQ(error,
            "at t = 5 s bodies cross regions so often that the clock stands still: shorten simulate.duration, or "
            "remove the regions");
  EXPECT_FALSE(guard.may_be_endless());
}

TEST(StallGuard, StopsElasticImpactsOnceTheClockStandsStill) {
  StallGuard guard(2, 10);
  guard.note_restitution(1);
  const auto impacts = [&](int n) {
    for (int k = 0; k < n; ++k) guard.count(StallGuard::Happened::impact, 5);
  };
  EXPECT_NO_THROW(impacts(2'000'000));
  EXPECT_THROW(impacts(1'000'000), SimulationError);
}

}  // namespace
}  // namespace carom
