// A lattice of springs over many periods.
#include <gtest/gtest.h>

#include <numbers>

#include "simulate/build.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// 8 x 8 x 8 balls of 0.02 kg, 0.1 m apart, on 1344 springs of 400 N/m along edges and 2352 of 100 N/m across squares.
Problem lattice() {
  constexpr int n = 8;
  Problem problem;
  const auto join = [&](int i, int j, int k, int x, int y, int z, double stiffness) {
    if (min({i, j, k, x, y, z}) < 0 || max({i, j, k, x, y, z}) >= n) return;
    const auto a = Entity((i * n + j) * n + k);
    const auto b = Entity((x * n + y) * n + z);
    const double rest = (problem.initial.position[a] - problem.initial.position[b]).norm();
    problem.world.springs.push_back({min(a, b), max(a, b), stiffness, rest, 0});
  };

  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        problem.ball(
            0.1 * Vec3(i, j, k),
            {0.3 * std::sin(0.8 * j + 0.2 * i), 0.2 * std::cos(1.3 * k + 0.5 * j), 0.25 * std::sin(i - 0.9 * k)}, 0.02,
            0.01);

  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        join(i, j, k, i + 1, j, k, 400);
        join(i, j, k, i, j + 1, k, 400);
        join(i, j, k, i, j, k + 1, 400);

        // Both ways across each square.
        for (const int side : {-1, 1}) {
          join(i, j, k, i + 1, j + side, k, 100);
          join(i, j, k, i + 1, j, k + side, 100);
          join(i, j, k, i, j + 1, k + side, 100);
        }
      }
  return problem;
}

TEST(Lattice, KeepsItsEnergyOverAHundredPeriods) {
  SLOW_WITH_SANITIZERS();
  Problem problem = lattice();
  ASSERT_EQ(problem.world.springs.size(), 3696u);
  problem.options.duration = 100 * 2 * std::numbers::pi * sqrt(0.02 / 400);
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.tally.collisions(), 0u);
  EXPECT_NEAR(residual(problem, run), 0, 1e-9 * energy(problem, problem.initial));  // measured: 3e-15 of the energy
}

}  // namespace
}  // namespace carom
