// Evenly spaced numbers as decimals.
#include "yaml/decimal.h"
#include "std.h"

#include <gtest/gtest.h>

#include <charconv>

namespace carom {
namespace {

using Texts = vector<string>;

Decimal decimal(const string& text) {
  return parse_decimal(text).value();
}

Texts spread_of(const string& from, const string& to, uint64_t count) {
  return spread(decimal(from), decimal(to), count);
}

Texts steps_of(const string& from, const string& to, const string& step) {
  return steps(decimal(from), decimal(to), decimal(step), 1000);
}

TEST(Decimal, ReadsWhatYamlWritesAndGivesTheShortestText) {
  EXPECT_EQ(to_text(decimal("0.70")), "0.7");
  EXPECT_EQ(to_text(decimal("-12")), "-12");
  EXPECT_EQ(to_text(decimal("1.50e2")), "150");
  EXPECT_EQ(to_text(decimal("2.5e-3")), "0.0025");
  EXPECT_EQ(to_text(decimal("+.5")), "0.5");
  EXPECT_EQ(to_text(decimal("-0.0")), "0");
  EXPECT_EQ(to_text(decimal("0e99999999999")), "0");
}

TEST(Decimal, EndsFarApartDoNotOverflow) {
  const Texts all = spread_of("1e-18", "1e17", 2000);
  ASSERT_EQ(all.size(), 2000u);
  EXPECT_EQ(all.front(), "0.000000000000000001");
  EXPECT_EQ(all.back(), "100000000000000000");
  double before = 0;
  for (size_t i = 1; i < all.size(); ++i) {
    const double value = std::stod(all[i]);
    EXPECT_GT(value, before) << i;
    EXPECT_NEAR(value / 1e17, static_cast<double>(i) / 1999, 1e-15) << i;
    before = value;
  }
}

TEST(Decimal, HasAtMostEighteenDigits) {
  EXPECT_TRUE(parse_decimal("123456789.123456789"));
  EXPECT_FALSE(parse_decimal("123456789.1234567891"));
  EXPECT_FALSE(parse_decimal("1e18"));
  EXPECT_FALSE(parse_decimal("1e-19"));
  EXPECT_FALSE(parse_decimal("red"));
}

TEST(Spread, HasNoRoundingOfSums) {
  EXPECT_EQ(spread_of("0.5", "1.0", 6), (Texts{"0.5", "0.6", "0.7", "0.8", "0.9", "1"}));
  EXPECT_EQ(spread_of("-0.025", "0.075", 3), (Texts{"-0.025", "0.025", "0.075"}));
  EXPECT_EQ(spread_of("1", "-1", 5), (Texts{"1", "0.5", "0", "-0.5", "-1"}));
  EXPECT_EQ(spread_of("0", "1e-3", 5), (Texts{"0", "0.00025", "0.0005", "0.00075", "0.001"}));
  EXPECT_EQ(spread_of("2", "2", 1), (Texts{"2"}));
}

TEST(Spread, EveryHundredthIsTheDecimalThatIsWritten) {
  const Texts all = spread_of("0", "10", 1001);
  for (int i = 0; i <= 1000; ++i) {
    double value = 0;
    std::from_chars(all[static_cast<size_t>(i)].data(),
                    all[static_cast<size_t>(i)].data() + all[static_cast<size_t>(i)].size(), value);
    EXPECT_EQ(value, i / 100.0) << all[static_cast<size_t>(i)];
    EXPECT_LE(all[static_cast<size_t>(i)].size(), 4u);
  }
}

TEST(Spread, WithoutAFiniteExpansionIsTheNearestDouble) {
  EXPECT_EQ(spread_of("0", "1", 4), (Texts{"0", "0.3333333333333333", "0.6666666666666666", "1"}));
}

// A quotient of whole numbers that doubles hold is the nearest double by IEEE 754.
TEST(Spread, IsTheNearestDoubleOfEveryQuotient) {
  for (const int64_t last : {3, 7, 11, 999, 4'001, 8'191})
    for (const int64_t to : {1, -2, 10, 999'983, -123'456'789}) {
      const Texts all = spread_of("0", std::to_string(to), static_cast<uint64_t>(last) + 1);
      for (int64_t i = 0; i <= last; ++i)
        ASSERT_EQ(std::stod(all[static_cast<size_t>(i)]), static_cast<double>(to * i) / static_cast<double>(last))
            << to << " * " << i << " / " << last;
    }
}

TEST(Steps, GoAsFarAsTheEndAndNotBeyond) {
  EXPECT_EQ(steps_of("0", "1", "0.3"), (Texts{"0", "0.3", "0.6", "0.9"}));
  EXPECT_EQ(steps_of("0.1", "0.3", "0.1"), (Texts{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(steps_of("1", "0", "-0.5"), (Texts{"1", "0.5", "0"}));
  EXPECT_EQ(steps_of("1", "1", "0.5"), (Texts{"1"}));
  EXPECT_TRUE(steps_of("0", "1", "-0.3").empty());
  EXPECT_TRUE(steps_of("0", "1", "0").empty());
}

}  // namespace
}  // namespace carom
