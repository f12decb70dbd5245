// Statistics for comparing chaotic runs.
#include "bench/statistics.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Statistics, DistanceIsThatOfTheDistributionFunctions) {
  const vector<double> low = {1, 2, 3, 4}, high = {5, 6}, same = {1, 1, 2, 2, 3, 3, 4, 4};
  EXPECT_EQ(distance(low, high), 1);
  EXPECT_EQ(distance(low, same), 0);
  EXPECT_EQ(distance(low, vector<double>{3, 4}), 0.5);
  EXPECT_EQ(distance(vector<double>{3, 4}, low), 0.5);
}

Statistics run_with(double rate, double speed) {
  Statistics s;
  s.collision_rate = rate;
  s.mean_speed = speed;
  s.speeds = {0.5 * speed, speed, 1.5 * speed};
  return s;
}

TEST(Statistics, DeviationIsInStandardDeviationsOfOneMoreRun) {
  // Rates of 9, 10, 11: mean 10, standard deviation 1; of one more run's distance from the mean, sqrt(1 + 1/3).
  const Ensemble ensemble({run_with(9, 1), run_with(10, 1), run_with(11, 1)});
  EXPECT_EQ(ensemble.mean().collision_rate, 10);
  EXPECT_EQ(ensemble.deviation(run_with(10, 1)).value, 0);
  EXPECT_NEAR(ensemble.deviation(run_with(12, 1)).value, 2 / sqrt(4.0 / 3), 1e-12);
  EXPECT_NEAR(ensemble.deviation(run_with(8, 1)).value, 2 / sqrt(4.0 / 3), 1e-12);
}

TEST(Statistics, WhatIsTheSameInAllRunsHasNoDeviation) {
  const Ensemble ensemble({run_with(10, 1), run_with(10, 1), run_with(10, 1)});
  EXPECT_EQ(ensemble.deviation(run_with(10 + 1e-12, 1)).value, 0);
}

}  // namespace
}  // namespace carom
