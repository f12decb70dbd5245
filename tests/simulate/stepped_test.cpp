// Flights in steps of a given length: forces against their closed forms, nothing skipped, rest, and things that must
// not matter.
#include "simulate/exact.h"

#include <gtest/gtest.h>

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/pile.h"
#include "simulate/references.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

ExactOptions options_of(const Problem& problem, double step, Integrator method = Integrator::rk4) {
  ExactOptions options;
  options.duration = problem.options.duration;
  options.step = step;
  options.integrator = method;
  return options;
}

Outcome run(const Problem& problem, double step, Integrator method = Integrator::rk4) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, options_of(problem, step, method));
  return run_to_end(*simulator, problem.options.duration);
}

TEST(Forces, LinearDragInThreeDimensionsIsTheReferences) {
  const nlohmann::json reference = carom::reference("forces")["linear_drag_3d"];
  const nlohmann::json& params = reference["params"];
  for (const nlohmann::json& c : reference["cases"]) {
    Problem problem;
    problem.world.gravity = {0, 0, -params["g"].get<double>()};
    problem.ball(vec3(params["p0"]), vec3(params["v0"]), 2);
    problem.world.forces = {{Drag{2 * c["k"].get<double>(), 0, Vec3::Zero()}}};

    for (const nlohmann::json& state : c["states"]) {
      problem.options.duration = state["t"];
      const Outcome got = run(problem, 0.002);
      EXPECT_LT((got.end.position[0] - vec3(state["p"])).norm(), 1e-11) << c["k"];  // measured: 4e-12
      EXPECT_LT((got.end.velocity[0] - vec3(state["v"])).norm(), 1e-11) << c["k"];
    }
  }
}

TEST(Forces, ADampedSpringIsTheReference) {
  const nlohmann::json spring = carom::reference("forces")["damped_spring"];
  Problem problem;
  problem.ball({spring["x0"], 0, 0}, {spring["v0"], 0, 0}, spring["m"]);
  problem.world.forces = {{Spring{Vec3::Zero(), spring["k"], 0, spring["c"]}}};
  for (const nlohmann::json& state : spring["states"]) {
    problem.options.duration = state["t"];
    const Outcome got = run(problem, 0.001);
    EXPECT_NEAR(got.end.position[0].x(), state["x"].get<double>(), 5e-11);  // measured: 1.2e-11
    EXPECT_NEAR(residual(problem, got), 0, 1e-9);
  }
}

void expect_impacts(const Problem& problem, const nlohmann::json& impacts, double step, double tolerance) {
  const Outcome got = run(problem, step);
  for (const nlohmann::json& impact : impacts) {
    const size_t n = impact["n"];
    const double speed =
        std::abs(impact.contains("v_before") ? impact["v_before"].get<double>() : impact["speed_before"].get<double>());
    if (impact["t"].get<double>() > problem.options.duration || speed < 0.05) break;  // hops as short as steps
    ASSERT_GE(got.collisions.size(), n);
    EXPECT_NEAR(got.collisions[n - 1].time, impact["t"].get<double>(), tolerance) << n;
    EXPECT_NEAR(got.collisions[n - 1].approach_speed, speed, tolerance) << n;
  }
}

TEST(Forces, BouncesInAMediumAreTheReferences) {
  const nlohmann::json linear = carom::reference("forces")["linear_drag_bounce"];
  for (const nlohmann::json& c : linear["cases"]) {
    Problem problem;
    problem.world.gravity = {0, -linear["g"].get<double>(), 0};
    problem.ball({0, 0.5 + c["h"].get<double>(), 0}, {0, 0, 0}, 3, 0.5, c["e"]);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.world.forces = {{Drag{3 * c["k"].get<double>(), 0, Vec3::Zero()}}};
    problem.options.duration = 3.2;

    expect_impacts(problem, c["impacts"], 0.001, 1e-10);
  }

  const nlohmann::json quadratic = carom::reference("forces")["quadratic_drag_bounce_1d"];
  for (const nlohmann::json& c : quadratic["cases"]) {
    Problem problem;
    const double g = quadratic["g"], vt = c["vt"];
    problem.world.gravity = {0, -g, 0};
    problem.ball({0, 0.5 + c["h"].get<double>(), 0}, {0, 0, 0}, 3, 0.5, c["e"]);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.world.forces = {{Drag{0, 3 * g / (vt * vt), Vec3::Zero()}}};
    problem.options.duration = 2.3;

    expect_impacts(problem, c["impacts"], 0.001, 1e-8);
  }
}

TEST(Forces, AnOscillatorAgainstAWallIsTheReference) {
  const nlohmann::json oscillator = carom::reference("forces")["impact_oscillator"];
  for (const nlohmann::json& c : oscillator["cases"]) {
    Problem problem;
    const double w = c["omega"];
    problem.ball({c["A0"], 0, 0}, {0, 0, 0}, 1, 0.25, c["e"]);
    problem.plane({c["wall_at"].get<double>() - 0.25, 0, 0}, {1, 0, 0});
    problem.world.forces = {{Spring{Vec3::Zero(), w * w, 0, 0}}};
    problem.options.duration = 8;
    expect_impacts(problem, c["impacts"], 0.0005, 1e-10);
  }
}

TEST(Energy, OfConservativeForcesIsKeptToRounding) {
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  problem.ball({1, 0.3, 0}, {0, 0, 2}, 2, 0.1);
  problem.ball({-1, 0.5, 0}, {0, 1, -2}, 0.5, 0.2);
  problem.room({-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2});
  problem.world.forces = {
      {Spring{{0, 0.4, 0}, 30, 0.5, 0}}, {Attractor{{0, 0, 5}, 20, 0.1}}, {UniformForce{{1, 2, 3}}}};
  problem.options.duration = 5;
  const Outcome got = run(problem, 0.5 * default_step(problem.world, problem.initial));
  EXPECT_GT(got.collisions.size(), 5u);
  EXPECT_LT(std::abs(residual(problem, got)), 1e-12 * kinetic_energy(problem.world, got.end)) << residual(problem, got);
}

TEST(Work, OfForcesThatSetInAndCeaseAndOfTheWindIsBooked) {
  Problem problem;
  problem.ball({1, 0.3, 0}, {0, 0, 2}, 2, 0.1);
  problem.world.forces = {{Spring{{0, 0.4, 0}, 30, 0.5, 1}, 0.5, 2.3}, {Drag{0.1, 0.2, {3, 0, 1}}, 0.2, 3}};
  problem.options.duration = 4;
  const Outcome got = run(problem, 0.001);
  EXPECT_GT(std::abs(got.tally.work), 1);
  EXPECT_NEAR(residual(problem, got), 0, 1e-9);
}

TEST(Paths, NoBodyIsJumpedOverHoweverLongTheStep) {
  Problem problem;
  problem.ball({-30, 0.01, 0}, {100, 0, 0}, 1, 0.05);
  problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.05);
  problem.wall({20, 0, 0}, {1, 0, 0}, 1, 1);
  problem.options.duration = 1;
  for (const Integrator method : {Integrator::euler, Integrator::verlet, Integrator::rk4})
    for (const double step : {1.0, 0.3, 0.01}) {
      const Outcome got = run(problem, step, method);
      ASSERT_EQ(got.collisions.size(), run_exact(problem).collisions.size()) << step;
      EXPECT_NEAR(got.collisions[0].time, run_exact(problem).collisions[0].time, 1e-14);
    }
}

TEST(Paths, ABallIsNotJumpedOverUnderAForceEither) {
  Problem problem;
  problem.ball({-2, 0, 0}, {0, 0, 0}, 1, 0.01);
  problem.wall({1.5, 0, 0}, {1, 0, 0}, 1, 1);
  problem.world.forces = {{Spring{Vec3::Zero(), 4, 0, 0}}};
  problem.options.duration = 1.5;  // at 1.3 s it would be at 1.72 m
  for (const double step : {0.75, 0.5, 0.1}) EXPECT_EQ(run(problem, step).collisions.size(), 1u) << step;
}

/// At the end nothing moves, to the last bit, and nothing overlaps by a millionth of a diameter.
void expect_quiet(const Problem& problem, double step, const char* what) {
  for (const Integrator method : {Integrator::euler, Integrator::verlet, Integrator::rk4}) {
    const auto simulator = make_exact_simulator(problem.world, problem.initial, options_of(problem, step, method));
    go_to(*simulator, problem.options.duration);

    const State& end = simulator->state();
    EXPECT_LT(kinetic_energy(problem.world, end), 1e-20) << what << " " << step;
    EXPECT_EQ(simulator->tally().resting, problem.world.body_count()) << what << " " << step;

    for (Entity a = 0; a < problem.world.body_count(); ++a) {
      const double d = 2 * problem.world.radius[a];
      for (Entity b = 0; b < a; ++b)
        EXPECT_GT((end.position[a] - end.position[b]).norm() - problem.world.radius[a] - problem.world.radius[b],
                  -1e-6 * d);
      for (const Plane& p : problem.world.planes)
        EXPECT_GT((end.position[a] - p.point).dot(p.normal) - problem.world.radius[a], -1e-6 * d);
    }
  }
}

TEST(Rest, AColumnOfTwentyBallsStands) {
  SLOW_WITH_SANITIZERS();
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  for (int k = 0; k < 20; ++k) problem.ball({0, 0.5 + k, 0}, {0, 0, 0}, 1 + k % 3, 0.5, 0.5);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.options.duration = 2;
  expect_quiet(problem, 0.001, "standing");
  expect_quiet(problem, 0.01, "standing");
}

TEST(Rest, AColumnOfTwentyBallsThatFallsApartFromOneAnotherComesToStand) {
  SLOW_WITH_SANITIZERS();
  Problem problem;
  problem.world.gravity = {0, -9.80665, 0};
  for (int k = 0; k < 20; ++k) problem.ball({0, 0.6 + 1.1 * k, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.options.duration = 8;
  expect_quiet(problem, 0.001, "fallen");
  expect_quiet(problem, 0.01, "fallen");
}

TEST(Rest, ABallIsPressedIntoACornerByASpringOrByTheWind) {
  for (const bool wind : {false, true}) {
    Problem problem;
    problem.ball({0.3, 0.4, 0.2}, {1, -2, 0.5}, 2, 0.25, 0.6);
    problem.room({-1, -1, -1}, {1, 1, 1});
    if (wind)
      problem.world.forces = {{Drag{3, 0.5, {5, 4, -3}}}};
    else
      problem.world.forces = {{Spring{{2, 2, -2}, 50, 0, 1}}};

    problem.options.duration = 10;
    expect_quiet(problem, 0.001, wind ? "wind" : "spring");
    expect_quiet(problem, 0.01, wind ? "wind" : "spring");
  }
}

TEST(Outputs, ChangeNothing) {
  SLOW_WITH_SANITIZERS();
  const Problem problem = loose_pile(3, 3, 2);
  const auto once = make_exact_simulator(problem.world, problem.initial, options_of(problem, 0.005));
  go_to(*once, 2);

  const auto often = make_exact_simulator(problem.world, problem.initial, options_of(problem, 0.005));
  for (int k = 0; k <= 777; ++k) {
    go_to(*often, 2.0 * k / 777);
    often->state();
    often->contacts();
  }

  EXPECT_EQ(once->state().position, often->state().position);
  EXPECT_EQ(once->state().velocity, often->state().velocity);
  EXPECT_EQ(once->tally().energy_lost, often->tally().energy_lost);
  EXPECT_EQ(once->tally().work, often->tally().work);
  EXPECT_EQ(once->tally().resting, often->tally().resting);
}

// To the last bit, where forces work, clusters slide and a contact group settles.
TEST(Outputs, RequestedTwiceAreTheSame) {
  Problem problem = loose_pile(3, 3, 2);
  problem.ball({-3, 0.5, 0}, {1, 0, 0}, 1, 0.5, 0.5);
  problem.world.forces = {{Drag{0.1, 0.01, Vec3::Zero()}, 0.1}};

  const auto simulator = make_exact_simulator(problem.world, problem.initial, options_of(problem, 0.005));
  for (const double time : {0.0, 0.123, 0.777, 1.5, 2.0}) {
    go_to(*simulator, time);

    const Tally before = simulator->tally();
    const State first = simulator->state();
    const auto forces = simulator->contacts();
    const vector<ContactForce> requested(forces.begin(), forces.end());
    const State& second = simulator->state();
    const auto again = simulator->contacts();

    EXPECT_EQ(first.position, second.position) << time;
    EXPECT_EQ(first.velocity, second.velocity) << time;
    ASSERT_EQ(requested.size(), again.size()) << time;
    for (size_t k = 0; k < requested.size(); ++k) EXPECT_EQ(requested[k].force, again[k].force) << time;

    EXPECT_EQ(before.energy_lost, simulator->tally().energy_lost) << time;
    EXPECT_EQ(before.work, simulator->tally().work) << time;
  }
}

// A sleeping body is struck within a step. Until then samples have it at rest, and not in the state of the step's end.
TEST(Sampling, ASleepingBodyStaysUntilItIsStruck) {
  Problem problem;
  problem.ball({-1, 0.5, 0}, {2, 0, 0}, 1, 0.5);
  problem.ball({1, 0.5, 0}, {0, 0, 0}, 1, 0.5);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.options.duration = 2;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, options_of(problem, 1));
  simulator->advance_to(0.25);

  for (const double time : {0.3, 0.4, 0.49}) {  // they meet at 0.5 s, each ball moves at 2 m/s for half of the step
    simulator->advance_to(time);
    EXPECT_EQ(simulator->state().position[1].x(), 1) << time;
    EXPECT_EQ(simulator->state().velocity[1].x(), 0) << time;
  }

  simulator->advance_to(0.75);
  EXPECT_NEAR(simulator->state().position[1].x(), 1.5, 1e-12);
}

}  // namespace
}  // namespace carom
