// Maxwell's distribution of speeds, and in how many directions bodies move.
#include "physics/maxwell.h"

#include <gtest/gtest.h>

#include <numbers>

#include "std.h"

namespace carom {
namespace {

/// The integral of v^power times the density from 0 to 40 deviations, by the midpoint rule.
double moment(int power, int dimensions, double deviation) {
  constexpr int steps = 40000;
  const double width = 40 * deviation / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double v = (i + 0.5) * width;
    sum += pow(v, power) * maxwell_density(v, dimensions, deviation) * width;
  }
  return sum;
}

TEST(Maxwell, IsADistributionOfWhichTheMeanSquareIsTheNumberOfDimensions) {
  for (const int dimensions : {1, 2, 3}) {
    for (const double deviation : {0.01, 1.0, 300.0}) {
      // Measured: 3e-7.
      EXPECT_NEAR(moment(0, dimensions, deviation), 1, 1e-6) << dimensions;
      EXPECT_NEAR(moment(2, dimensions, deviation) / (dimensions * deviation * deviation), 1, 1e-6) << dimensions;
    }
  }
}

TEST(Maxwell, HasTheMeanAndThePeakOfTextbooks) {
  // The mean speed is sqrt(8 k T / (pi m)) in three dimensions and sqrt(pi k T / (2 m)) in two.
  // The most probable one is sqrt(2 k T / m) and sqrt(k T / m).
  EXPECT_NEAR(moment(1, 3, 2), 2 * sqrt(8 / std::numbers::pi), 1e-5);
  EXPECT_NEAR(moment(1, 2, 2), 2 * sqrt(std::numbers::pi / 2), 1e-5);
  for (const auto& [dimensions, peak] : {pair{3, 2 * sqrt(2.0)}, {2, 2.0}})
    for (const double beside : {0.99, 1.01})
      EXPECT_GT(maxwell_density(peak, dimensions, 2), maxwell_density(beside * peak, dimensions, 2)) << dimensions;
}

TEST(EnergyByDirection, CountsTheDirectionsOfMotionWhateverTheirAngle) {
  const Vec3 along = Vec3(1, 2, -0.5), across = Vec3(0.3, -1, 4);

  EnergyByDirection rest, line, plane, space;
  rest.add(2, Vec3::Zero());

  for (int i = 1; i <= 50; ++i) {
    const double a = std::sin(i), b = std::cos(3 * i);
    line.add(i, a * along);
    plane.add(i, a * along + b * across);
    space.add(i, a * along + b * across + 0.01 * std::sin(7 * i) * Vec3(1, 0, 0));
  }

  EXPECT_EQ(rest.dimensions(), 0);
  EXPECT_EQ(line.dimensions(), 1);
  EXPECT_EQ(plane.dimensions(), 2);
  EXPECT_EQ(space.dimensions(), 3);
}

TEST(EnergyByDirection, HoldsTheKineticEnergy) {
  EnergyByDirection energy;
  energy.add(2, Vec3(3, 0, 0));
  energy.add(4, Vec3(0, 1, 2));
  EXPECT_EQ(energy.kinetic(), 9 + 10);
}

}  // namespace
}  // namespace carom
