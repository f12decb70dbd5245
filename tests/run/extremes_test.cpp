// Extremes of quantities over a run, against closed forms, on every sort of path.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "engine/engine.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom::testing {
namespace {

constexpr double g = 9.80665;

/// The extremes of one quantity of the first body after the whole run.
Extremes extremes_of(const string& yaml, Quantity quantity, Entity count = 1) {
  const Scene scene = load_text(yaml);
  const auto simulator = make_simulator(scene, {.watch = {{quantity, 0, count}}});
  while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);
  return simulator->extremes().front();
}

string thrown(const string& more) {
  return "scene: 1\nballs: {red: {mass: 2, radius: 0.1, position: [0, 2, 0], velocity: [3, 5, 0]}}\n" + more;
}

TEST(PathExtremes, OfAParabolaAreItsVertexAndItsEnds) {
  const string yaml = thrown("simulate: {duration: 1.5}");
  const Extremes height = extremes_of(yaml, Quantity::y);
  EXPECT_NEAR(height.greatest.value, 2 + 25 / (2 * g), 1e-15);
  EXPECT_NEAR(height.greatest.time, 5 / g, 1e-15);
  EXPECT_EQ(height.least.time, 1.5);
  const Extremes speed = extremes_of(yaml, Quantity::speed);
  EXPECT_NEAR(speed.least.value, 3, 1e-15);
  EXPECT_NEAR(speed.least.time, 5 / g, 1e-15);
  EXPECT_NEAR(speed.greatest.value, hypot(3, 5 - 1.5 * g), 1e-14);
  EXPECT_NEAR(extremes_of(yaml, Quantity::kinetic).least.value, 9, 1e-14);
  EXPECT_EQ(extremes_of(yaml, Quantity::vx).greatest.value, 3);
  EXPECT_EQ(extremes_of(yaml, Quantity::vx).greatest.time, 0);
}

TEST(PathExtremes, HaveBothSidesOfAnImpact) {
  // It falls by 2 m, and leaves the floor with half of its speed.
  const Extremes v = extremes_of(
      "scene: 1\nballs: {red: {mass: 2, radius: 0.1, position: [0, 2.1, 0], restitution: 0.5}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 0.7}",
      Quantity::vy);
  const double impact = sqrt(2 * 2 * g);
  EXPECT_NEAR(v.least.value, -impact, 4e-15);
  EXPECT_NEAR(v.greatest.value, impact / 2, 4e-15);
  EXPECT_NEAR(v.greatest.time, sqrt(2 * 2 / g), 1e-15);
  EXPECT_EQ(v.least.time, v.greatest.time);
}

TEST(PathExtremes, UnderLinearDragAreWhereVelocitiesTurn) {
  // v' = -g - c v: the top is at t = log(1 + c v / g) / c.
  const double c = 0.5 / 2;
  const Extremes y = extremes_of(thrown("forces: [{drag: {linear: 0.5}}]\nsimulate: {duration: 1.5}"), Quantity::y);
  const double top = log(1 + c * 5 / g) / c;
  EXPECT_NEAR(y.greatest.time, top, 1e-12);
  EXPECT_NEAR(y.greatest.value, 2 + 5 / c - g / (c * c) * log(1 + c * 5 / g), 1e-13);
}

TEST(PathExtremes, OfAnOscillationAreItsAmplitude) {
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {red: {mass: 1, radius: 0.1, position: [1, 0, 0], velocity: [2, 0, 0]}}\n"
      "forces: [{spring: {anchor: [0, 0, 0], stiffness: 4}}]\nsimulate: {duration: 10}";
  const double amplitude = sqrt(2);
  const Extremes x = extremes_of(yaml, Quantity::x);
  EXPECT_NEAR(x.greatest.value, amplitude, 1e-13);
  EXPECT_NEAR(x.greatest.time, std::numbers::pi / 8, 1e-7);
  EXPECT_NEAR(x.least.value, -amplitude, 1e-13);
  EXPECT_NEAR(extremes_of(yaml, Quantity::speed).greatest.value, 2 * amplitude, 1e-12);
}

TEST(PathExtremes, OfAKeplerOrbitAreItsApses) {
  // Perihelion 1, aphelion 4, by Kepler's laws.
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\n"
      "balls: {comet: {mass: 1, radius: 0.01, position: [1, 0, 0], velocity: [0, 1.2649110640673518, 0]}}\n"
      "forces: [{attractor: {center: [0, 0, 0], strength: 1}}]\nsimulate: {duration: 20}";
  const Extremes x = extremes_of(yaml, Quantity::x);
  EXPECT_NEAR(x.least.value, -4, 1e-10);
  EXPECT_NEAR(x.least.time, std::numbers::pi * pow(2.5, 1.5), 1e-5);
  EXPECT_NEAR(extremes_of(yaml, Quantity::speed).least.value, 1.2649110640673518 / 4, 1e-11);
  // The semi-minor axis is 2.
  EXPECT_NEAR(extremes_of(yaml, Quantity::y).greatest.value, 2, 1e-11);
}

TEST(PathExtremes, OfSlidingAreTakenFromConstrainedMotion) {
  // A ball slides down a globe from rest near the top, and leaves it at 2/3 of the height. Its speed there is
  // sqrt(2 g R / 3), less for the start below the top.
  const double reach = 1.1, angle = 0.01;
  const string yaml = fmt::format(
      "scene: 1\nballs: {{red: {{mass: 1, radius: 0.1, position: [{:.17g}, {:.17g}, 0], restitution: 0}}}}\n"
      "obstacles: {{globe: {{radius: 1, position: [0, 0, 0]}}}}\nsimulate: {{duration: 2.2}}",
      reach * std::sin(angle), reach * std::cos(angle));
  const Extremes x = extremes_of(yaml, Quantity::y);
  EXPECT_NEAR(x.greatest.value, reach * std::cos(angle), 1e-12);
  const Extremes vx = extremes_of(yaml, Quantity::vx);
  const double c = 2 * std::cos(angle) / 3;
  EXPECT_NEAR(vx.greatest.value, c * sqrt(g * reach * c), 1e-8);
}

TEST(PathExtremes, DoNotDependOnTheEngine) {
  const string more = "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0], restitution: 0.7}}\n";
  const auto by = [&](const char* engine) {
    return extremes_of(thrown(more + "simulate: {duration: 3, engine: " + engine + "}"), Quantity::y);
  };
  const Extremes exact = by("exact"), stepped = by("stepped");
  EXPECT_NEAR(exact.greatest.value, stepped.greatest.value, 1e-12);
  EXPECT_NEAR(exact.greatest.time, stepped.greatest.time, 1e-12);
  EXPECT_NEAR(by("book").greatest.value, exact.greatest.value, 0.1);
}

// Half a period of a pendulum of 2 m that swings from 60 degrees, by its elliptic integral (mpmath, 20 digits). Later
// periods have speeds that are higher by rounding and by path errors.
TEST(PathExtremes, OfASwingHaveTheirFirstTime) {
  const string yaml =
      "scene: 1\ngravity: [0, -9.75, 0]\n"
      "balls: {bob: {mass: 3, radius: 0.05, position: ['= 2 * sin(60)', -1, 0]}}\n"
      "strings: {s: {from: [0, 0, 0], to: bob, length: 2}}\nsimulate: {duration: 40}";
  const double turn = 1.5269891296443249689;
  EXPECT_NEAR(extremes_of(yaml, Quantity::speed).greatest.time, turn / 2, 1e-12);    // measured: 7e-14
  EXPECT_NEAR(extremes_of(yaml, Quantity::kinetic).greatest.time, turn / 2, 1e-12);  // 7e-14
  EXPECT_NEAR(extremes_of(yaml, Quantity::vx).least.time, turn / 2, 1e-12);          // 3e-14
  EXPECT_NEAR(extremes_of(yaml, Quantity::y).least.time, turn / 2, 1e-12);           // 3e-14
  EXPECT_NEAR(extremes_of(yaml, Quantity::x).least.time, turn, 1e-12);               // 3e-16
  EXPECT_EQ(extremes_of(yaml, Quantity::y).greatest.time, 0);
}

// x = cos 5t + sin(5t) / 5 turns at atan(1/5) / 5. Speeds are greatest a quarter of a period later.
TEST(PathExtremes, OfSpringsHaveTheirFirstTimeByEveryMethod) {
  const auto by = [](const string& more, Quantity quantity) {
    return extremes_of(
        "scene: 1\ngravity: [0, 0, 0]\n"
        "balls: {b: {mass: 1, radius: 0.05, position: [1, 0, 0], velocity: [1, 0, 0]}}\n"
        "forces: [{spring: {anchor: [0, 0, 0], stiffness: 25}}]\nsimulate: {duration: 20" +
            more + "}",
        quantity);
  };

  const double turn = std::atan(0.2) / 5, fastest = turn + std::numbers::pi / 10;
  for (const char* more : {"", ", engine: stepped"}) {
    EXPECT_NEAR(by(more, Quantity::x).greatest.time, turn, 1e-12) << more;         // measured: 2e-17,
    EXPECT_NEAR(by(more, Quantity::speed).greatest.time, fastest, 1e-11) << more;  // 7e-14,
  }
}

// By Verlet's method the speed's amplitude is A w sqrt(1 - (w h)^2 / 4): x_n = A cos(n p), sin(p / 2) = w h / 2. Its
// accelerations are too great for that by the share (w h)^2 / 12, which a step with its peak in the middle shows.
const double verlet_speed = 5 * sqrt(63.0 / 64);
constexpr double within_steps = 5 * 0.25 * 0.25 * 0.25 * 0.25 / 96;  // 2.0e-4, measured: 1.6e-4

TEST(PathExtremes, OfSpeedsAreThoseOfTheSummary) {
  for (const char* integrator : {"verlet", "rk4", "euler", "dop853"}) {
    const Scene scene =
        load_text(string("scene: 1\ngravity: [0, 0, 0]\nballs: {b: {mass: 1, radius: 0.05, position: [1, 0, 0]}}\n"
                         "forces: [{spring: {anchor: [0, 0, 0], stiffness: 25}}]\n"
                         "simulate: {duration: 20, engine: stepped, step: 0.05, integrator: ") +
                  integrator + "}");

    const auto simulator = make_simulator(scene, {.watch = {{Quantity::speed, 0, 1}}});
    while (simulator->time() < 20) simulator->advance_to(20);
    const double speed = simulator->extremes().front().greatest.value;
    EXPECT_NEAR(speed, simulator->tally().fastest.speed, 1e-14) << integrator;  // measured: 9e-16
    if (integrator == string("verlet")) {
      EXPECT_NEAR(speed, verlet_speed, within_steps);
    }
  }
}

// The step in which the ball strikes the wall also has its greatest speed, 5 m/s at x = 0.
TEST(PathExtremes, AreThoseOfAStepThatAnImpactEnds) {
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {b: {mass: 1, radius: 0.1, position: [1, 0, 0], restitution: 0}}\n"
      "planes: {wall: {point: [-0.11, 0, 0], normal: [1, 0, 0]}}\n"
      "forces: [{spring: {anchor: [0, 0, 0], stiffness: 25}}]\n";
  const Extremes exact = extremes_of(yaml + "simulate: {duration: 3}", Quantity::speed);
  EXPECT_NEAR(exact.greatest.value, 5, 1e-12);                     // measured: 3e-14
  EXPECT_NEAR(exact.greatest.time, std::numbers::pi / 10, 1e-12);  // measured: 1e-14
  const Extremes verlet =
      extremes_of(yaml + "simulate: {duration: 3, engine: stepped, integrator: verlet, step: 0.05}", Quantity::speed);
  EXPECT_NEAR(verlet.greatest.value, verlet_speed, within_steps);
}

TEST(PathExtremes, OfElasticHopsHaveTheirFirstTime) {
  const string yaml =
      "scene: 1\ngravity: [0, -9.75, 0]\nrestitution: 1\n"
      "balls: {b: {mass: 1, radius: 0.1, position: [0, 1.1, 0], velocity: [0, 1, 0]}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 200}";
  EXPECT_NEAR(extremes_of(yaml, Quantity::y).greatest.time, 1 / 9.75, 1e-16);
  const double impact = (1 + sqrt(1 + 2 * 9.75)) / 9.75;
  EXPECT_NEAR(extremes_of(yaml, Quantity::speed).greatest.time, impact, 1e-15);
  EXPECT_NEAR(extremes_of(yaml, Quantity::y).least.time, impact, 1e-15);
}

// Each hop is higher than the last by 1e-6 of its height: that is no rounding, and the last one counts.
TEST(PathExtremes, ThatGrowHaveTheirLastTime) {
  const Extremes y = extremes_of(
      "scene: 1\ngravity: [0, -9.75, 0]\nrestitution: 1.0000005\n"
      "balls: {b: {mass: 1, radius: 0.1, position: [0, 1.1, 0]}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 20}",
      Quantity::y);
  EXPECT_GT(y.greatest.time, 18);
}

TEST(PathExtremes, ChangeNoResult) {
  const Scene scene = load_text(
      "scene: 1\nroom: {min: [0, 0, 0], max: [1, 1, 1]}\n"
      "groups: {gas: {count: 30, in: {min: [0, 0, 0], max: [1, 1, 1]}, ball: {mass: 1, radius: 0.05}, speed: 1}}\n"
      "simulate: {duration: 1}");
  const auto run = [&](vector<WatchedQuantity> watch) {
    auto simulator = make_simulator(scene, {.watch = std::move(watch)});
    while (simulator->time() < 1) simulator->advance_to(1);
    return simulator;
  };

  const auto plain = run({}), watched = run({{Quantity::speed, 0, 30}, {Quantity::y, 3, 1}});
  for (Entity i = 0; i < 30; ++i) {
    EXPECT_EQ(plain->state().position[i], watched->state().position[i]);
    EXPECT_EQ(plain->state().velocity[i], watched->state().velocity[i]);
  }
  EXPECT_EQ(watched->extremes()[0].greatest.value, plain->tally().fastest.speed);
}

}  // namespace
}  // namespace carom::testing
