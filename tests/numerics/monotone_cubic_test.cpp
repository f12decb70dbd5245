#include "numerics/monotone_cubic.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(MonotoneCubic, BetweenTwoPointsIsASmoothStep) {
  const MonotoneCubic curve({1, 3}, {10, 20});
  for (const double s : {0.0, 0.25, 0.5, 1.0}) EXPECT_NEAR(curve(1 + 2 * s), 10 + 10 * s * s * (3 - 2 * s), 1e-13);
  EXPECT_EQ(curve(0), 10);
  EXPECT_EQ(curve(4), 20);
}

TEST(MonotoneCubic, PassesThroughEqualStepsInAStraightLineInside) {
  // Equal chords give their own slope at inner points.
  const MonotoneCubic curve({0, 1, 2, 3}, {0, 2, 4, 6});
  EXPECT_DOUBLE_EQ(curve(1.5), 3);
  EXPECT_DOUBLE_EQ(curve(1.25), 2.5);
}

TEST(MonotoneCubic, SlopesAtAPointAgreeOnBothSides) {
  const MonotoneCubic curve({0, 1, 1.5, 4, 5}, {0, 3, 3.5, -2, -2});
  const double h = 1e-6;
  for (const double at : {0.0, 1.0, 1.5, 4.0, 5.0}) {
    const double before = (curve(at) - curve(at - h)) / h, after = (curve(at + h) - curve(at)) / h;
    EXPECT_NEAR(before, after, 1e-4) << at;
  }
}

// A cubic spline of continuous curvature through these points rises to 1.1.
TEST(MonotoneCubic, NeverLeavesTheRangeOfTwoPoints) {
  const MonotoneCubic curve({0, 1, 2, 3, 4}, {0, 0, 1, 1, 1});
  for (double t = -1; t < 5; t += 0.001) {
    EXPECT_GE(curve(t), 0);
    EXPECT_LE(curve(t), 1);
  }
  double before = 0;
  for (double t = 0; t < 4; t += 0.001) {
    EXPECT_GE(curve(t), before);
    before = curve(t);
  }
}

TEST(MonotoneCubic, PiecesAreTheCurve) {
  const MonotoneCubic curve({0, 1, 1.5, 4}, {0, 3, 3.5, -2});
  const array<double, 4> c = curve.piece(2);
  for (const double s : {0.1, 0.5, 0.9})
    EXPECT_NEAR(c[0] + s * (c[1] + s * (c[2] + s * c[3])), curve(1.5 + 2.5 * s), 1e-14);
}

}  // namespace
}  // namespace carom
