#include "numerics/cube_root.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

TEST(CubeRoot, IsExactForCubesOfIntegers) {
  for (int k = 1; k <= 1000; ++k) EXPECT_EQ(cube_root(static_cast<double>(k) * k * k), k);
}

TEST(CubeRoot, IsRightToAUnitInTheLastPlace) {
  double worst = 0;  // in units of rounding
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    const long double y = std::cbrt(static_cast<long double>(x));
    worst = std::max(worst, static_cast<double>(std::abs(cube_root(x) - y) / y) * 0x1p53);
  }
  EXPECT_LE(worst, 2);  // 1.3 measured
}

TEST(CubeRoot, ScalesByPowersOfEight) {
  for (double x = 0.5; x < 8; x += 0.01)
    for (const int k : {-300, -7, 1, 5, 300}) EXPECT_EQ(cube_root(std::ldexp(x, 3 * k)), std::ldexp(cube_root(x), k));
}

}  // namespace
}  // namespace carom
