// A pile jams, and then it is at rest: no motion at all, all forces in balance.
#include "simulate/pile.h"
#include "physics/world.h"
#include "slow_with_sanitizers.h"

namespace carom {
namespace {

TEST(Pile, OfNinetyBallsComesToRest) {
  SLOW_WITH_SANITIZERS();
  const Problem problem = loose_pile(3, 10, 1000);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  expect_pile_at_rest(problem, *simulator, {900, 950, 1000}, 1e-9, 1e-9, 0, 1);
}

TEST(Pile, OfThreeHundredBallsComesToRestBySweeps) {
  SLOW_WITH_SANITIZERS();
  const Problem problem = loose_pile(5, 12, 60);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  expect_pile_at_rest(problem, *simulator, {50, 60}, 1e-9, 1e-9, 0, 1);
}

TEST(Pile, AWokenPileComesToRestAgain) {
  Problem problem = loose_pile(3, 4, 60);
  // A heavy ball falls on the pile at rest.
  problem.ball({1.7, 1800, 1.6}, Vec3::Zero(), 1, 0.5, 0.5);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 18);
  EXPECT_EQ(simulator->tally().resting, problem.world.body_count() - 1);
  expect_pile_at_rest(problem, *simulator, {58, 60}, 1e-9, 1e-9, 0, 2);
}

/// Errors of a crowd may raise the energy, by less than 5e-5 of it.
TEST(Pile, GainsHardlyAnyEnergyAsItSettles) {
  SLOW_WITH_SANITIZERS();
  for (int side : {3, 4, 5}) {
    const Problem problem = loose_pile(side, 6, 20);
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    double least = std::numeric_limits<double>::infinity();
    for (double t = 0; t <= 20; t += 0.0625) {
      go_to(*simulator, t);
      const State& state = simulator->state();
      const double energy = kinetic_energy(problem.world, state) + potential_energy(problem.world, state);
      EXPECT_LT(energy, (1 + 5e-5) * least) << side << " at " << t;
      least = std::min(least, energy);
    }
  }
}

}  // namespace
}  // namespace carom
