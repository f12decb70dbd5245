// Scenes whose things are made by rules, and measured by names: closed forms of their comments.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>

#include "run/run_scene.h"
#include "scenes/play.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

double square(double x) {
  return x * x;
}

/// The value of a scene's own measure after its run.
double measured(const string& name, const string& measure) {
  Scene scene = load(name);
  scene.output = {};
  const string folder =
      (std::filesystem::temp_directory_path() / fmt::format("carom_rules_{}_{}", name, getpid())).string();
  const vector<Measured> all =
      run_scene({&scene, folder, 0}, choose_engine(scene), {}, {[] {}, [](const RunProgress&) {}}).summary.measures;
  std::filesystem::remove_all(folder);
  const auto found = ranges::find_if(all, [&](const Measured& one) { return one.name == measure; });
  EXPECT_NE(found, all.end()) << measure;
  return found == all.end() ? std::nan("") : found->value;
}

TEST(Cars, AreStruckWhenAndAsFastAsStated) {
  SLOW_WITH_SANITIZERS();
  const Played run = play("cars");
  const Collision& hit = run.collisions.front();
  const double c = 0.1, v = 20 - c * 20, first = 1.2 * 9000 / 10200 * v;
  EXPECT_NEAR(hit.time, -log(1 - c * 20 / 20) / c, 1e-14);
  EXPECT_NEAR(hit.time, stated("cars", "log(1 - c 20 m / v) / c ="), 1e-14);
  EXPECT_NEAR(hit.approach_speed, v, 1e-13);
  EXPECT_NEAR(hit.impulse / 1200, first, 1e-13);
  EXPECT_NEAR(first, stated("cars", "(M + m) 18 m/s ="), 1e-13);
}

TEST(Cars, ArePushedIntoTheCrossing) {
  SLOW_WITH_SANITIZERS();
  EXPECT_EQ(measured("cars", "cars_in_crossing"), 6);
  EXPECT_NEAR(measured("cars", "first_hit_s"), stated("cars", "log(1 - c 20 m / v) / c ="), 1e-14);
}

TEST(MarbleRun, BringsAllMarblesIntoTheCup) {
  SLOW_WITH_SANITIZERS();
  const double tilt = 12 * std::numbers::pi / 180, fall = 0.25 - 0.39 * std::tan(tilt) - 0.04 / std::cos(tilt);
  const Played run = play("marble_run");
  EXPECT_NEAR(run.collisions.front().time, sqrt(2 * fall / g_n), 1e-14);
  EXPECT_NEAR(fall, stated("marble_run", "r / cos a ="), 1e-7);
  EXPECT_NEAR(run.collisions.front().time, stated("marble_run", "in sqrt(2 s / g) ="), 1e-8);
  EXPECT_EQ(measured("marble_run", "arrived"), 3);
  ASSERT_TRUE(run.tally.end);
  EXPECT_LT(run.tally.end->time, run.scene.simulate.duration);
}

TEST(BowlingShot, MeetsTheFirstPinWhenStated) {
  const double reach = 0.108 + 0.06053, time = (3 - sqrt(square(reach) - square(0.03))) / 7;
  EXPECT_NEAR(time, stated("bowling_shot", "aim^2)) / v ="), 1e-12);
  EXPECT_NEAR(measured("bowling_shot", "first_hit_s"), time, 1e-13);
  EXPECT_EQ(measured("bowling_shot", "left_on_deck"), 2);
}

TEST(Funnel, LetsAllBallsThrough) {
  SLOW_WITH_SANITIZERS();
  EXPECT_EQ(measured("funnel", "through"), 500);
}

TEST(Hourglass, LetsAllBallsThroughAndKeepsThem) {
  SLOW_WITH_SANITIZERS();
  EXPECT_EQ(measured("hourglass", "through"), 200);
  EXPECT_EQ(measured("hourglass", "left"), 200);
}

TEST(PourIntoBowl, FillsTheBowl) {
  SLOW_WITH_SANITIZERS();
  EXPECT_EQ(measured("pour_into_bowl", "in_the_bowl"), 160);
}

TEST(WreckingBall, IsCutFromItsStringAtTheLowestPoint) {
  const double u = sqrt(g_n * 4), cut = sqrt(4 / g_n) * std::comp_ellint_1(0.5);
  const double hit = cut + (3.5 - 0.4 - 0.25) / u;
  EXPECT_NEAR(stated("wrecking_ball", "u = sqrt(g L) ="), u, 1e-13);
  EXPECT_NEAR(stated("wrecking_ball", "t = sqrt(L / g) K ="), cut, 1e-13);
  EXPECT_NEAR(stated("wrecking_ball", "/ u later, at t ="), hit, 1e-13);
  const Played run = play("wrecking_ball");
  EXPECT_NEAR(run.tally.changes.fired[0], cut, 1e-12);
  EXPECT_NEAR(run.collisions.front().time, hit, 1e-12);
  // The ball has gone on, and is not at the end of its string.
  EXPECT_GT((run.end.position[0] - Vec3(0, 5.5, 0)).norm(), 6);
}

TEST(OpeningGate, LetsNoMarblePassBeforeTheSwitchIsHit) {
  const double hit = sqrt(2 * 1.5 / g_n);
  EXPECT_NEAR(stated("opening_gate", "t = sqrt(2 (1.5 m) / g) ="), hit, 1e-14);
  EXPECT_NEAR(measured("opening_gate", "switched_s"), hit, 1e-14);
  EXPECT_EQ(measured("opening_gate", "through"), 60);
  EXPECT_GT(measured("opening_gate", "first_through_s"), hit + 0.2);
}

TEST(Pinball, IsPlayedByItsFlippers) {
  const Played run = play("pinball");
  EXPECT_NEAR(run.tally.changes.fired[1], 1.273, 1e-3);
  EXPECT_NEAR(run.tally.changes.fired[0], 3.084, 1e-3);
  // Each strikes the ball once within the time of its stroke.
  for (const uint32_t side : {0u, 1u}) {
    const string flipper = side == 0 ? "left_flipper" : "right_flipper";
    const auto strikes = ranges::count_if(run.collisions, [&](const Collision& met) {
      const double since = met.time - run.tally.changes.fired[side];
      return run.scene.roster.name(met.b) == flipper && since > 0 && since < 0.05;
    });
    EXPECT_EQ(strikes, 1) << flipper;
  }
  ASSERT_TRUE(run.tally.end);
  EXPECT_NEAR(run.tally.end->time, stated("pinball", "is lost at"), 0.01);
  EXPECT_NEAR(run.tally.work, stated("pinball", "which they have given"), 0.05);
}

TEST(Planets, FollowKeplersLaws) {
  const double a = (12 + 0.35) / 2, gm = 4 * square(std::numbers::pi), period = pow(a, 1.5);
  EXPECT_NEAR(period, stated("planets", "the period is a^(3/2) ="), 1e-13);
  // The earth's orbit is crossed where 1 = a (1 - e cos E).
  const double e = (12 - 0.35) / (12 + 0.35), anomaly = std::acos((1 - 1 / a) / e);
  const double half = (anomaly - e * std::sin(anomaly)) / (2 * std::numbers::pi) * period;
  EXPECT_NEAR(measured("planets", "arrives_s"), period / 2 - half, 1e-12);
  EXPECT_NEAR(stated("planets", "within the earth's orbit from t ="), period / 2 - half, 1e-13);
  EXPECT_NEAR(stated("planets", "7.565101077051418 s to"), period / 2 + half, 1e-13);
  const double fastest = sqrt(gm * (2 / 0.35 - 1 / a));
  EXPECT_NEAR(measured("planets", "fastest"), fastest, 1e-11);
  EXPECT_NEAR(fastest, stated("planets", "sqrt(gm (2 / 0.35 - 1 / a)) ="), 1e-13);
  EXPECT_NEAR(measured("planets", "farthest_m"), 12, 1e-11);
}

TEST(BrickWall, LosesSixBricks) {
  SLOW_WITH_SANITIZERS();
  EXPECT_NEAR(measured("brick_wall", "first_hit_s"), 2.3 / 12, 1e-15);
  EXPECT_NEAR(stated("brick_wall", "0.05 m) / v ="), 2.3 / 12, 1e-14);
  EXPECT_EQ(measured("brick_wall", "knocked_out"), 6);
}

TEST(Pool, HasItsFirstHitAndItsBallsInPockets) {
  const double k = 0.05 / 0.17, aim = 0.3 * std::numbers::pi / 180, r = 0.028575, l = 1.27;
  const double way = l * std::cos(aim) - sqrt(square(2 * r) - square(l * std::sin(aim)));
  const double time = -log(1 - k * way / 6) / k;
  EXPECT_NEAR(way, stated("pool", "(l sin a)^2) ="), 1e-12);
  EXPECT_NEAR(time, stated("pool", "log(1 - k s / v) / k ="), 1e-12);
  EXPECT_NEAR(play("pool").collisions.front().time, time, 1e-14);
  EXPECT_EQ(measured("pool", "potted"), 2);
}

/// s: the period of a pendulum of 1 m that swings to this angle from the vertical, by the arithmetic-geometric mean.
double pendulum_period(double angle) {
  double a = 1, b = std::cos(angle / 2);
  while (std::abs(a - b) > 1e-15) {
    const double mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return 2 * std::numbers::pi / (a * sqrt(g_n));
}

TEST(NewtonsCradle, StrikesEachHalfPeriodAndKeepsItsEnergy) {
  const double aim = std::numbers::pi / 6, period = pendulum_period(aim);
  EXPECT_NEAR(period, stated("newtons_cradle", "K(sin(aim / 2)) ="), 1e-14);
  EXPECT_NEAR(period / 4, stated("newtons_cradle", "the first strike at T / 4 ="), 1e-14);

  const double speed = sqrt(2 * g_n * (1 - std::cos(aim)));
  EXPECT_NEAR(speed, stated("newtons_cradle", "cos aim)) ="), 1e-14);
  EXPECT_NEAR(-std::cos(aim), stated("newtons_cradle", "-l cos aim ="), 1e-14);

  const Played run = play("newtons_cradle");
  EXPECT_NEAR(run.collisions.front().time, period / 4, 1e-12);
  EXPECT_NEAR(run.collisions.front().approach_speed, speed, 1e-12);
  EXPECT_NEAR(run.collisions.back().time, period / 4 + 7 * period / 2, 1e-10);
  EXPECT_NEAR(run.tally.energy_lost, 0, 1e-12);

  EXPECT_NEAR(measured("newtons_cradle", "first_hit_s"), period / 4, 1e-12);
  EXPECT_EQ(measured("newtons_cradle", "last_hits"), 8);
  EXPECT_NEAR(measured("newtons_cradle", "last_rises_m"), -std::cos(aim), 1e-11);
}

TEST(SlackPendulum, GoesSlackAndTautWhenStated) {
  const double u = sqrt(g_n / 2), flight = 4 * u * sqrt(0.75) / g_n;
  const double slack = stated("slack_pendulum", "sqrt(g l / 2), at t ="), taut = slack + flight;

  // The time to 120 degrees, by Gauss-Legendre of order 10 in twenty parts: dt = dangle / sqrt(v^2 - 2 g (1 - cos)).
  constexpr double nodes[] = {0.14887433898163122, 0.43339539412924719, 0.67940956829902441, 0.86506336668898451,
                              0.97390652851717172};
  constexpr double weights[] = {0.29552422471475287, 0.26926671930999636, 0.21908636251598204, 0.14945134915058059,
                                0.06667134430868814};

  double sum = 0;
  constexpr int parts = 20;
  const double half = 2 * std::numbers::pi / 3 / parts / 2;
  for (int part = 0; part < parts; ++part)
    for (int k = 0; k < 5; ++k)
      for (const double sign : {-1.0, 1.0}) {
        const double angle = half * (2 * part + 1 + sign * nodes[k]);
        sum += half * weights[k] / sqrt(g_n * (1.5 + 2 * std::cos(angle)));
      }

  EXPECT_NEAR(slack, sum, 1e-14);
  EXPECT_NEAR(taut, stated("slack_pendulum", "cos(30) / g later, at t ="), 1e-14);

  const double jerk = 3 * u * sqrt(0.75), swing = std::acos(15.0 / 16);
  EXPECT_NEAR(jerk, stated("slack_pendulum", "3 u cos 30 ="), 1e-14);
  EXPECT_NEAR(jerk * jerk / 2, stated("slack_pendulum", "81 / 48 g l J ="), 1e-13);
  EXPECT_NEAR(swing * 180 / std::numbers::pi, stated("slack_pendulum", "acos(15 / 16) ="), 1e-12);
  EXPECT_NEAR(pendulum_period(swing), stated("slack_pendulum", "with the period"), 1e-14);

  const Played run = play("slack_pendulum", {taut + pendulum_period(swing) / 4});
  ASSERT_EQ(run.collisions.size(), 1u);

  const Collision& hit = run.collisions.front();
  EXPECT_EQ(hit.kind, CollisionKind::taut);
  EXPECT_NEAR(hit.time, taut, 1e-12);
  EXPECT_NEAR(hit.approach_speed, jerk, 1e-11);
  EXPECT_NEAR(hit.energy_lost, jerk * jerk / 2, 1e-10);
  EXPECT_NEAR(run.states[0].position[0].y(), -15.0 / 16, 1e-11);

  EXPECT_NEAR(measured("slack_pendulum", "taut_again_s"), taut, 1e-12);
  EXPECT_EQ(measured("slack_pendulum", "jerks"), 1);
}

}  // namespace
}  // namespace carom::testing
