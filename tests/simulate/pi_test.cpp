// Galperin's billiard: a heavy ball drives a light one against a wall. Unfolded, the path is a straight line through
// wedges of the angle theta = atan sqrt(m/M). The collisions are the sides of wedges that it crosses: ceil(pi / theta)
// - 1. (Galperin, Regul. Chaotic Dyn. 8 (2003) 375.)
#include <gtest/gtest.h>

#include "simulate/build.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

Tally heavy_against_wall(double ratio, double duration) {
  Problem problem;
  problem.plane({0, 0, 0}, {1, 0, 0});
  problem.ball({2, 0, 0}, {0, 0, 0}, 1);
  problem.ball({5, 0, 0}, {-1, 0, 0}, ratio);
  problem.options.duration = duration;
  problem.options.record_collisions = false;
  return run_exact(problem).tally;
}

TEST(PiBilliard, CollisionsCountTheDigitsOfPi) {
  SLOW_WITH_SANITIZERS();
  const uint64_t digits[] = {3, 31, 314, 3141, 31415, 314159, 3141592};
  for (int k = 0; k < 7; ++k)
    EXPECT_EQ(heavy_against_wall(pow(100.0, k), 1e6).collisions(), digits[k]) << "mass ratio 100^" << k;
}

// Where pi / theta is a whole number the last wedge's side is parallel to the line: no collision. By Niven's theorem
// that is so at the mass ratios 1/3, 1 and 3 only.
TEST(PiBilliard, ALineAlongAWedgesSideDoesNotCrossIt) {
  SLOW_WITH_SANITIZERS();
  EXPECT_EQ(heavy_against_wall(1.0 / 3, 1e6).collisions(), 2u);
  EXPECT_EQ(heavy_against_wall(1, 1e6).collisions(), 3u);
  EXPECT_EQ(heavy_against_wall(3, 1e6).collisions(), 5u);
}

// A thousandth of an angle decides on one more collision, with the heavy ball already far away.
TEST(PiBilliard, AThousandthOfAnAngleDecidesBetweenNeighbours) {
  SLOW_WITH_SANITIZERS();
  for (int n : {5, 7, 10, 100, 1000, 10000, 100000, 1000000}) {
    for (long double side : {-1e-3L, 1e-3L}) {
      const long double cot = 1 / std::tan(3.14159265358979323846264338327950288L / (n + side));
      const double ratio = static_cast<double>(cot * cot);
      EXPECT_EQ(heavy_against_wall(ratio, 1e6).collisions(), static_cast<uint64_t>(side < 0 ? n - 1 : n))
          << n << (side < 0 ? " less" : " more");
    }
  }
}

/// A ball of diameter 1 between two planes.
Problem squeezed(double room, double e) {
  Problem problem;
  problem.plane({0, 0, 0}, {1, 0, 0});
  problem.plane({1 + room, 0, 0}, {-1, 0, 0});
  problem.ball({0.5, 0, 0}, {1, 0, 0}, 1, 0.5, e);
  problem.options.duration = 1e7;
  problem.options.record_collisions = false;
  return problem;
}

// A million collisions in 1e-3 of 1e7 s.
TEST(StandingClock, EndsARunWithAdviceForItsRestitution) {
  SLOW_WITH_SANITIZERS();
  const string what = "bodies collide so often that the clock stands still ";
  const auto ends = [&](const Problem& problem) {
    const string error = error_of(problem);
    return error.substr(std::min(error.size(), error.find(what)));
  };
  EXPECT_EQ(ends(squeezed(0x1p-30, 1 + 1e-9)),
            what + "(restitution above 1 adds energy at every collision): lower it, or shorten simulate.duration");
}

// An elastic ball without room stops, and that is counted.
TEST(StandingClock, DoesNotEndARunWithoutRoom) {
  SLOW_WITH_SANITIZERS();
  const Outcome run = run_exact(squeezed(0, 1));
  EXPECT_EQ(run.end.velocity[0], Vec3(0, 0, 0));
  EXPECT_EQ(run.tally.shared.without_room, 1u);
  EXPECT_EQ(run.tally.energy_lost, 0.5);
}

}  // namespace
}  // namespace carom
