// Angles in degrees, against exact values and against values of mpmath (60 digits).
#include "numerics/degrees.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

TEST(Degrees, HaveExactSinesWhereDoublesHoldThem) {
  for (int turn = -3; turn <= 3; ++turn) {
    const double full = 360.0 * turn;
    const double sines[] = {0, 0.5, 1, 0.5, 0, -0.5, -1, -0.5}, angles[] = {0, 30, 90, 150, 180, 210, 270, 330};
    for (int k = 0; k < 8; ++k) {
      EXPECT_EQ(sin_cos_degrees(full + angles[k]).sin, sines[k]) << full + angles[k];
      EXPECT_EQ(sin_cos_degrees(full + angles[k] - 90).cos, sines[k]) << full + angles[k];
    }
  }

  for (const double angle : {45.0, 225.0, -135.0}) {
    EXPECT_EQ(sin_cos_degrees(angle).sin, sin_cos_degrees(angle).cos) << angle;
  }

  EXPECT_FALSE(std::signbit(sin_cos_degrees(180).sin) || std::signbit(sin_cos_degrees(90).cos));
}

TEST(Degrees, AreTheReferences) {
  struct Row {
    double angle, sin, cos;
  };

  const Row rows[] = {
      {1, 0.017452406437283512819, 0.99984769515639123916},
      {1e-9, 1.7453292519943296856e-11, 1.0},
      {20, 0.34202014332566873304, 0.93969262078590838405},
      {44.5, 0.70090926429985090017, 0.71325044915418157514},
      {59.9999, 0.86602453111849358895, 0.50000151149870870104},
      {123.25, 0.83628615584775950731, -0.5482932295199138211},
      {1e15, -0.98480775301220805937, 0.17364817766693034885},
  };

  for (const Row& row : rows) {
    const SinCos of = sin_cos_degrees(row.angle);
    EXPECT_NEAR(of.sin, row.sin, 4e-16 * std::abs(row.sin)) << row.angle;
    EXPECT_NEAR(of.cos, row.cos, 4e-16 * std::abs(row.cos)) << row.angle;
  }
}

TEST(Degrees, ComeBackWholeFromTheirSineCosineAndTangent) {
  for (int angle = -90; angle <= 90; ++angle) EXPECT_EQ(arc_sine_degrees(sin_cos_degrees(angle).sin), angle);
  for (int angle = 0; angle <= 180; ++angle) EXPECT_EQ(arc_cosine_degrees(sin_cos_degrees(angle).cos), angle);
  for (int angle = -179; angle <= 180; ++angle) {
    const SinCos of = sin_cos_degrees(angle);
    for (const double scale : {1.0, 0x1p900, 0x1p-900})
      EXPECT_EQ(arc_tangent_degrees(scale * of.sin, scale * of.cos), angle);
  }

  EXPECT_NEAR(arc_sine_degrees(0.3), 17.457603123722091623, 1e-14);
  EXPECT_NEAR(arc_cosine_degrees(-0.3), 107.45760312372209162, 1e-13);
  EXPECT_NEAR(arc_tangent_degrees(-2, -7), -164.0546040990771452, 1e-13);
  EXPECT_EQ(arc_tangent_degrees(0, 0), 0);
  EXPECT_TRUE(std::isnan(arc_sine_degrees(1.0000000000000002)) && std::isnan(arc_cosine_degrees(-2)));
}

}  // namespace
}  // namespace carom
