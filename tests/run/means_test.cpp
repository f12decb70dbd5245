// Means over time and windows of measures, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "run/measured.h"
#include "std.h"

namespace carom::testing {
namespace {

/// A ball of 2 kg on the floor that leaves it at 5 m/s and bounces each second.
string bouncing(double duration, const string& more = "") {
  return fmt::format(
      "scene: 1\ngravity: [0, -10, 0]\nlet: {{t: 1.5}}\n"
      "balls: {{b: {{mass: 2, radius: 0.1, position: [0, 0.1, 0], velocity: [0, 5, 0]}}}}\n"
      "planes: {{floor: {{point: [0, 0, 0], normal: [0, 1, 0]}}}}\nsimulate: {{duration: {}{}}}",
      duration, more);
}

TEST(Means, OfABouncingBallAreThoseOfItsParabolas) {
  const auto all =
      measured(bouncing(4), {"mean(balls.b.y_m)", "mean(balls.b.vy_m_per_s)", "mean(balls.b.speed_m_per_s)",
                             "mean(balls.b.kinetic_J)", "mean(balls.b.x_m)", "mean(y_m)"});
  EXPECT_NEAR(all[0], 0.1 + 25 / 30.0, 1e-13);
  EXPECT_NEAR(all[1], 0, 1e-13);
  EXPECT_NEAR(all[2], 2.5, 1e-13);
  EXPECT_NEAR(all[3], 2 * 25 / 6.0, 1e-12);
  EXPECT_EQ(all[4], 0);
  EXPECT_EQ(all[5], all[0]);
}

TEST(Means, TakeWindows) {
  // From 0.25 to 0.5 s it rises from 0.9375 to 1.25 m above the floor, more slowly.
  const auto all = measured(
      bouncing(4), {"mean(balls.b.y_m, from: 0.25, until: 0.5)", "mean(balls.b.vy_m_per_s, from: 0.25, until: 0.5)",
                    "mean(balls.b.speed_m_per_s, from: 0.25, until: 0.75)", "mean(balls.b.y_m, from: 3)",
                    "mean(balls.b.y_m, from: let.t, until: 2.5)"});
  EXPECT_NEAR(all[0], 0.1 + (2.5 * (0.25 - 0.0625) - 5 * (0.125 - 0.015625) / 3) / 0.25, 1e-13);
  EXPECT_NEAR(all[1], 1.25, 1e-13);
  EXPECT_NEAR(all[2], 1.25, 1e-13);
  EXPECT_NEAR(all[3], 0.1 + 25 / 30.0, 1e-13);
  EXPECT_NEAR(all[4], 0.1 + 25 / 30.0, 1e-13);
}

TEST(Means, OfTheSpeedAlongACurvedParabolaAreInClosedForm) {
  // |v| = sqrt(9 + u^2) with u from 5 down to -5 at 10 m/s^2.
  const string yaml =
      "scene: 1\ngravity: [0, -10, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [0, 9, 0], velocity: [3, 5, 0]}}\n"
      "simulate: {duration: 1}";
  const double root = sqrt(34.0);
  EXPECT_NEAR(value_of("mean(balls.b.speed_m_per_s)", yaml), (5 * root + 9 * std::asinh(5 / 3.0)) / 10, 1e-14);
  // Almost straight up: the speed has a sharp turn.
  const string steep =
      "scene: 1\ngravity: [0, -10, 0]\n"
      "balls: {b: {mass: 2, radius: 0.1, position: [0, 9, 0], velocity: [1.0e-7, 5, 0]}}\nsimulate: {duration: 1}";
  EXPECT_NEAR(value_of("mean(balls.b.speed_m_per_s)", steep), (5 * sqrt(25 + 1e-14) + 1e-14 * std::asinh(5e7)) / 10,
              0x1p-45);
}

TEST(Means, OnPathsThatForcesBendAreInClosedForm) {
  // Linear drag: v = v0 exp(-c t).
  const string drag =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [1, 0, 0], velocity: [3, 0, 0]}}\n"
      "forces: [{drag: {linear: 4}}]\nsimulate: {duration: 1.5}";
  const double c = 2, t = 1.5, fall = 1 - exp(-c * t);
  const auto of_drag = measured(drag, {"mean(balls.b.x_m)", "mean(balls.b.speed_m_per_s)", "mean(balls.b.kinetic_J)"});
  EXPECT_NEAR(of_drag[0], 1 + 3 / c - 3 * fall / (c * c * t), 1e-13);
  EXPECT_NEAR(of_drag[1], 3 * fall / (c * t), 1e-13);
  EXPECT_NEAR(of_drag[2], 9 * (1 - exp(-2 * c * t)) / (2 * c * t), 1e-13);

  // A spring: x = cos(3 t), whatever engine follows it.
  const string spring =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [1, 0, 0]}}\n"
      "forces: [{spring: {anchor: [0, 0, 0], stiffness: 18}}]\n";
  for (const char* engine : {"auto", "stepped"}) {
    const auto all = measured(spring + fmt::format("simulate: {{duration: 2, engine: {}}}", engine),
                              {"mean(balls.b.x_m)", "mean(balls.b.kinetic_J)", "mean(balls.b.speed_m_per_s)",
                               "mean(balls.b.vx_m_per_s, from: 0.5, until: 0.75)"});
    EXPECT_NEAR(all[0], sin(6.0) / 6, 1e-12) << engine;
    EXPECT_NEAR(all[1], 9 * (0.5 - sin(12.0) / 24), 1e-11) << engine;
    // Turns at pi / 3 back and forth: 1 to -1, and then up to cos(6).
    EXPECT_NEAR(all[2], (2 + 1 + cos(6.0)) / 2, 1e-12) << engine;
    EXPECT_NEAR(all[3], (cos(2.25) - cos(1.5)) / 0.25, 1e-11) << engine;
  }
}

TEST(Means, OfSeveralBodiesAreThoseOfAllOfThemAsLongAsTheyAreThere) {
  // One of them is removed after 1 s.
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\nballs:\n"
      "  a: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [1, 0, 0]}\n"
      "  b: {mass: 1, radius: 0.1, position: [0, 3, 0], velocity: [4, 0, 0]}\n"
      "regions: {away: {plane: {point: [4, 0, 0], normal: [1, 0, 0]}, action: remove, on: [b]}}\n"
      "simulate: {duration: 3}";
  const auto all = measured(yaml, {"mean(speed_m_per_s)", "mean(balls.b.x_m)", "mean(balls.b.x_m, from: 2)"});
  EXPECT_NEAR(all[0], (3 * 1 + 1 * 4) / 4.0, 1e-13);
  EXPECT_NEAR(all[1], 2, 1e-13);
  EXPECT_TRUE(std::isnan(all[2]));
}

TEST(Means, OfTheBooksEngineAreThoseOfItsFrames) {
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {b: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [3, 0, 0]}}\n"
      "simulate: {duration: 0.99, engine: book, step: 0.1}";
  const auto all = measured(
      yaml, {"mean(balls.b.x_m)", "mean(balls.b.x_m, from: 0.25, until: 0.55)", "max(balls.b.x_m, until: 0.55)"});
  EXPECT_NEAR(all[0], 3 * 0.99 / 2, 1e-13);
  EXPECT_NEAR(all[1], 3 * 0.4, 1e-13);
  EXPECT_NEAR(all[2], 3 * 0.5, 1e-13);
}

TEST(Windows, ThatBeginOrEndAtAnImpactHaveItsInstant) {
  // It moves at 3 m/s along x and falls from 5 m: it lands at 1 s to the bit. Doubles beside that have the same values.
  const string thrown =
      "scene: 1\ngravity: [0, -10, 0]\n"
      "balls: {b: {mass: 2, radius: 0.5, position: [0, 5.5, 0], velocity: [3, 0, 0], restitution: 0.5}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0], restitution: 0.5}}\nsimulate: {duration: 1.5}";
  ASSERT_EQ(value_of("first(b, floor)", thrown), 1);

  for (const double t : {std::nextafter(1.0, 0.0), 1.0, std::nextafter(1.0, 2.0)}) {
    const auto all = measured(
        thrown, {fmt::format("max(balls.b.x_m, until: {})", t), fmt::format("min(balls.b.x_m, from: {})", t),
                 fmt::format("min(balls.b.y_m, until: {})", t), fmt::format("time_of_max(balls.b.x_m, until: {})", t),
                 fmt::format("max(balls.b.x_m, from: {})", t), fmt::format("max(balls.b.y_m, until: {})", t)});
    EXPECT_NEAR(all[0], 3, 1e-14) << t;
    EXPECT_NEAR(all[1], 3, 1e-14) << t;
    EXPECT_NEAR(all[2], 0.5, 1e-14) << t;
    EXPECT_NEAR(all[3], 1, 1e-15) << t;
    EXPECT_NEAR(all[4], 4.5, 1e-14) << t;
    EXPECT_NEAR(all[5], 5.5, 1e-14) << t;
  }

  // At the instant itself both sides count: it arrives at 10 m/s and leaves at 5 m/s.
  const auto both = measured(thrown, {"min(balls.b.vy_m_per_s, until: 1)", "max(balls.b.vy_m_per_s, until: 1)",
                                      "min(balls.b.vy_m_per_s, from: 1)", "max(balls.b.vy_m_per_s, from: 1)"});
  EXPECT_NEAR(both[0], -10, 1e-14);
  EXPECT_NEAR(both[1], 5, 1e-14);
  EXPECT_NEAR(both[2], -10, 1e-14);
  EXPECT_NEAR(both[3], 5, 1e-14);
}

TEST(Windows, ThatEndAtTheTimeOfAnImpactHaveBothOfItsSides) {
  // Whatever the impact's time, it is in the window up to its double, as hits counts it.
  for (int i = 0; i < 40; ++i) {
    const string dropped = fmt::format(
        "scene: 1\ngravity: [0, -9.81, 0]\n"
        "balls: {{b: {{mass: 2, radius: 0.1, position: [0, {}, 0], restitution: 0.5}}}}\n"
        "planes: {{floor: {{point: [0, 0, 0], normal: [0, 1, 0], restitution: 0.5}}}}\nsimulate: {{duration: 3}}",
        1 + 0.07 * i);
    const string t = fmt::format("{}", value_of("first(b, floor)", dropped));
    const auto all =
        measured(dropped, {"hits(b, until: " + t + ")", "max(balls.b.vy_m_per_s, until: " + t + ")",
                           "min(balls.b.vy_m_per_s, until: " + t + ")", "max(balls.b.vy_m_per_s, from: " + t + ")"});

    const double speed = sqrt(2 * 9.81 * (0.9 + 0.07 * i));
    EXPECT_EQ(all[0], 1) << t;
    EXPECT_NEAR(all[1], 0.5 * speed, 1e-12) << t;
    EXPECT_NEAR(all[2], -speed, 1e-12) << t;
    EXPECT_NEAR(all[3], 0.5 * speed, 1e-12) << t;
  }
}

TEST(Windows, OfARunThatStopsAtAnImpactHaveBothOfItsSides) {
  for (int i = 0; i < 20; ++i) {
    const string dropped = fmt::format(
        "scene: 1\ngravity: [0, -9.81, 0]\n"
        "balls: {{b: {{mass: 2, radius: 0.1, position: [0, {}, 0], restitution: 0.5}}}}\n"
        "planes: {{floor: {{point: [0, 0, 0], normal: [0, 1, 0], restitution: 0.5}}}}\n"
        "simulate: {{duration: 3, stop: [{{collisions: 1}}]}}",
        1 + 0.07 * i);
    const auto all = measured(dropped, {"max(balls.b.vy_m_per_s)", "balls.b.vy_m_per_s"});
    EXPECT_EQ(all[0], all[1]) << i;
    EXPECT_NEAR(all[0], 0.5 * sqrt(2 * 9.81 * (0.9 + 0.07 * i)), 1e-12) << i;
  }
}

TEST(Windows, OfExtremesHaveTheirEnds) {
  const auto all =
      measured(bouncing(4),
               {"max(balls.b.y_m, from: 0.1, until: 0.3)", "time_of_max(balls.b.y_m, from: 0.1, until: 0.3)",
                "min(balls.b.y_m, from: 0.1, until: 0.3)", "time_of_min(balls.b.y_m, from: 0.1, until: 0.3)",
                "max(balls.b.y_m, from: 2.25)", "time_of_max(balls.b.y_m, from: 2.25)",
                "max(balls.b.vy_m_per_s, from: 0.5, until: 0.75)", "min(balls.b.vy_m_per_s, from: 0.5, until: 1.25)"});
  EXPECT_NEAR(all[0], 0.1 + 1.05, 1e-14);
  EXPECT_EQ(all[1], 0.3);
  EXPECT_NEAR(all[2], 0.1 + 0.45, 1e-14);
  EXPECT_EQ(all[3], 0.1);
  EXPECT_NEAR(all[4], 0.1 + 1.25, 1e-14);
  EXPECT_NEAR(all[5], 2.5, 1e-13);
  // The side of an impact that is after the window does not count, and both sides of one in it do.
  EXPECT_NEAR(all[6], 0, 1e-13);
  EXPECT_NEAR(all[7], -5, 1e-13);
}

TEST(Windows, OfCollisionsHaveTheirEnds) {
  const auto all =
      measured(bouncing(4.5), {"hits(b, floor)", "hits(b, floor, from: 1.5)", "hits(b, from: 1.5, until: 3.5)",
                               "first(b, floor, from: 1.5)", "first(b, floor, from: 4.25)", "hits(floor, until: 0.5)"});
  EXPECT_EQ(all[0], 4);
  EXPECT_EQ(all[1], 3);
  EXPECT_EQ(all[2], 2);
  EXPECT_NEAR(all[3], 2, 1e-14);
  EXPECT_TRUE(std::isnan(all[4]));
  EXPECT_EQ(all[5], 0);
}

TEST(Windows, StandInExpressions) {
  EXPECT_NEAR(value_of("= max(balls.b.y_m, from: 0.1, until: 0.3) - max(1, 2) * hits(b, from: 3.5)", bouncing(4)),
              1.15 - 2 * 1, 1e-13);
}

TEST(Windows, AreRefusedWhereTheyAreWrong) {
  const Scene scene = load_text(bouncing(4));
  const auto fault = [&](const string& text) {
    try {
      parse_measure(text, scene);
      return string();
    } catch (const MeasureError& error) {
      return string(error.what());
    }
  };

  EXPECT_EQ(fault("max(balls.b.y_m, from: 2, until: 1)"),
            "`max(balls.b.y_m, from: 2, until: 1)`: `until` is 1 s but `from` is 2 s; expected from < until");
  EXPECT_EQ(fault("hits(b, from: 4)"), "`hits(b, from: 4)`: `from` is 4 s but the scene ends at 4 s; expected less");
  EXPECT_EQ(fault("hits(b, from: -1)"), "`hits(b, from: -1)`: `from` is -1 s; expected at least 0");

  // What is no time.
  EXPECT_EQ(fault("hits(b, from: soon)"),
            "`hits(b, from: soon)`: `soon` is no time; expected from: and seconds, such as from: 1.5, or let.NAME");
  EXPECT_EQ(fault("hits(b, from: 1, from: 2)"), "`hits(b, from: 1, from: 2)` has `from` twice");
  EXPECT_EQ(fault("mean(balls.b.y_m, from: let.s)"),
            "`mean(balls.b.y_m, from: let.s)`: there is no `let.s`; there is `t`");
  EXPECT_EQ(fault("count(y_m < 0, from: 1)"),
            "`count(y_m < 0, from: 1)`: bodies are counted at the end of the run; remove `from: 1`");
  EXPECT_EQ(fault("max(from: 1)"), "`max(from: 1)`: expected one quantity, such as max(balls.NAME.y_m)");
}

TEST(Windows, HaveUnitsAndLabels) {
  EXPECT_EQ(unit_of("impulse(b, floor, from: 1)"), "N s");
  EXPECT_EQ(unit_of("mean(balls.b.y_m, from: 1, until: 2)"), "m");
  EXPECT_EQ(unit_of("max(balls.b.kinetic_J, until: 2)"), "J");
  EXPECT_EQ(unit_of("time_of_max(balls.b.y_m, from: 1)"), "s");
  EXPECT_EQ(unit_of("hits(b, from: 1)"), "");
  EXPECT_EQ(label_of("mean(balls.b.y_m, from: 1, until: 2)"), "mean balls.b y from 1 to 2 s (m)");
  EXPECT_EQ(label_of("max(balls.b.y_m)"), "maximum balls.b y (m)");
  EXPECT_EQ(label_of("impulse(b, floor)"), "impulse of b, floor (N s)");
  EXPECT_EQ(label_of("first(b, floor, from: 1)"), "first hit of b, floor from 1 s (s)");
}

}  // namespace
}  // namespace carom::testing
