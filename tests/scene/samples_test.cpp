// Numbers drawn by the samplers of sweeps.
#include "scene/samples.h"

#include <gtest/gtest.h>

#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

using Numbers = vector<double>;

SampledRange range(const char* from, const char* to, bool log = false, bool whole = false) {
  return {parse_decimal(from).value(), parse_decimal(to).value(), log, whole};
}

vector<string> texts(const SampledRange& range, Sampling sampling, uint64_t count, uint64_t seed = 0) {
  Random random(seed, "samples");
  return samples(range, sampling, count, random);
}

Numbers numbers(const SampledRange& range, Sampling sampling, uint64_t count) {
  Numbers out;
  for (const string& text : texts(range, sampling, count)) out.push_back(parse_number(text).value());
  return out;
}

/// The greatest distance between the distribution of numbers in (0, 1) and the uniform one, times sqrt(n)
/// (Kolmogorov & Smirnov). It exceeds 1.63 in one of a hundred cases.
double unevenness(Numbers shares) {
  ranges::sort(shares);
  const auto n = static_cast<double>(shares.size());
  double most = 0;
  for (size_t i = 0; i < shares.size(); ++i) {
    const auto below = static_cast<double>(i);
    most = std::max({most, shares[i] - below / n, (below + 1) / n - shares[i]});
  }
  return most * sqrt(n);
}

// The numbers are those of the same formulas in Python, with fractions and the library's power.
TEST(Samples, AreTheSameOnEveryMachine) {
  EXPECT_EQ(texts(range("1", "5"), Sampling::random, 4), (vector<string>{"1.28548", "4.4338", "2.81109", "2.90748"}));
  EXPECT_EQ(texts(range("-0.1", "0.1"), Sampling::latin, 4),
            (vector<string>{"0.094056", "-0.035115", "0.04907", "-0.069614"}));
  EXPECT_EQ(texts(range("1e-3", "1e3", true), Sampling::random, 3), (vector<string>{"10.65", "0.11963", "0.022136"}));
  EXPECT_EQ(texts(range("1", "6", false, true), Sampling::random, 6), (vector<string>{"5", "2", "3", "4", "5", "3"}));
}

TEST(Samples, LieBetweenTheEndsWithSixOrSevenDigits) {
  for (const auto& one : {range("1", "5"), range("-0.1", "0.1"), range("0", "1"), range("0.3333333333", "0.5"),
                          range("-7e9", "3e9"), range("1000", "1000.002")}) {
    const double from = parse_number(to_text(one.from)).value(), to = parse_number(to_text(one.to)).value();
    for (const string& text : texts(one, Sampling::random, 2000)) {
      const double value = parse_number(text).value();
      EXPECT_TRUE(from < value && value < to) << text;
      // Places below the range's first digit: 10^5 to 10^6 numbers.
      const double width = to - from, unit = pow(10, floor(std::log10(width / 1e5 * (1 + 1e-9))));
      EXPECT_NEAR(value / unit, std::round(value / unit), 1e-3) << text;
    }
  }
}

TEST(Samples, AreUniformInTheRangeOrInItsLogarithm) {
  constexpr uint64_t count = 20'000;
  Numbers shares;
  for (const double value : numbers(range("1", "5"), Sampling::random, count)) shares.push_back((value - 1) / 4);
  EXPECT_LT(unevenness(shares), 1.63);
  double mean = 0, square = 0;
  for (const double share : shares) mean += share / count, square += share * share / count;
  // Standard errors: 1/sqrt(12 n) = 0.002, and sqrt(4/45 / n) = 0.0021.
  EXPECT_NEAR(mean, 0.5, 0.005);
  EXPECT_NEAR(square, 1.0 / 3, 0.005);
  shares.clear();
  for (const double value : numbers(range("0.001", "1000", true), Sampling::random, count))
    shares.push_back(std::log10(value) / 6 + 0.5);
  EXPECT_LT(unevenness(shares), 1.63);
}

TEST(Samples, MoreRandomOnesBeginWithThoseOfFewer) {
  const auto few = texts(range("1", "5"), Sampling::random, 10), many = texts(range("1", "5"), Sampling::random, 500);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_NE(texts(range("1", "5"), Sampling::random, 10, 1), few);
}

TEST(LatinHypercube, HasOneNumberInEachPartOfTheRange) {
  for (const int count : {1, 2, 7, 50, 1000}) {
    for (const auto& [from, to, log] : {std::tuple("1", "5", false),
                                        {"-0.1", "0.1", false},
                                        {"0.123456789", "0.2", false},
                                        {"0.001", "1000", true},
                                        {"1", "1.5", true},
                                        {"-3", "-1", false}}) {
      const double low = parse_number(from).value(), high = parse_number(to).value();
      set<int> parts;
      for (const double value : numbers(range(from, to, log), Sampling::latin, static_cast<uint64_t>(count))) {
        const double share = log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
        parts.insert(static_cast<int>(floor(share * count + 1e-9)));
      }

      EXPECT_EQ(parts.size(), static_cast<size_t>(count)) << from;
      EXPECT_EQ(*parts.begin(), 0);
      EXPECT_EQ(*parts.rbegin(), count - 1);
    }
  }
}

TEST(LatinHypercube, OfWholeNumbersHasEachEquallyOften) {
  for (const auto& [count, each] : {pair(100, 10), {10, 1}, {1000, 100}}) {
    const Numbers drawn = numbers(range("0", "9", false, true), Sampling::latin, static_cast<uint64_t>(count));
    for (int k = 0; k < 10; ++k) EXPECT_EQ(ranges::count(drawn, k), each) << k;
  }
}

TEST(LatinHypercube, PairsThePartsOfSeveralRangesAtRandom) {
  Random a(0, "samples 0 a"), b(0, "samples 0 b");
  Numbers of_a, of_b;
  for (const string& text : samples(range("0", "1"), Sampling::latin, 1000, a)) of_a.push_back(std::stod(text));
  for (const string& text : samples(range("0", "1"), Sampling::latin, 1000, b)) of_b.push_back(std::stod(text));
  double covariance = 0;
  for (size_t i = 0; i < 1000; ++i) covariance += (of_a[i] - 0.5) * (of_b[i] - 0.5) / 1000;
  // The correlation's standard error is 1/sqrt(1000) = 0.032.
  EXPECT_LT(std::abs(12 * covariance), 0.1);
}

TEST(Samples, OfWholeNumbersCanBeUniformInTheLogarithm) {
  const Numbers drawn = numbers(range("1", "1000", true, true), Sampling::random, 10'000);
  EXPECT_EQ(*ranges::min_element(drawn), 1);
  EXPECT_LE(*ranges::max_element(drawn), 1000);
  const auto ones = static_cast<double>(ranges::count(drawn, 1));
  // log(2)/log(1001) = 0.1003, with a standard error of 0.003.
  EXPECT_NEAR(ones / 10'000, log(2) / log(1001), 0.01);
}

TEST(Samples, ThatNeedMoreThanFifteenDigitsAreNone) {
  EXPECT_TRUE(texts(range("100000000000000001", "100000000000000002"), Sampling::random, 3).empty());
  EXPECT_TRUE(texts(range("0.000000000001", "100000000000"), Sampling::random, 3).empty());
  EXPECT_TRUE(texts(range("1", "1.000000000001", true), Sampling::random, 3).empty());
  EXPECT_FALSE(texts(range("0.000000000001", "100000000000", true), Sampling::random, 3).empty());
}

}  // namespace
}  // namespace carom
