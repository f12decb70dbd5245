// Scenes in which balls fall, bounce, slide and rest, against their comments and the closed forms.
#include <gtest/gtest.h>

#include <numeric>

#include "physics/energy.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "std.h"

namespace carom::testing {
namespace {

TEST(BouncingBall, RestsWhenTheSumOfItsFlightsEnds) {
  const string file = "bouncing_ball";
  const double t1 = sqrt(2 / g_n), e = 0.8, rest = t1 * (1 + e) / (1 - e);
  const Played run = play(file, {rest + 1e-9, 4.5});
  EXPECT_NEAR(run.collisions[0].time, t1, 1e-15);
  EXPECT_NEAR(run.collisions[0].approach_speed, sqrt(2 * g_n), 2e-15);
  ASSERT_EQ(run.rests.size(), 1u);
  EXPECT_NEAR(run.rests[0].time, rest, 4e-13);  // 1e-13 relative
  for (const State& state : run.states) {
    EXPECT_NEAR(state.position[0].y(), 0.12, 1e-15);
    EXPECT_EQ(state.velocity[0].y(), 0);
  }
  EXPECT_NEAR(run.position("ball").x(), 1.5, 2e-15);
  // The tops between impacts: e^2 h, e^4 h, ...
  vector<double> tops;
  for (int n = 0; n < 3; ++n) tops.push_back((run.collisions[n].time + run.collisions[n + 1].time) / 2);
  const Played at_tops = play(file, tops);
  for (int n = 0; n < 3; ++n) {
    EXPECT_NEAR(at_tops.states[n].position[0].y() - 0.12, pow(e, 2 * n + 2), 1e-15);
  }

  EXPECT_NEAR(stated(file, "t1 = sqrt(2 h / g) = "), t1, 5e-16);
  EXPECT_NEAR(stated(file, "at sqrt(2 g h) = "), sqrt(2 * g_n), 1e-15);
  EXPECT_NEAR(stated(file, "from t1 (1+e)/(1-e) = "), rest, 1e-15);
  EXPECT_NEAR(stated(file, "h e^(2 n): "), e * e, 1e-15);
  EXPECT_NEAR(stated(file, "0.64 m, "), pow(e, 4), 1e-15);
  EXPECT_NEAR(stated(file, "0.4096 m, "), pow(e, 6), 1e-15);
  EXPECT_NEAR(stated(file, "-1.5 + 0.6 * 5 = "), 1.5, 1e-15);
}

TEST(RestitutionRow, EveryBallRisesToESquaredOfTheHeight) {
  const string file = "restitution_row";
  const double t1 = sqrt(2 / g_n);
  const double es[] = {1, 0.95, 0.9, 0.8, 0.65, 0.5, 0.2};
  const double heights[] = {1, 0.9025, 0.81, 0.64, 0.4225, 0.25, 0.04};

  vector<double> tops;
  for (int i = 6; i >= 0; --i) tops.push_back(t1 + es[i] * t1);

  const Played run = play(file, tops);

  for (int i = 0; i < 7; ++i) {
    const State& top = run.states[6 - i];
    EXPECT_NEAR(top.position[i].y() - 0.12, heights[i], 1e-15) << es[i];  // measured: 5e-16
    EXPECT_DOUBLE_EQ(heights[i], es[i] * es[i]);
    EXPECT_NEAR(top.velocity[i].y(), 0, 4e-15);
    EXPECT_EQ(run.of(run.scene.roster.name(i))[0].restitution, es[i]) << "the ball's own counts";
  }

  EXPECT_NE(comment_of(file).find("e 1 0.95 0.9 0.8 0.65 0.5 0.2 e^2 h 1 0.9025 0.81 0.64 0.4225 0.25 0.04 m"),
            string::npos);
  EXPECT_NEAR(stated(file, "sqrt(2 h / g) = "), t1, 5e-16);

  ASSERT_EQ(run.rests.size(), 3u);
  const char* const words[] = {"1.354802267255363 s, ", "2.128974991401285 s, ",
                               "(1+e)/(1-e) on: "};  // in order of time

  for (int k = 0; k < 3; ++k) {
    const double e = es[6 - k], rest = t1 * (1 + e) / (1 - e);
    EXPECT_NEAR(run.rests[k].time, rest, 1e-13);
    EXPECT_NEAR(stated(file, words[k]), rest, 1e-15);
  }
}

TEST(BasketballAndTennisBall, TheTennisBallIsShotUp) {
  const string file = "basketball_and_tennis_ball";
  const double big = 0.62, m = 0.058, h = 0.4, t = sqrt(2 * h / g_n), v = sqrt(2 * g_n * h);
  const double up = v * (3 * big - m) / (big + m);

  const Played run = play(file, {0.5, t + up / g_n});

  EXPECT_NEAR(run.collisions[0].time, t, 4e-16);
  EXPECT_EQ(run.collisions[0].kind, CollisionKind::body_fixed);
  EXPECT_EQ(run.collisions[1].kind, CollisionKind::body_body);
  EXPECT_NEAR(run.collisions[1].time, t, 4e-16);
  EXPECT_NEAR(run.collisions[0].approach_speed, v, 2e-15);

  EXPECT_NEAR(run.states[0].velocity[1].y() + g_n * (0.5 - t), up, 1e-14);
  EXPECT_NEAR(run.states[0].velocity[0].y() + g_n * (0.5 - t), v * (big - 3 * m) / (big + m), 1e-14);
  EXPECT_NEAR(run.states[1].position[1].y() - 0.273, h * pow((3 * big - m) / (big + m), 2), 1e-14);

  EXPECT_NEAR(stated(file, "sqrt(2 h / g) = "), t, 5e-16);
  EXPECT_NEAR(stated(file, "sqrt(2 g h) = "), v, 5e-15);
  EXPECT_NEAR(stated(file, "v (3 M - m)/(M + m) = "), up, 5e-14);
  EXPECT_NEAR(stated(file, "v (M - 3 m)/(M + m) = "), v * (big - 3 * m) / (big + m), 5e-15);
  EXPECT_NEAR(stated(file, "h ((3 M - m)/(M + m))^2 = "), h * pow((3 * big - m) / (big + m), 2), 5e-15);
}

TEST(TiltedGroove, TheBallSlidesOnWithGSinTilt) {
  const string file = "tilted_groove";
  const double tilt = 10 * M_PI / 180, a = g_n * std::sin(tilt);
  const Vec3 along(std::cos(tilt), -std::sin(tilt), 0), up(std::sin(tilt), std::cos(tilt), 0);

  const Played run = play(file, {0.5, 1, 2});  // bouncing, bouncing, sliding
  const double from = along.dot(run.scene.initial.position[0]);

  for (const State& state : run.states) {
    EXPECT_NEAR(along.dot(state.position[0]) - from, a * state.time * state.time / 2, 2e-14) << state.time;
  }

  EXPECT_NEAR(along.dot(run.end.position[0]) - from, a * 9 / 2, 2e-14);  // measured: 5e-15
  EXPECT_NEAR(along.dot(run.end.velocity[0]), a * 3, 1e-14);

  EXPECT_NEAR(up.dot(run.end.position[0]), 0.1 * sqrt(2), 1e-14);
  EXPECT_NEAR(run.end.position[0].z(), 0, 1e-14);
  EXPECT_NEAR(up.dot(run.end.velocity[0]), 0, 1e-14);
  EXPECT_NEAR(run.end.velocity[0].z(), 0, 1e-14);

  EXPECT_EQ(run.tally.resting, 1u);

  EXPECT_NEAR(stated(file, "g sin 10 = "), a, 1e-15);
  EXPECT_NEAR(stated(file, "1.702906901517403 m/s^2, "), a * 9 / 2, 5e-15);
  EXPECT_NEAR(stated(file, "where it moves at "), a * 3, 5e-15);
  EXPECT_NEAR(stated(file, "r sqrt(2) = "), 0.1 * sqrt(2), 5e-16);
}

TEST(BallsInABox, ComeToRestOnTheFloor) {
  const string file = "balls_in_a_box";
  const Played run = play(file);
  EXPECT_GE(run.tally.resting, 70u);  // of 72
  double floor = 0;                   // J, of gravity with every ball on the floor
  for (Entity i = 0; i < run.scene.world.body_count(); ++i)
    floor += run.scene.world.mass[i] * g_n * run.scene.world.radius[i];
  EXPECT_NEAR(stated(file, ") g = "), floor, 1e-8);
  EXPECT_NEAR(potential_energy(run.scene.world, run.end), floor, 0.01 * floor);
  EXPECT_LT(kinetic_energy(run.scene.world, run.end), 0.01 * floor);
  EXPECT_EQ(run.scene.simulate.rest_speed, 0.05);
}

}  // namespace
}  // namespace carom::testing
