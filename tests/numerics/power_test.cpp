// Powers, against values of mpmath (60 digits) and products of whole numbers.
#include "numerics/power.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

TEST(Power, IsExactForSmallWholeNumbers) {
  for (int base = -9; base <= 9; ++base) {
    double product = 1;
    for (int n = 0; n <= 12; ++n, product *= base) {
      EXPECT_EQ(power(base, n), product) << base << "^" << n;
      EXPECT_EQ(power(base, -n), base == 0 && n > 0 ? infinity : 1 / product) << base << "^-" << n;
    }
  }
  EXPECT_EQ(power(10, 22), 1e22);
  EXPECT_EQ(power(10, -3), 0.001);
  EXPECT_EQ(power(2, -1074), 5e-324);
  EXPECT_EQ(power(2, 0.5), sqrt(2.0));
}

TEST(Power, IsTheReference) {
  struct Row {
    double x, y, value;
  };

  const Row rows[] = {
      {1.1, 10, 2.5937424601000020943},
      {0.3, 2.7, 0.03874604582249406801},
      {2, 0.3333333333333333, 1.2599210498948731486},
      {1e-300, 0.51, 9.9999999999999387746e-154},
      {1e+300, -1.02, 9.9999999999998767581e-307},
      {0.9999, 12345.5, 0.29094770623608708263},
      {1.0000000000000002, 1000000000000.0, 1.0002220692586530281},
      {3.7, 200.25, 6.0589203650159277598e+113},
      {5e-324, 0.25, 1.4908919308538353892e-81},
      {123456.789, -0.125, 0.23097268761162055196},
      {7, -20, 1.2532542894196848998e-17},
  };

  for (const Row& row : rows)
    EXPECT_NEAR(power(row.x, row.y), row.value, 4 * 1.2e-16 * row.value) << row.x << "^" << row.y;
}

TEST(Power, HasTheLimitsOfDoubles) {
  EXPECT_EQ(power(0, 0), 1);
  EXPECT_EQ(power(0, 3), 0);
  EXPECT_EQ(power(0, -1), infinity);
  EXPECT_EQ(power(10, 400), infinity);
  EXPECT_EQ(power(-10, 401), -infinity);
  EXPECT_EQ(power(10, -400), 0);
  EXPECT_EQ(power(-1, 1e300), 1);
  EXPECT_EQ(power(2, 1e300), infinity);
  EXPECT_TRUE(std::isnan(power(-8, 1.0 / 3)));
}

}  // namespace
}  // namespace carom
