// The time that a run still takes, from its phases.
#include "commands/run_pace.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

using Phase = RunProgress::Phase;

TEST(RunPace, EstimatesNothingInTheFirstThreeSecondsOfAPhase) {
  RunPace pace({.duration = 10, .pictures = 100, .draw_s = 5, .draws_after = true});
  pace.note(0, {Phase::simulating, 0});
  pace.note(2.9, {Phase::simulating, 2.9});
  EXPECT_TRUE(std::isnan(pace.left()));
  pace.note(3, {Phase::simulating, 3});
  EXPECT_NEAR(pace.left(), 7 + 5, 1e-12);
  pace.note(10, {Phase::drawing, 10});
  EXPECT_TRUE(std::isnan(pace.left()));
  pace.note(12, {Phase::drawing, 10, 0, 10});
  EXPECT_TRUE(std::isnan(pace.left()));
  pace.note(14, {Phase::drawing, 10, 0, 20});
  EXPECT_NEAR(pace.left(), 16, 1e-12);
}

TEST(RunPace, OfDrawingBesideTheSimulationIsThatOfTheSlower) {
  RunPace pace({.duration = 10, .pictures = 100});
  pace.note(0, {Phase::simulating, 0});
  pace.note(4, {Phase::simulating, 5, 0, 10});
  EXPECT_NEAR(pace.left(), 36, 1e-12);
  EXPECT_NEAR(pace.share(), 0.1, 1e-12);
}

TEST(RunPace, GoesByTheLastThirdOfThePhase) {
  RunPace pace({.duration = 100});
  for (int s = 0; s <= 30; ++s) pace.note(s, {Phase::simulating, s <= 15 ? 2.0 * s : 30 + (s - 15.0)});
  EXPECT_NEAR(pace.left(), 55, 1e-12);
}

TEST(RunPace, ItsShareNeverFallsAndEndsWithOne) {
  RunPace pace({.duration = 10, .pictures = 10, .draw_s = 1, .draws_after = true});
  double last = 0;
  const auto note = [&](double elapsed, const RunProgress& progress) {
    pace.note(elapsed, progress);
    EXPECT_GE(pace.share(), last);
    last = pace.share();
  };

  note(1, {Phase::simulating, 5});
  note(9, {Phase::simulating, 10});
  EXPECT_NEAR(last, 0.9, 1e-12);

  note(9, {Phase::drawing, 10, 0, 1});
  EXPECT_LT(last, 1);

  note(30, {Phase::drawing, 10, 0, 2});
  note(31, {Phase::writing, 10, 0, 10});
  EXPECT_EQ(last, 1);
}

TEST(RunPace, NamesThePhase) {
  RunPace after({.duration = 3, .pictures = 91, .draws_after = true});
  after.note(0, {Phase::settling});
  EXPECT_EQ(after.text(), "finding the steps for the tolerance");
  after.note(1, {Phase::simulating, 0.41, 1200});
  EXPECT_EQ(after.text(), "simulating 0.41 of 3 s, 1,200 collisions");
  after.note(2, {Phase::drawing, 3, 5000, 23});
  EXPECT_EQ(after.text(), "drawing 23 of 91");
  after.note(3, {Phase::writing, 3, 5000, 91});
  EXPECT_EQ(after.text(), "writing files");
  RunPace beside({.duration = 3, .pictures = 91});
  beside.note(1, {Phase::simulating, 0.41, 1, 12});
  EXPECT_EQ(beside.text(), "simulating 0.41 of 3 s, drawing 12 of 91, 1 collision");
}

}  // namespace
}  // namespace carom
