// Flights under linear drag, in closed form from impact to impact. They are compared with the references, with roots
// found here by bisection, and with the method of Runge and Kutta.
#include <gtest/gtest.h>

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/exact.h"
#include "simulate/pile.h"
#include "simulate/random.h"
#include "simulate/references.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

Outcome run(const Problem& problem) {
  return run_exact(problem);
}

/// Where a flight x'' = a - k x' is at t (s).
struct Way {
  Vec3 x, v, a;
  double k;
  Vec3 position(double t) const {
    const double s = -std::expm1(-k * t) / k;
    return x + s * v + (t - s) / k * a;
  }
};

TEST(LinearFlight, IsTheReferencesAtAnyTime) {
  const nlohmann::json reference = carom::reference("forces")["linear_drag_3d"];
  const nlohmann::json& params = reference["params"];
  for (const nlohmann::json& c : reference["cases"]) {
    Problem problem;
    problem.world.gravity = {0, 0, -params["g"].get<double>()};
    problem.ball(vec3(params["p0"]), vec3(params["v0"]), 2);
    problem.world.forces = {{Drag{2 * c["k"].get<double>(), 0, Vec3::Zero()}}};

    for (const nlohmann::json& state : c["states"]) {
      problem.options.duration = state["t"];
      const Outcome got = run(problem);
      EXPECT_LT((got.end.position[0] - vec3(state["p"])).norm(), 1e-12) << c["k"];  // of 80 m, measured: 2.7e-13
      EXPECT_LT((got.end.velocity[0] - vec3(state["v"])).norm(), 1e-12) << c["k"];
    }
  }
}

TEST(LinearFlight, BouncesAreTheReferences) {
  const nlohmann::json linear = carom::reference("forces")["linear_drag_bounce"];
  for (const nlohmann::json& c : linear["cases"]) {
    Problem problem;
    problem.world.gravity = {0, -linear["g"].get<double>(), 0};
    problem.ball({0, 0.5 + c["h"].get<double>(), 0}, {0, 0, 0}, 3, 0.5, c["e"]);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.world.forces = {{Drag{3 * c["k"].get<double>(), 0, Vec3::Zero()}}};
    problem.options.duration = c["impacts"].back()["t"].get<double>() + 1e-9;

    const Outcome got = run(problem);
    ASSERT_EQ(got.collisions.size(), c["impacts"].back()["n"].get<size_t>());

    for (const nlohmann::json& impact : c["impacts"]) {
      const Collision& collision = got.collisions[impact["n"].get<size_t>() - 1];
      EXPECT_NEAR(collision.time, impact["t"].get<double>(), 1e-13);
      EXPECT_NEAR(collision.approach_speed, std::abs(impact["v_before"].get<double>()), 1e-12);
    }

    EXPECT_NEAR(residual(problem, got), 0, 1e-10);  // of 29 J, measured: 2e-11
  }
}

TEST(LinearFlight, BallsOfDifferentMassInTheWindMeetWhereTheirPathsDo) {
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.ball({0, 2, 0}, {4, 3, 0.3}, 0.5, 0.2, 0.8);
  problem.ball({3, 2.5, 0.1}, {-3, 2, 0}, 3, 0.3, 0.8);
  const Drag drag{0.9, 0, {1, 0, -2}};
  problem.world.forces = {{drag}, {UniformForce{{0, 0.5, 0.25}}, 0, infinity, {1}}};
  problem.options.duration = 2;
  const Outcome got = run(problem);
  ASSERT_EQ(got.collisions.size(), 1u);

  // Where the closed forms of both paths meet.
  const auto way = [&](Entity i) {
    const double m = problem.world.mass[i], k = drag.linear / m;
    const Vec3 push = i == 1 ? Vec3(Vec3(0, 0.5, 0.25) / m) : Vec3(Vec3::Zero());
    return Way{problem.initial.position[i], problem.initial.velocity[i], problem.world.gravity + push + k * drag.wind,
               k};
  };

  const Way a = way(0), b = way(1);
  double early = 0, late = 0;
  while ((b.position(late) - a.position(late)).norm() > 0.5) late += 1e-4;
  while (late - early > 1e-15) {
    const double t = 0.5 * (early + late);
    ((b.position(t) - a.position(t)).norm() > 0.5 ? early : late) = t;
    if (t == early && t == late) break;
  }

  EXPECT_NEAR(got.collisions[0].time, late, 1e-14);
  EXPECT_LT(got.tally.max_overlap, 1e-14);
  EXPECT_NEAR(residual(problem, got), 0, 1e-11);
}

TEST(LinearFlight, ABouncingBallComesToRestAndDriftsWithTheWind) {
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.ball({0, 2, 0}, {4, 0, 0}, 2, 0.5, 0.9);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.world.forces = {{Drag{0.4, 0, {1, 0, 0}}}};
  problem.options.duration = 40;
  const Outcome got = run(problem);

  const double k = 0.2, s = -std::expm1(-k * 40) / k;
  EXPECT_NEAR(got.end.position[0].x(), 40 + 3 * s, 1e-10);  // the floor has no effect along it
  EXPECT_NEAR(got.end.velocity[0].x(), 1 + 3 * std::exp(-k * 40), 1e-11);

  EXPECT_NEAR(got.end.position[0].y(), 0.5, 1e-12);
  EXPECT_EQ(got.tally.resting, 1u);
  EXPECT_GT(got.collisions.size(), 150u);  // down to hops of 1e-9 s
  EXPECT_NEAR(residual(problem, got), 0, 1e-9);
}

TEST(LinearFlight, WindowsOfTimeBeginAndEndAtTheirTimes) {
  Problem problem;
  problem.ball({0, 0, 0}, {2, 0, 0}, 2);
  problem.world.forces = {{Drag{3, 0, Vec3::Zero()}, 0.123, 0.7891}};
  problem.options.duration = 1;
  const double k = 1.5, w = 0.7891 - 0.123, s = -std::expm1(-k * w) / k, v = 2 * std::exp(-k * w);
  EXPECT_NEAR(run(problem).end.position[0].x(), 2 * 0.123 + 2 * s + (1 - 0.7891) * v, 1e-14);
}

TEST(LinearFlight, IsWhatRungeAndKuttaComeTo) {
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.ball({-1, 1.5, 0.1}, {2, 0, 0}, 2, 0.5, 0.9);
  problem.body(Volume::box({0.4, 0.3, 0.5}), {1.2, 0.6, 0}, {-2, 4, 0.2}, 1, 0.8);
  problem.room({-2, 0, -2}, {2, 3, 2});
  problem.world.forces = {{Drag{1, 0, {0, 0, 1}}}};
  problem.options.duration = 1.5;

  const Outcome exact = run(problem);
  EXPECT_GE(exact.collisions.size(), 4u);

  double last = 0;
  for (const double step : {0.02, 0.01, 0.005}) {
    ExactOptions options;
    options.duration = problem.options.duration;
    options.step = step;
    options.integrator = Integrator::rk4;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, options);

    const Outcome got = run_to_end(*simulator, options.duration);
    double error = 0;
    for (size_t i = 0; i < 2; ++i) error = std::max(error, (got.end.position[i] - exact.end.position[i]).norm());
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 4, 0.3) << step;
    }
    last = error;
  }

  EXPECT_LT(last, 1e-9);
}

TEST(LinearDrag, AHeavyBodyPushesALightOneThatDragHoldsBack) {
  for (const double linear : {0.01, 2.0, 500.0, 1e6}) {
    Problem problem;
    problem.ball({0, 0, 0}, {1, 0, 0}, 9, 0.5, 0);
    problem.ball({1, 0, 0}, {1, 0, 0}, 1, 0.5, 0);
    problem.ball({2, 0, 0}, {1, 0, 0}, 0.25, 0.5, 0);
    problem.world.forces = {{Drag{linear, 0, Vec3::Zero()}}};
    problem.options.duration = 3;

    const Outcome got = run(problem);
    const double k = 3 * linear / 10.25;
    for (Entity i = 0; i < 3; ++i) EXPECT_NEAR(got.end.position[i].x(), i - std::expm1(-3 * k) / k, 1e-12) << linear;

    EXPECT_LT(got.tally.max_overlap, 1e-12);
    EXPECT_EQ(got.tally.stepped_contact, 0);
    EXPECT_NEAR(unbooked(problem, got), 0, 1e-10);
    EXPECT_NEAR(residual(problem, got), 0, 2e-6);  // measured: 1.2e-6 of 5 J: work is summed along parabolas
  }
}

TEST(LinearDrag, TheWindBlowsABoxOffATable) {
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.body(Volume::box({0.4, 0.4, 0.4}), {0, 1.2, 0}, {0, 0, 0}, 2, 0);
  problem.obstacle({0, 0.5, 0}, Volume::box({2, 1, 2}));
  problem.world.forces = {{Drag{3, 0, {2, 0, 0}}}};

  const double k = 1.5;
  const auto x = [&](double t) { return 2 * (t + std::expm1(-k * t) / k); };

  double early = 0, late = 2;  // its trailing edge comes to the rim at 1.2 m
  for (int pass = 0; pass < 60; ++pass) {
    const double t = 0.5 * (early + late);
    (x(t) < 1.2 ? early : late) = t;
  }

  problem.options.duration = late + 0.3;
  const Outcome got = run(problem);

  const double s = -std::expm1(-k * 0.3) / k;
  EXPECT_NEAR(got.end.position[0].x(), x(late + 0.3), 1e-13);
  EXPECT_NEAR(got.end.position[0].y(), 1.2 - 9.80665 * (0.3 - s) / k, 1e-13);
  EXPECT_TRUE(got.collisions.empty());
}

/// A ball slides off a globe: angle'' = g/R sin - k angle' until the surface would have to pull.
struct OffAGlobe {
  double k, angle = 0.1, rate = 0, time = 0;
  static constexpr double g = g_n, reach = 1.5;

  bool presses() const { return g * std::cos(angle) > reach * rate * rate; }
  void step(double h) {
    const auto f = [&](double at, double speed) { return g / reach * std::sin(at) - k * speed; };
    const double a1 = f(angle, rate), v1 = rate;
    const double v2 = rate + h / 2 * a1, a2 = f(angle + h / 2 * v1, v2);
    const double v3 = rate + h / 2 * a2, a3 = f(angle + h / 2 * v2, v3);
    const double v4 = rate + h * a3, a4 = f(angle + h * v3, v4);
    angle += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    time += h;
  }
};

/// Its ball of 2 kg and its globe, under linear drag (kg/s).
Problem off_a_globe(double linear) {
  Problem problem;
  problem.world.gravity = {0, -OffAGlobe::g, 0};
  problem.ball(OffAGlobe::reach * Vec3(std::sin(0.1), std::cos(0.1), 0), Vec3::Zero(), 2, 0.5, 0);
  problem.obstacle({0, 0, 0}, Volume::sphere(1));
  problem.world.forces = {{Drag{linear, 0, Vec3::Zero()}}};
  return problem;
}

TEST(LinearDrag, ABallSlidesOffAGlobeByTheEquationOfItsOneAngle) {
  for (const double linear : {0.3, 4.0, 200.0}) {
    Problem problem = off_a_globe(linear);

    OffAGlobe reference{linear / 2};
    double h = 2e-5;
    while (reference.presses()) {
      const OffAGlobe before = reference;
      reference.step(h);
      if (reference.presses() || h < 1e-12) continue;
      reference = before;
      h /= 10;
    }

    problem.options.duration = reference.time + 0.1;
    const Outcome got = run(problem);

    const Vec3 out(std::sin(reference.angle), std::cos(reference.angle), 0), along(out.y(), -out.x(), 0);
    const Way way{OffAGlobe::reach * out, OffAGlobe::reach * reference.rate * along, problem.world.gravity, linear / 2};

    EXPECT_LT((got.end.position[0] - way.position(0.1)).norm(), 2e-10) << linear;
    EXPECT_LT(got.tally.max_overlap, 1e-12);
    EXPECT_NEAR(residual(problem, got), 0, 1e-9);
  }
}

TEST(LinearDrag, ABallCreepsOverAGlobeInThickAir) {
  for (const double linear : {2e3, 2e4, 2e5}) {
    Problem problem = off_a_globe(linear);
    OffAGlobe reference{linear / 2};
    problem.options.duration = 0.5;
    const Outcome got = run(problem);
    const int steps = static_cast<int>(4 * linear);  // a sixteenth of the time in which drag decays
    for (int k = 0; k < steps; ++k) reference.step(0.5 / steps);
    const Vec3 out(std::sin(reference.angle), std::cos(reference.angle), 0);
    EXPECT_LT((got.end.position[0] - OffAGlobe::reach * out).norm(), 1e-12) << linear;
    EXPECT_EQ(got.tally.collisions(), 0u) << linear;
  }
}

/// Balls of many sizes in a closed box, in units of length, time and mass: some of them come to rest on each other.
Problem in_units(double length, double time, double mass, double linear, int seed) {
  Random random(seed);
  Problem problem;

  problem.world.gravity = Vec3(0, -9.80665 * length / (time * time), 0);
  for (int i = 0; i < 12; ++i) {
    const Vec3 x(i % 2 + 0.5, i / 4 * 0.67 + 0.33, i / 2 % 2 + 0.5), v(random(-2, 2), random(-2, 2), random(-2, 2));
    const double radius = random(0.17, 0.3), m = random(0.3, 3);
    problem.ball(length * x, length / time * v, m * mass, length * radius, random(0, 0.9));
  }

  problem.room(Vec3::Zero(), length * Vec3(2, 4, 2));
  problem.world.forces = {{Drag{linear * mass / time, 0, length / time * Vec3(0.5, 0, -0.25)}}};
  problem.options.duration = 3 * time;
  return problem;
}

TEST(LinearDrag, InOtherUnitsAllIsTheSameToTheLastBit) {
  SLOW_WITH_SANITIZERS();
  for (const double linear : {0.5, 50.0}) {
    const Problem problem = in_units(1, 1, 1, linear, 7);
    const Outcome first = run(problem);
    EXPECT_GE(first.tally.resting, 8u);
    EXPECT_NEAR(unbooked(problem, first), 0, 2e-9);  // of 96 J, measured: 1.04e-9
    EXPECT_NEAR(residual(problem, first), 0, 0.2);   // in a crowd
    EXPECT_LT(first.tally.max_overlap, 1e-8);        // in a crowd; measured: 1.7e-9

    for (const auto& [length, time, mass] :
         {std::tuple(256.0, 1.0, 1.0), {1.0, 256.0, 1.0}, {1.0, 0x1p-10, 1.0}, {0x1p-20, 0x1p10, 0x1p-30}}) {
      const Outcome again = run(in_units(length, time, mass, linear, 7));
      ASSERT_EQ(again.collisions.size(), first.collisions.size());
      for (size_t i = 0; i < 12; ++i) {
        EXPECT_EQ(again.end.position[i], length * first.end.position[i]);
        EXPECT_EQ(again.end.velocity[i], length / time * first.end.velocity[i]);
      }
    }
  }
}

TEST(LinearDrag, MergedBodiesHaveTheDragOfTheirParts) {
  Problem problem;
  problem.ball({0, 0, 0}, {2, 0, 0}, 1, 0.5, 0);
  problem.ball({2, 0, 0}, {0, 0, 0}, 3, 0.5, 0);
  problem.world.forces = {{Drag{0.5, 0, Vec3::Zero()}, 0, infinity, {0}}};
  problem.options.merge = true;
  problem.options.duration = 2;
  const Outcome got = run(problem);
  ASSERT_EQ(got.collisions.size(), 1u);
  const double met = -log(1 - 0.5 * 1 / 2) / 0.5, speed = 2 * std::exp(-0.5 * met) / 4, k = 0.125;
  EXPECT_NEAR(got.collisions[0].time, met, 1e-14);
  EXPECT_NEAR(got.end.position[1].x(), 1 + 0.75 - speed * std::expm1(-k * (2 - met)) / k, 1e-13);
}

// Their faces lie in one plane. The relative path runs in a face of the Minkowski sum and does not enter it.
TEST(LinearDrag, BodiesThatPassWithTheirFacesFlushDoNotMeet) {
  Problem problem;
  problem.body(Volume::box({0.4, 0.4, 0.4}), {-2, 0, 0}, {3, 0, 0});
  problem.body(Volume::box({0.4, 0.6, 0.2}), {0, 0, 0.3}, {0, 0, 0});
  problem.body(Volume::cylinder(0.2, 0.4), {1, 0.4, 0}, {0, 0, 0}, 3);
  problem.obstacle({-1, -0.4, 0}, Volume::box({0.4, 0.4, 0.4}));
  problem.world.forces = {{Drag{0.5, 0, Vec3::Zero()}}};
  problem.options.duration = 1.2;
  const Outcome got = run(problem);
  EXPECT_TRUE(got.collisions.empty());
  EXPECT_NEAR(got.end.position[0].x(), -2 - 6 * std::expm1(-0.6), 1e-14);
}

// A ball leaves a wall, and no force presses it to the wall. Drag on the rounding of its speed is no pressure.
TEST(LinearDrag, LetsAPileSettle) {
  Problem problem = loose_pile(3, 10, 10);
  problem.world.forces = {{Drag{0.2, 0, Vec3::Zero()}}};
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 10);
  EXPECT_LT(kinetic_energy(problem.world, simulator->state()), 1e-3);
  EXPECT_LT(simulator->tally().max_overlap, 1e-10);
}

}  // namespace
}  // namespace carom
