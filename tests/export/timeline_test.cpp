#include "export/timeline.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

vector<double> times(const Ticks& ticks) {
  vector<double> all;
  for (int64_t i = ticks.first(); i <= ticks.last(); ++i) all.push_back(ticks.at(i));
  return all;
}

TEST(Ticks, ShortDecimalsCountExactly) {
  const Ticks ticks = Ticks::every(0.01, 10);
  EXPECT_EQ(ticks.at(7), 0.07);   // 7 * 0.01 is 0.07 + 1 ulp
  EXPECT_EQ(ticks.at(29), 0.29);  // 29 * 0.01 is 0.29 - 1 ulp
  EXPECT_EQ(ticks.at(57), 0.57);
  EXPECT_EQ(ticks.at(100), 1.0);
  EXPECT_EQ(Ticks::every(0.07, 10).at(3), 0.21);
  EXPECT_EQ(Ticks::every(1e-7, 10).at(3), 3e-7);
  EXPECT_EQ(Ticks::every(0.0333333, 10).at(3), 0.0999999);
}

TEST(Ticks, OneOverAWholeNumberCountsExactly) {
  const Ticks ticks = Ticks::every(1.0 / 30, 10);
  EXPECT_EQ(ticks.at(3), 0.1);  // 3 * (1.0 / 30) is 0.1, but
  EXPECT_EQ(ticks.at(30), 1.0);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(ticks.at(i), i / 30.0) << i;
  EXPECT_EQ(Ticks::every(1.0 / 7, 10).at(21), 3.0);
}

TEST(Ticks, AnyOtherIntervalIsMultipliedNotSummed) {
  const double interval = sqrt(2) / 100;
  const Ticks ticks = Ticks::every(interval, 1e4);
  EXPECT_EQ(ticks.at(100'000), 100'000 * interval);
}

TEST(Ticks, NothingDriftsInAMillionSteps) {
  const Ticks ticks = Ticks::every(0.001, 1e6);
  for (int64_t second = 0; second < 1'000'000; second += 997)
    EXPECT_EQ(ticks.at(second * 1000), static_cast<double>(second));
}

TEST(Ticks, TheLastOneIsTheDurationAndNoneIsBesideIt) {
  EXPECT_EQ(times(Ticks::every(0.5, 2)), (vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(times(Ticks::every(0.6, 2)), (vector<double>{0, 0.6, 1.2, 1.8, 2}));
  EXPECT_EQ(times(Ticks::every(5, 2)), (vector<double>{0, 2}));
  EXPECT_EQ(times(Ticks::every(2, 2)), (vector<double>{0, 2}));
  // 3 * 0.1 is above 0.3, and 0.3 - 1 ulp is the same instant to an author.
  EXPECT_EQ(Ticks::every(0.1, 0.3).count(), 4);
  EXPECT_EQ(Ticks::every(0.1, std::nextafter(0.3, 0)).count(), 4);
  EXPECT_EQ(Ticks::every(0.1, std::nextafter(0.3, 1)).count(), 4);
  EXPECT_EQ(Ticks::every(0.1, std::nextafter(0.3, 1)).at(3), std::nextafter(0.3, 1));
  EXPECT_EQ(Ticks::every(0.01, 2).count(), 201);
  EXPECT_EQ(Ticks::every(1.0 / 30, 2).count(), 61);
  EXPECT_EQ(Ticks::every(1.0 / 3, 1e6).count(), 3'000'001);
  const double odd = sqrt(2) / 100;
  EXPECT_EQ(Ticks::every(odd, 1000 * odd).count(), 1001);
  EXPECT_EQ(Ticks::every(odd, std::nextafter(1000 * odd, 100)).count(), 1001);
}

TEST(Ticks, EveryCountOfDecimalStepsIsRight) {
  for (int n = 1; n <= 2000; ++n) {
    const Ticks ticks = Ticks::every(0.01, n / 100.0);
    ASSERT_EQ(ticks.count(), n + 1) << n;
    ASSERT_LT(ticks.at(n - 1), ticks.at(n)) << n;
  }
}

TEST(Ticks, NoDurationIsOneTickAtZero) {
  EXPECT_EQ(times(Ticks::every(0.1, 0)), (vector<double>{0}));
}

TEST(Ticks, HugeCountsNeitherLoopNorOverflow) {
  EXPECT_GT(Ticks::every(1e-300, 1e300).count(), int64_t{1} << 52);
  EXPECT_EQ(Ticks::every(1e-300, 1e300).at(Ticks::every(1e-300, 1e300).last()), 1e300);
  EXPECT_GT(Ticks::rate(1e300, 0, 1e300).count(), int64_t{1} << 52);
  EXPECT_GT(Ticks::film(1e300, 1e-6, 0, 1e300).count(), int64_t{1} << 52);
  EXPECT_EQ(Ticks::every(1e300, 1).count(), 2);
  EXPECT_EQ(Ticks::every(5e-324, 1e-323).count(), 3);
}

TEST(Ticks, SenselessIntervalsAreRefused) {
  EXPECT_THROW(Ticks::every(0, 1), std::invalid_argument);
  EXPECT_THROW(Ticks::every(-1, 1), std::invalid_argument);
  EXPECT_THROW(Ticks::every(std::nan(""), 1), std::invalid_argument);
  EXPECT_THROW(Ticks::every(1, infinity), std::invalid_argument);
  EXPECT_THROW(Ticks::rate(0, 0, 1), std::invalid_argument);
  EXPECT_THROW(Ticks::film(0, 1, 0, 1), std::invalid_argument);
  EXPECT_THROW(Ticks::film(1, 0, 0, 1), std::invalid_argument);
}

TEST(Ticks, FrameIStandsAtIOverFps) {
  const Ticks ticks = Ticks::rate(30, 0, 2);
  EXPECT_EQ(ticks.first(), 0);
  EXPECT_EQ(ticks.last(), 60);
  for (int i = 0; i <= 60; ++i) EXPECT_EQ(ticks.at(i), i / 30.0);
  EXPECT_EQ(Ticks::rate(29.97, 0, 10).at(100), 100 / 29.97);
}

TEST(Ticks, AFilmsPictureIStandsAtFromPlusITimesSpeedOverFps) {
  const Ticks slow = Ticks::film(30, 0.125, 0.4, 2);
  EXPECT_EQ(slow.first(), 0);
  EXPECT_EQ(slow.last(), 384);
  // 0.4 + i / 240 in one rounding: (96 + i) / 240.
  for (int i = 0; i <= 384; ++i) EXPECT_EQ(slow.at(i), (96 + i) / 240.0) << i;
  const Ticks lapse = Ticks::film(25, 10, 0.1, 1e6);
  for (int i = 0; i <= 1000; ++i) EXPECT_EQ(lapse.at(i), (1 + 4 * i) / 10.0) << i;
  EXPECT_EQ(Ticks::film(30, 1.0 / 3, 0, 1).at(45), 0.5);
  EXPECT_EQ(times(Ticks::film(10, 1, 0.13, 0.34)), (vector<double>{0.13, 0.23, 0.33}));
  EXPECT_EQ(times(Ticks::film(10, 0.5, 2, 2)), (vector<double>{2}));
  EXPECT_EQ(Ticks::film(10, 0.5, 2, 1).count(), 0);
}

TEST(Ticks, AFilmInRealTimeHasTheInstantsOfFrames) {
  for (const double fps : {24.0, 29.97, 30.0, 60.0}) {
    EXPECT_TRUE(Ticks::film(fps, 1, 0, 3).has_times_of(Ticks::rate(fps, 0, 3))) << fps;
    EXPECT_FALSE(Ticks::film(fps, 0.5, 0, 3).has_times_of(Ticks::rate(fps, 0, 3))) << fps;
    EXPECT_FALSE(Ticks::film(fps, 1, 0, 2).has_times_of(Ticks::rate(fps, 0, 3))) << fps;
  }
  EXPECT_TRUE(Ticks::film(30, 1, 0.4, 3).has_times_of(Ticks::rate(30, 0.4, 3)));
  EXPECT_FALSE(Ticks::film(30, 1, 0.41, 3).has_times_of(Ticks::rate(30, 0.41, 3)));
}

TEST(Ticks, FramesLieWithinFromAndUntilEndsIncluded) {
  const Ticks ticks = Ticks::rate(30, 0.1, 0.7);  // 0.1 * 30 and 0.7 * 30 are no whole numbers in doubles
  EXPECT_EQ(ticks.first(), 3);
  EXPECT_EQ(ticks.last(), 21);
  EXPECT_EQ(Ticks::rate(30, 0.11, 0.69).first(), 4);
  EXPECT_EQ(Ticks::rate(30, 0.11, 0.69).last(), 20);

  EXPECT_EQ(Ticks::rate(10, 5, 5).count(), 1);
  EXPECT_EQ(Ticks::rate(10, 0.01, 0.09).count(), 0);
  EXPECT_EQ(Ticks::rate(10, 5, 4).count(), 0);
  EXPECT_EQ(Ticks::rate(10, -5, 0.2).first(), 0);
  EXPECT_EQ(Ticks::rate(10, -5, -1).count(), 0);

  for (const double fps : {24.0, 25.0, 29.97, 30.0, 59.94, 60.0, 120.0})
    for (int i = 0; i < 3000; i += 7) {
      const Ticks one = Ticks::rate(fps, i / fps, i / fps);
      ASSERT_EQ(one.first(), i) << fps;
      ASSERT_EQ(one.last(), i) << fps;
    }
}

TEST(Ticks, EvenOnesIncludeBothEnds) {
  EXPECT_EQ(times(Ticks::even(5, 0, 2)), (vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(times(Ticks::even(12, 0, 0.7)).back(), 0.7);
  EXPECT_EQ(times(Ticks::even(1, 0, 2)), (vector<double>{2}));
  EXPECT_EQ(Ticks::even(0, 0, 2).count(), 0);
  EXPECT_EQ(times(Ticks::even(3, 0.5, 1.5)), (vector<double>{0.5, 1, 1.5}));
  EXPECT_EQ(times(Ticks::even(1, 0.5, 1.5)), (vector<double>{1.5}));
}

TEST(Ticks, AreWrittenWithAllTheirDecimalsOrToATwentiethOfTheirInterval) {
  EXPECT_EQ(Ticks::rate(1, 0, 9).decimals(), 0);
  EXPECT_EQ(Ticks::rate(25, 0, 9).decimals(), 2);
  EXPECT_EQ(Ticks::rate(40, 0, 9).decimals(), 3);
  EXPECT_EQ(Ticks::rate(30, 0, 9).decimals(), 3);   // 0.0333... s
  EXPECT_EQ(Ticks::rate(240, 0, 9).decimals(), 4);  // 0.0041666... s
  EXPECT_EQ(Ticks::rate(30, 0.5, 0.5).decimals(), 1);

  EXPECT_EQ(Ticks::even(1, 0.12345678, 0.12345678).decimals(), 6);
  EXPECT_EQ(Ticks::even(12, 0, 2.8).decimals(), 2);  // 0.2545... s
  EXPECT_EQ(Ticks::even(5, 0, 2).decimals(), 1);

  EXPECT_EQ(Ticks::film(25, 0.125, 0.5, 2).decimals(), 3);  // 0.005 s
  EXPECT_EQ(Ticks::film(30, 0.1, 0, 2).decimals(), 4);      // 0.00333... s

  for (const double fps : {24.0, 30.0, 60.0, 240.0, 144.0}) {
    const Ticks ticks = Ticks::rate(fps, 0, 3);
    const double unit = pow(10, -ticks.decimals());
    EXPECT_LE(0.5 * unit, 0.05 / fps) << fps;
  }
}

TEST(Ticks, OfAFilmThatSlowsDownFollowItsClock) {
  const Slowdown slow{1.5, 3};
  const FilmClock clock(0.5, 0.25, slow);
  const Ticks ticks = Ticks::film(30, 0.5, 0.25, 4, slow);
  // The film's length in closed form, with n = 2^k: 0.5 s (k + 2 - 2/n - (1 - 1/n) / ln 2) more.
  const double length = 3.75 / 0.5 + 0.5 * (5 - 0.25 - 0.875 / std::log(2.0));
  EXPECT_EQ(ticks.count(), int64_t(std::floor(30 * length)) + 1);
  EXPECT_EQ(ticks.at(0), 0.25);

  for (int64_t i = 0; i <= ticks.last(); ++i) {
    EXPECT_EQ(ticks.at(i), clock.shown((15 + double(i)) / 60));
    EXPECT_LE(ticks.at(i), 4);
    EXPECT_GT(ticks.at(i + 1), ticks.at(i));
  }
  EXPECT_GT(clock.shown(0.25 + double(ticks.last() + 1) / 60), 4);
  EXPECT_EQ(ticks.decimals(), 4);  // 1/480 s at the slowest

  Ticks cut = ticks;
  cut.cut(2);
  EXPECT_LE(cut.at(cut.last()), 2);
  EXPECT_GT(ticks.at(cut.last() + 1), 2);
  EXPECT_FALSE(ticks.has_times_of(ticks));  // those of frames are even
}

TEST(Timeline, KnowsTheNextTickOfAStream) {
  Timeline timeline(0.5);
  const int a = timeline.add(Ticks::rate(10, 0.1, 0.3));
  EXPECT_EQ(timeline.next(a), 0.1);
  vector<double> next;
  while (timeline.advance()) next.push_back(timeline.next(a).value_or(-1));
  EXPECT_EQ(next, (vector<double>{0.1, 0.2, 0.3, -1}));
}

TEST(Timeline, WithoutOutputsItStillEndsAtTheDuration) {
  Timeline timeline(3);
  EXPECT_TRUE(timeline.advance());
  EXPECT_EQ(timeline.time(), 3);
  EXPECT_FALSE(timeline.advance());
  EXPECT_FALSE(timeline.advance());
}

TEST(Timeline, MergesStreamsInOrderAndJoinsEqualInstants) {
  Timeline timeline(0.5);
  const int a = timeline.add(Ticks::every(0.2, 0.5));     // 0 0.2 0.4 0.5
  const int b = timeline.add(Ticks::rate(10, 0.1, 0.4));  // 0.1 0.2 0.3 0.4: ticks 1 .. 4

  struct Step {
    double time;
    int64_t a, b;  // -1: not due
    bool operator==(const Step&) const = default;
  };

  vector<Step> steps;
  EXPECT_FALSE(timeline.due(a));
  while (timeline.advance())
    steps.push_back({timeline.time(), timeline.due(a).value_or(-1), timeline.due(b).value_or(-1)});

  const vector<Step> expected = {{0, 0, -1}, {0.1, -1, 1}, {0.2, 1, 2}, {0.3, -1, 3}, {0.4, 2, 4}, {0.5, 3, -1}};
  EXPECT_TRUE(steps == expected);
  EXPECT_FALSE(timeline.due(a));
}

TEST(Timeline, DecimalAndRateTicksMeetBitForBit) {
  Timeline timeline(10);
  timeline.add(Ticks::every(0.1, 10));
  timeline.add(Ticks::rate(30, 0, 10));
  timeline.add(Ticks::every(1.0 / 60, 10));
  int instants = 0;
  while (timeline.advance()) ++instants;
  EXPECT_EQ(instants, 601);  // all of them are sixtieths
}

TEST(Timeline, TicksAfterTheDurationAreNeverDue) {
  Timeline timeline(1);
  const int stream = timeline.add(Ticks::rate(10, 0.9, 5));
  vector<int64_t> due;
  double last = 0;
  while (timeline.advance()) {
    if (const auto i = timeline.due(stream)) due.push_back(*i);
    last = timeline.time();
  }
  EXPECT_EQ(due, (vector<int64_t>{9, 10}));
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace carom
