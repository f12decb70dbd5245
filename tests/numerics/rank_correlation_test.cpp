// Ranks by hand, and what no increasing change of scale may change.
#include "numerics/rank_correlation.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom::testing {
namespace {

TEST(RankCorrelation, IsOneForWhatRisesAndMinusOneForWhatFalls) {
  const vector<double> x = {-3, 0.5, 2, 1e9}, rising = {1e-300, 2e-300, 3, 4};
  vector<double> falling = rising;
  ranges::reverse(falling);
  EXPECT_DOUBLE_EQ(rank_correlation(x, rising), 1);
  EXPECT_DOUBLE_EQ(rank_correlation(x, falling), -1);
}

TEST(RankCorrelation, GivesEqualValuesTheMeanOfTheirRanks) {
  // Ranks 1, 2.5, 2.5, 4 and 1, 3, 2, 4: 4.5 / sqrt(4.5 * 5).
  EXPECT_NEAR(rank_correlation(vector<double>{1, 2, 2, 3}, vector<double>{1, 3, 2, 4}), 4.5 / sqrt(22.5), 1e-15);
}

TEST(RankCorrelation, IsUndefinedWithoutTwoDifferentValues) {
  const double nan = numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(rank_correlation({}, {})));
  EXPECT_TRUE(std::isnan(rank_correlation(vector<double>{1, 2}, vector<double>{3, 3})));
  EXPECT_TRUE(std::isnan(rank_correlation(vector<double>{1, 2, 3}, vector<double>{nan, 1, nan})));
}

TEST(RankCorrelation, IsThatOfThePairsWithTwoNumbersInAnyOrderAndScale) {
  const double nan = numeric_limits<double>::quiet_NaN();
  vector<double> x = {5, 1, nan, 4, 2, 8}, y = {2, 7, 0, 1, infinity, 3};
  const double whole = rank_correlation(x, y);
  EXPECT_EQ(whole, rank_correlation(vector<double>{5, 1, 4, 8}, vector<double>{2, 7, 1, 3}));
  EXPECT_EQ(whole, rank_correlation(vector<double>{8, 4, 1, 5}, vector<double>{3, 1, 7, 2}));
  for (double& value : x) value = std::exp(value);
  EXPECT_EQ(whole, rank_correlation(x, y));
}

}  // namespace
}  // namespace carom::testing
