// The step that a tolerance asks for.
#include "simulate/step_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/build.h"

namespace carom {
namespace {

StepChoice choose(const Problem& problem, double tolerance) {
  ExactOptions options;
  options.duration = problem.options.duration;
  options.integrator = Integrator::rk4;
  return choose_step(problem.world, problem.initial, options, tolerance, [] {});
}

TEST(StepChoice, IsWithinTheToleranceOfTheClosedForm) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, 0, 0}, 1, 0.1);
  problem.world.forces = {{Spring{Vec3::Zero(), 4, 0, 0}}};
  problem.options.duration = 10;
  double last = 1;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const StepChoice choice = choose(problem, tolerance);
    EXPECT_LE(choice.difference, tolerance);
    EXPECT_GT(choice.chaotic_from, problem.options.duration);
    EXPECT_LT(choice.step, last);
    last = choice.step;
    ExactOptions options;
    options.duration = 10;
    options.step = choice.step;
    options.integrator = Integrator::rk4;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, options);
    go_to(*simulator, 10);
    EXPECT_NEAR(simulator->state().position[0].x(), std::cos(20), tolerance);
  }
}

TEST(StepChoice, ChaosIsToldAndFromWhenOn) {
  Problem problem;  // balls among balls: errors grow tenfold at each collision
  for (int k = 0; k < 12; ++k)
    problem.ball({-0.75 + 0.5 * (k % 4), -0.5 + 0.5 * (k / 4), 0.01 * k}, {std::cos(k), std::sin(3 * k), 0.3}, 1, 0.15);
  problem.room({-1, -1, -1}, {1, 1, 1});
  problem.world.forces = {{Spring{Vec3::Zero(), 1, 0, 0}}};
  problem.options.duration = 60;
  const StepChoice choice = choose(problem, 1e-6);
  EXPECT_GT(choice.difference, 1e-3);
  EXPECT_GT(choice.chaotic_from, 2);
  EXPECT_LT(choice.chaotic_from, 40);
}

TEST(StepChoice, GoesShorterWhereStepsAreTooLongForTheForces) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, 0, 0}, 1, 0.1);
  problem.world.forces = {{Drag{0, 1e4, {0, 3, 0}}}};  // stiff: longer steps throw the ball to infinity
  problem.options.duration = 1;
  EXPECT_LE(choose(problem, 1e-6).difference, 1e-6);
}

}  // namespace
}  // namespace carom
