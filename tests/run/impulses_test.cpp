// Impulses of contact, against closed forms and against the change of momentum, in every sort of contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "physics/energy.h"
#include "physics/world.h"
#include "run/measured.h"
#include "std.h"

namespace carom::testing {
namespace {

constexpr double g_10 = 10;  // m/s^2

string on_floor(const string& balls, const string& more) {
  return "scene: 1\ngravity: [0, -10, 0]\nballs:\n" + balls +
         "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n" + more;
}

/// Over a run, forces on all bodies by gravity and contact change the momentum: the floor gives what is missing.
void expect_momentum(const string& yaml, double tolerance) {
  const Scene scene = load_text(yaml);
  const MeasuredScene run = run_measured(yaml, {"impulse(floor)"});
  double mass = 0;
  for (const double of : scene.world.mass) mass += of;
  const double gained = momentum(scene.world, run.end).y() - momentum(scene.world, scene.initial).y();
  const double expected = mass * -scene.world.gravity.y() * scene.simulate.duration + gained;
  EXPECT_NEAR(run.values[0], expected, tolerance * expected) << run.tally.stepped_contact;
}

TEST(Impulses, OfElasticBouncesAreTwiceTheMomentumEach) {
  // It falls by 1.25 m in 0.5 s, and bounces each second.
  const auto all = measured(
      on_floor("  b: {mass: 3, radius: 0.1, position: [0, 1.35, 0], restitution: 1}\n", "simulate: {duration: 4}"),
      {"impulse(floor)", "impulse(b, floor)", "impulse(floor, b)", "impulse(b)", "impulse(b, from: 1, until: 3)",
       "impulse(b, from: 0.6)"});
  for (const size_t k : {0u, 1u, 2u, 3u}) EXPECT_NEAR(all[k], 4 * 2 * 3 * 5, 1e-12);
  EXPECT_NEAR(all[4], 2 * 2 * 3 * 5, 1e-12);
  EXPECT_NEAR(all[5], 3 * 2 * 3 * 5, 1e-12);
}

TEST(Impulses, OfABallAtRestAreItsWeightTimesTheTime) {
  const auto all = measured(on_floor("  b: {mass: 2, radius: 0.1, position: [0, 0.1, 0]}\n", "simulate: {duration: 7}"),
                            {"impulse(b, floor)", "impulse(floor, from: 1.25, until: 1.5)", "impulse(b, from: 6)"});
  EXPECT_NEAR(all[0], 2 * g_10 * 7, 140e-12);
  EXPECT_NEAR(all[1], 2 * g_10 * 0.25, 5e-12);
  EXPECT_NEAR(all[2], 2 * g_10, 20e-12);
}

TEST(Impulses, OfBouncesThatEndInRestAreThoseOfTheMomentum) {
  for (const char* e : {"0", "0.5", "0.9"})
    expect_momentum(on_floor(fmt::format("  b: {{mass: 2, radius: 0.1, position: [0, 1, 0], restitution: {}}}\n", e),
                             "simulate: {duration: 12}"),
                    1e-12);
  // While bounces go on that are too low to follow, each moment has its part of them.
  const auto settling = measured(on_floor("  b: {mass: 2, radius: 0.1, position: [0, 0.6, 0], restitution: 0.5}\n",
                                          "simulate: {duration: 4, rest_speed: 10}"),
                                 {"impulse(floor)", "impulse(floor, from: 2)"});
  EXPECT_NEAR(settling[0], 2 * g_10 * 4, 1e-10);
  EXPECT_NEAR(settling[1], 2 * g_10 * 2, 1e-11);
}

TEST(Impulses, OfSlidingAreThoseOfTheNormalForce) {
  const double a = 30 * std::numbers::pi / 180;
  const string slope = fmt::format(
      "scene: 1\ngravity: [0, -10, 0]\nballs: {{b: {{mass: 2, radius: 0.1, position: [{0}, {1}, 0]}}}}\n"
      "planes: {{slope: {{point: [0, 0, 0], normal: [{2}, {3}, 0]}}}}\n",
      0.1 * sin(a), 0.1 * cos(a), sin(a), cos(a));
  EXPECT_NEAR(value_of("impulse(slope)", slope + "simulate: {duration: 3}"), 2 * g_10 * cos(a) * 3, 1e-10);
  // Drag slows it and does not press.
  EXPECT_NEAR(value_of("impulse(slope)", slope + "forces: [{drag: {linear: 4}}]\nsimulate: {duration: 3}"),
              2 * g_10 * cos(a) * 3, 1e-10);
}

TEST(Impulses, OfABallBetweenTwoThingsAreThoseOfBothForces) {
  // Two planes at right angles.
  const string trough =
      "scene: 1\ngravity: [0, -10, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [0, 0.14142135623730953, 0]}}\n"
      "planes: {left: {point: [0, 0, 0], normal: [1, 1, 0]}, right: {point: [0, 0, 0], normal: [-1, 1, 0]}}\n"
      "simulate: {duration: 5}";
  const auto planes = measured(trough, {"impulse(left)", "impulse(right)", "impulse(b)"});
  EXPECT_NEAR(planes[0], 2 * g_10 * 5 / sqrt(2), 1e-10);
  EXPECT_NEAR(planes[1], 2 * g_10 * 5 / sqrt(2), 1e-10);
  EXPECT_NEAR(planes[2], 2 * g_10 * 5 * sqrt(2), 2e-10);

  // A ball on two fixed ones sleeps.
  const string round =
      "scene: 1\ngravity: [0, -10, 0]\nballs: {b: {mass: 2, radius: 0.5, position: [0, 0.8, 0]}}\n"
      "obstacles: {left: {radius: 0.5, position: [-0.6, 0, 0]}, right: {radius: 0.5, position: [0.6, 0, 0]}}\n"
      "simulate: {duration: 5}";
  const auto spheres = measured(round, {"impulse(left, b)", "impulse(right)", "impulse(left, from: 2, until: 3)"});
  EXPECT_NEAR(spheres[0], 2 * g_10 * 5 / (2 * 0.8), 1e-10);
  EXPECT_NEAR(spheres[1], 2 * g_10 * 5 / (2 * 0.8), 1e-10);
  EXPECT_NEAR(spheres[2], 2 * g_10 / (2 * 0.8), 1e-11);
}

TEST(Impulses, OfAStackAreTheWeightsAbove) {
  const string stack = on_floor(
      "  low: {mass: 2, radius: 0.1, position: [0, 0.1, 0]}\n"
      "  high: {mass: 3, radius: 0.1, position: [0, 0.3, 0]}\n",
      "simulate: {duration: 5}");
  const auto all = measured(stack, {"impulse(low, high)", "impulse(floor)", "impulse(low)", "impulse(high, floor)"});
  EXPECT_NEAR(all[0], 3 * g_10 * 5, 1e-10);
  EXPECT_NEAR(all[1], 5 * g_10 * 5, 1e-10);
  EXPECT_NEAR(all[2], 8 * g_10 * 5, 1e-10);
  EXPECT_EQ(all[3], 0);
}

/// The complete elliptic integrals K and E of modulus k, by the arithmetic-geometric mean.
pair<double, double> elliptic(double k) {
  double a = 1, b = sqrt(1 - k * k), sum = 0.5 * k * k, power = 0.5;
  for (int n = 0; n < 8; ++n) {
    const double c = 0.5 * (a - b);
    tie(a, b) = pair(0.5 * (a + b), sqrt(a * b));
    power *= 2;
    sum += power * c * c;
  }
  const double first = std::numbers::pi / (2 * a);
  return {first, first * (1 - sum)};
}

/// A pendulum of 2 kg and 1 m that begins at rest at an angle (degrees).
string pendulum(double degrees, const string& more, double duration) {
  const double angle = degrees * std::numbers::pi / 180;
  return fmt::format(
      "scene: 1\ngravity: [0, -10, 0]\nballs: {{bob: {{mass: 2, radius: 0.1, position: [{:.17g}, {:.17g}, 0]}}}}\n"
      "strings: {{line: {{from: [0, 0, 0], to: bob, length: 1{}}}}}\nsimulate: {{duration: {:.17g}}}",
      sin(angle), -cos(angle), more, duration);
}

TEST(Impulses, OfAPendulumsStringAreTheIntegralOfItsTension) {
  // Tension m g (3 cos - 2 cos of the amplitude); over a period cos has the mean 2 E / K - 1.
  const double angle = 60 * std::numbers::pi / 180;
  const auto [first, second] = elliptic(sin(angle / 2));
  const double period = 4 * first / sqrt(g_10);
  const double expected = 2 * g_10 * period * (3 * (2 * second / first - 1) - 2 * cos(angle));

  const auto all = measured(pendulum(60, "", period),
                            {"impulse(line)", "impulse(bob, line)", "impulse(bob)", "impulse(line, until: 0.31)",
                             "impulse(line, from: 0.31, until: 1.1)", "impulse(line, from: 1.1)"});
  for (const size_t k : {0u, 1u, 2u}) EXPECT_NEAR(all[k], expected, 1e-11 * expected);
  EXPECT_NEAR(all[3] + all[4] + all[5], all[0], 1e-11 * expected);
}

TEST(Impulses, OfARodAreThoseOfPushesAndPullsAlike) {
  // From nearly upright: the rod pushes first, while cos of the angle below is less than 2/3 of cos at the start.
  const double angle = 150 * std::numbers::pi / 180;
  const double duration = 1.5;
  double sum = 0, theta = angle, omega = 0;
  constexpr int steps = 200000;
  const double h = duration / steps;

  for (int k = 0; k < steps; ++k) {
    const auto force = [&](double at) { return std::abs(2 * g_10 * (3 * cos(at) - 2 * cos(angle))); };
    const double before = force(theta);
    omega -= 0.5 * h * g_10 * sin(theta);
    theta += h * omega;
    omega -= 0.5 * h * g_10 * sin(theta);
    sum += 0.5 * h * (before + force(theta));
  }
  EXPECT_NEAR(value_of("impulse(line)", pendulum(150, ", rod: true", duration)), sum, 1e-8 * sum);
}

TEST(Impulses, OfAHangingChainAreTheWeightsBelow) {
  const string chain =
      "scene: 1\ngravity: [0, -10, 0]\nballs:\n"
      "  a: {mass: 1, radius: 0.1, position: [0, -1, 0]}\n  b: {mass: 2, radius: 0.1, position: [0, -2, 0]}\n"
      "strings: {top: {from: [0, 0, 0], to: a}, low: {from: a, to: b}}\nsimulate: {duration: 5}";
  const auto all = measured(chain, {"impulse(top)", "impulse(low)", "impulse(a)", "impulse(b)", "impulse(a, low)"});
  EXPECT_NEAR(all[0], 3 * g_10 * 5, 1e-10);
  EXPECT_NEAR(all[1], 2 * g_10 * 5, 1e-10);
  EXPECT_NEAR(all[2], 5 * g_10 * 5, 1e-10);
  EXPECT_NEAR(all[3], 2 * g_10 * 5, 1e-10);
  EXPECT_NEAR(all[4], 2 * g_10 * 5, 1e-10);
}

TEST(Impulses, OfAStringThatGoesTautAreThoseOfItsJerk) {
  // It falls by 0.8 m to 4 m/s, is stopped in 1/3 of its restitution, and falls on.
  const string yaml =
      "scene: 1\ngravity: [0, -10, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [0, -0.2, 0]}}\n"
      "strings: {line: {from: [0, 0, 0], to: b, length: 1}}\nsimulate: {duration: 2}";
  const MeasuredScene run = run_measured(yaml, {"impulse(line)"});
  EXPECT_NEAR(run.values[0], 2 * g_10 * 2, 1e-10);
}

TEST(Impulses, PassThroughARodAtAnImpact) {
  // A striker meets a bob on a rod at 45 degrees. The rod takes what the bob cannot follow: the change of the momentum
  // along it.
  const string yaml =
      "scene: 1\ngravity: [0, 0, 0]\nballs:\n  bob: {mass: 2, radius: 0.1, position: [0, -1, 0], restitution: 0.7}\n"
      "  striker: {mass: 3, radius: 0.1, position: [-0.5, -0.5, 0], velocity: [2, -2, 0], restitution: 0.7}\n"
      "strings: {line: {from: [0, 0, 0], to: bob, rod: true}}\n";
  const double met = (sqrt(0.5) - 0.2) / sqrt(8);
  const string until = fmt::format("simulate: {{duration: {:.17g}}}", met + 1e-9);
  const MeasuredScene run = run_measured(yaml + until, {"impulse(line)", "impulse(bob, striker)"});
  const double gained = 2 * run.end.velocity[0].y() + 3 * (run.end.velocity[1].y() + 2);
  EXPECT_GT(gained, 1);
  EXPECT_NEAR(run.values[0], gained, 1e-7);
  EXPECT_NEAR(run.values[1], 3 * (run.end.velocity[1] - Vec3(2, -2, 0)).norm(), 1e-12);
}

TEST(Impulses, OfImpactsAtOneInstantAreThoseOfTheMomentum) {
  for (const char* e : {"1", "0.6", "0"}) {
    const string row = fmt::format(
        "scene: 1\ngravity: [0, 0, 0]\nrestitution: {}\nballs:\n"
        "  a: {{mass: 1, radius: 0.1, position: [0.1, 0, 0]}}\n  b: {{mass: 2, radius: 0.1, position: [0.3, 0, 0]}}\n"
        "  c: {{mass: 3, radius: 0.1, position: [1, 0, 0], velocity: [-2, 0, 0]}}\n"
        "planes: {{end: {{point: [0, 0, 0], normal: [1, 0, 0]}}}}\nsimulate: {{duration: 0.6}}",
        e);
    const MeasuredScene run = run_measured(row, {"impulse(end)", "impulse(b, c)"});
    const double momentum = run.end.velocity[0].x() + 2 * run.end.velocity[1].x() + 3 * run.end.velocity[2].x();
    EXPECT_NEAR(run.values[0], momentum + 6, 1e-12) << e;
    EXPECT_NEAR(run.values[1], 3 * run.end.velocity[2].x() + 6, 1e-12) << e;
  }
}

TEST(Impulses, OfASpringThatPressesAreThoseOfItsForce) {
  // The engine takes steps here: 2 kg under a spring of 100 N/m, 0.4 m too long.
  const string yaml = on_floor("  b: {mass: 2, radius: 0.1, position: [0, 0.1, 0]}\n",
                               "forces: [{spring: {anchor: [0, 0.7, 0], stiffness: 100, rest_length: 1}}]\n"
                               "simulate: {duration: 3}");
  EXPECT_NEAR(value_of("impulse(floor)", yaml), (2 * g_10 + 100 * 0.4) * 3, 1e-9);
}

TEST(Impulses, OfAFloorThatMovesAreThoseOfTheMomentum) {
  const string yaml =
      "scene: 1\ngravity: [0, -10, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [0, 0.1, 0], restitution: 0}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0], motion: [{from: 1, until: 2, velocity: [0, 3, 0]}]}}\n"
      "simulate: {duration: 4}";
  expect_momentum(yaml, 1e-12);
  // A piston gives 2 m (v + u) to a ball that comes at v.
  const string piston =
      "scene: 1\ngravity: [0, 0, 0]\nballs: {b: {mass: 2, radius: 0.1, position: [2.1, 0, 0], velocity: [-3, 0, 0]}}\n"
      "planes: {piston: {point: [0, 0, 0], normal: [1, 0, 0], motion: [{velocity: [1, 0, 0]}]}}\n"
      "simulate: {duration: 1}";
  EXPECT_NEAR(value_of("impulse(piston)", piston), 2 * 2 * 4, 1e-12);
}

TEST(Impulses, EndWithARunThatIsStopped) {
  const string yaml = pendulum(60, "", 2);
  const string stopped = yaml.substr(0, yaml.rfind("simulate")) +
                         "regions: {right: {plane: {point: [0.2, 0, 0], normal: [-1, 0, 0]}}}\n"
                         "simulate: {duration: 2, stop: [{region: right}]}";
  const MeasuredScene run = run_measured(stopped, {"impulse(line)"});
  const double end = run.tally.end->time;
  EXPECT_LT(end, 0.6);
  EXPECT_NEAR(run.values[0], value_of(fmt::format("impulse(line, until: {:.17g})", end), yaml), 1e-10);
}

const char* const pile =
    "scene: 1\nseed: 3\ngravity: [0, -10, 0]\nrestitution: 0.4\n"
    "groups: {grain: {count: 120, ball: {density: 1000, radius: 0.05}, in: {min: [0, 0, 0], max: [0.6, 2, 0.6]}}}\n"
    "planes:\n  floor: {point: [0, 0, 0], normal: [0, 1, 0]}\n  left: {point: [0, 0, 0], normal: [1, 0, 0]}\n"
    "  right: {point: [0.6, 0, 0], normal: [-1, 0, 0]}\n  back: {point: [0, 0, 0], normal: [0, 0, 1]}\n"
    "  front: {point: [0, 0, 0.6], normal: [0, 0, -1]}\n";

/// The pile's impulses less those that its change of momentum demands, as shares of its weight's: on the floor, across
/// the two other axes. `more`: other measures, of which the values follow.
vector<double> deviations(double duration, const vector<string>& more = {}) {
  const string yaml = string(pile) + fmt::format("simulate: {{duration: {}}}", duration);
  const Scene scene = load_text(yaml);
  vector<string> measures = {"impulse(floor)", "impulse(left)", "impulse(right)", "impulse(back)", "impulse(front)"};
  measures.insert(measures.end(), more.begin(), more.end());
  const MeasuredScene run = run_measured(yaml, measures);
  EXPECT_GT(run.tally.stepped_contact, 10);

  double mass = 0;
  for (const double of : scene.world.mass) mass += of;
  const Vec3 gained = momentum(scene.world, run.end) - momentum(scene.world, scene.initial);
  const double all = mass * g_10 * duration;
  vector<double> found = {(run.values[0] - gained.y()) / all - 1, (run.values[1] - run.values[2] - gained.x()) / all,
                          (run.values[3] - run.values[4] - gained.z()) / all};
  for (size_t k = 5; k < run.values.size(); ++k) found.push_back(run.values[k] / (mass * g_10));
  return found;
}

TEST(Impulses, OfACrowdAreThoseOfTheMomentum) {
  for (const double of : deviations(1)) EXPECT_NEAR(of, 0, 1e-13);
}

TEST(Impulses, OfAPileAtRestAreItsWeightTimesTheTime) {
  // Forces are in balance to 1e-7 of the load where it falls asleep, and what is left of the momentum ends there.
  const auto found = deviations(4, {"impulse(floor, from: 3)", "impulse(floor, until: 3)", "impulse(floor)"});
  for (const size_t k : {0u, 1u, 2u}) EXPECT_NEAR(found[k], 0, 1e-6);
  EXPECT_NEAR(found[3], 1, 1e-6);
  EXPECT_NEAR(found[3] + found[4], found[5], 1e-12);
}

TEST(Impulses, OfAGasOnItsWallsAreThePressureOfTheGasLaw) {
  // Small balls without gravity: p V = N m <v^2> / 3, in the volume of the centres.
  const string yaml =
      "scene: 1\nseed: 5\ngravity: [0, 0, 0]\nroom: {min: [0, 0, 0], max: [1, 1, 1]}\n"
      "groups: {gas: {count: 400, ball: {mass: 0.01, radius: 0.004}, in: {min: [0, 0, 0], max: [1, 1, 1]}, speed: 1}}\n"
      "simulate: {duration: 20}";
  const MeasuredScene run =
      run_measured(yaml, {"impulse(room.x_min)", "impulse(room.x_max)", "impulse(room)", "hits(gas, room)",
                          "mean(groups.gas.kinetic_J)", "impulse(gas, room.x_max)"});

  const Scene scene = load_text(yaml);
  const double gained = momentum(scene.world, run.end).x() - momentum(scene.world, scene.initial).x();
  EXPECT_NEAR(run.values[0] - run.values[1], gained, 1e-11);
  EXPECT_EQ(run.values[1], run.values[5]);

  const double side = 1 - 2 * 0.004;
  const double pressure = run.values[2] / (6 * side * side * 20);
  const double expected = 400 * 2 * run.values[4] / (3 * side * side * side);
  // Impulses of n hits differ by about half of their mean, and the balls' own volume adds 4 N v / V.
  const double error = 0.5 / sqrt(run.values[3]), volume = 400 * 16 / 3.0 * std::numbers::pi * std::pow(0.004, 3);
  EXPECT_NEAR(pressure / expected, 1, 3 * error + volume);
}

TEST(Impulses, NameWhatIsWrong) {
  const string yaml = on_floor("  b: {mass: 2, radius: 0.1, position: [0, 0.1, 0]}\n", "simulate: {duration: 7}");
  const auto fault = [&](const string& scene, const string& text) {
    try {
      parse_measure(text, load_text(scene));
      return string();
    } catch (const MeasureError& error) {
      return string(error.what());
    }
  };

  EXPECT_EQ(fault(yaml, "impulse(flor)"), "`impulse(flor)`: nothing is named `flor`; did you mean `floor`?");
  EXPECT_EQ(fault(yaml, "impulse(a, b, c)"),
            "`impulse(a, b, c)`: expected one or two names, such as impulse(red, floor)");
  EXPECT_EQ(
      fault(on_floor("  b: {mass: 2, radius: 0.1, position: [0, 1, 0]}\n", "simulate: {duration: 7, engine: book}"),
            "impulse(floor)"),
      "`impulse(floor)`: the engine `book` has no impulse of lasting contact; expected `engine: exact` or "
      "`stepped`, or hits(a, b)");
}

}  // namespace
}  // namespace carom::testing
