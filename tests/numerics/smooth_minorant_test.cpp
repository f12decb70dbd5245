// A smooth function below a given one.
#include "numerics/smooth_minorant.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

/// Steps and spikes of all heights.
vector<double> rough(size_t count) {
  vector<double> values;
  for (size_t i = 0; i < count; ++i) values.push_back(double(i * 7919 % 101) / 101 + (i % 37 < 12 ? 3 : 0));
  return values;
}

TEST(SmoothMinorant, IsNowhereAbove) {
  const vector<double> values = rough(400);
  for (const size_t half : {1u, 2u, 7u, 40u, 500u}) {
    const vector<double> smooth = smooth_minorant(values, half);
    ASSERT_EQ(smooth.size(), values.size());
    for (size_t i = 0; i < values.size(); ++i) EXPECT_LE(smooth[i], values[i] + 1e-12) << i;
  }
}

TEST(SmoothMinorant, ChangesByAtMostItsRangeOverTheWidth) {
  const vector<double> values = rough(400);
  for (const size_t half : {1u, 5u, 20u}) {
    const vector<double> smooth = smooth_minorant(values, half);
    for (size_t i = 1; i < smooth.size(); ++i)
      EXPECT_LE(std::abs(smooth[i] - smooth[i - 1]), 4.0 / double(2 * half + 1) + 1e-12);
  }
}

TEST(SmoothMinorant, OfAConstantIsTheConstantAndOfAGreatWidthTheLeast) {
  EXPECT_EQ(smooth_minorant(vector<double>(9, 0.1), 2), vector<double>(9, 0.1));
  EXPECT_EQ(smooth_minorant({5, 0.3, 4, 7}, 4), vector<double>(4, 0.3));
  EXPECT_TRUE(smooth_minorant({}, 3).empty());
}

TEST(SmoothMinorant, OfALineIsTheLineMovedByItsReach) {
  vector<double> line;
  for (int i = 0; i < 100; ++i) line.push_back(2.0 * i);
  const vector<double> smooth = smooth_minorant(line, 3);
  // The least value is that 9 places before.
  for (size_t i = 20; i < 80; ++i) EXPECT_NEAR(smooth[i], line[i] - 18, 1e-12);
}

}  // namespace
}  // namespace carom
