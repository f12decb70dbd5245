#include <ctime>

#include "simulate/pile.h"

namespace carom {
namespace {

TEST(LongPile, OfAThousandBallsComesToRest) {
  const Problem problem = loose_pile(10, 10, 1000);
  const std::clock_t start = std::clock();
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

  double rest = 0;
  for (double t = 0.5; t <= 900; t += 0.5) {
    go_to(*simulator, t);
    const double kinetic = kinetic_energy(problem.world, simulator->state());
    if (energy_of_pile(problem.world, *simulator) > 0) rest = t;
    if (t == 2 || t == 5 || t == 10 || t == 20)
      std::printf("%g s: %.3g J, %.1f s of CPU time\n", t, kinetic,
                  static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }

  std::printf("at rest from %g s on, %.1f s of CPU time\n", rest + 0.5,
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  expect_pile_at_rest(problem, *simulator, {950, 1000});
}

}  // namespace
}  // namespace carom
