// One hash for every build: release, debug and sanitized programs print the same numbers to the last bit.
#include <gtest/gtest.h>

#include <cstring>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/exact.h"
#include "simulate/random.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// FNV-1a over the bits of positions, velocities and the number of collisions.
uint64_t hash_of(const Outcome& run) {
  uint64_t hash = 14695981039346656037ull;
  const auto add = [&hash](const void* data, size_t size) {
    for (size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211ull;
  };
  add(run.end.position.data(), run.end.position.size() * sizeof(Vec3));
  add(run.end.velocity.data(), run.end.velocity.size() * sizeof(Vec3));
  const uint64_t collisions = run.tally.collisions();
  add(&collisions, sizeof collisions);
  return hash;
}

Problem lattice(double e, double g) {
  Random random;
  Problem problem;
  problem.world.gravity = Vec3(0, -g, 0);
  for (int i = 0; i < 125; ++i) {
    // One after another: the order of arguments' evaluation is the compiler's.
    const double w = random(-1, 1), v = random(-1, 1), u = random(-1, 1);
    const double radius = random(0.2, 0.5), mass = random(1, 2);
    problem.ball(Vec3(i % 5 + 0.5, i / 5 % 5 + 0.5, i / 25 + 0.5) * 1.25, {u, v, w}, mass, radius, e);
  }
  problem.room({0, 0, 0}, Vec3::Constant(6.25));
  problem.wall({3, 0.1, 3}, {1, 0.25, 0.5}, 0.25, 0.125);
  problem.options.duration = 4;
  return problem;
}

TEST(Determinism, AGasHasTheSameBitsInEveryBuild) {
  EXPECT_EQ(hash_of(run_exact(lattice(1, 0))), 13059839650545928928u);
}

TEST(Determinism, BallsThatSettleHaveTheSameBitsInEveryBuild) {
  EXPECT_EQ(hash_of(run_exact(lattice(0.7, 4))), 4313375254507442981u);
}

TEST(Determinism, TheBooksLoopHasTheSameBitsInEveryBuild) {
  const Problem problem = lattice(0.9, 1);
  const auto simulator = make_book_simulator(problem.world, problem.initial, {1.0 / 120, false, 0, true});
  EXPECT_EQ(hash_of(run_to_end(*simulator, 2)), 15455406752589464552u);
}

TEST(Determinism, ACrowdInStepsHasTheSameBitsInEveryBuild) {
  SLOW_WITH_SANITIZERS();
  Problem problem = lattice(0.5, 9);
  problem.world.forces = {{Drag{0.1, 0.05, {0.5, 0, 0}}}};

  ExactOptions options;
  options.duration = 3;
  options.step = 0.005;

  for (const auto& [method, hash] :
       {pair(Integrator::euler, 16177003933122412586u), pair(Integrator::verlet, 11117665312863948820u),
        pair(Integrator::rk4, 10729463312428075050u)}) {
    options.integrator = method;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, options);
    EXPECT_EQ(hash_of(run_to_end(*simulator, 3)), hash) << static_cast<int>(method);
  }
}

TEST(Determinism, ARepeatGivesTheSameBits) {
  const Problem problem = lattice(0.9, 2);
  EXPECT_EQ(hash_of(run_exact(problem)), hash_of(run_exact(problem)));
}

// With e = 0 the speeds fall by the masses' ratio at every impact, to where squares would underflow.
TEST(Determinism, CollisionsThatDieAwayKeepTheirBitsInOtherUnits) {
  const auto run = [](double unit) {
    Problem problem;
    problem.plane({-3 * unit, 0, 0}, {1, 0, 0});
    problem.ball({0, 0, 0}, {-unit, 0, 0}, 1, 0.25 * unit, 0);
    problem.ball({unit, 0, 0}, {-1.5 * unit, 0, 0}, 1e-6, 0.25 * unit, 0);
    problem.ball({-unit, 0, 0}, {0.5 * unit, 0, 0}, 1e6, 0.25 * unit, 0);
    problem.options.duration = 100;
    return run_exact(problem);
  };

  const Outcome p = run(1), q = run(0x1p-20);
  EXPECT_EQ(p.tally.collisions(), q.tally.collisions());
  EXPECT_EQ(p.tally.energy_lost, q.tally.energy_lost * 0x1p40);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(p.end.position[i], q.end.position[i] * 0x1p20);
}

// Two ways to the same motion: the chapter's loop closes in on the exact path as its frames get shorter.
TEST(Agreement, TheBooksLoopConvergesToTheExactMotion) {
  Problem problem;
  problem.ball({-1, 0.03, 0}, {2, 0, 0}, 10, 0.11, 0.9);
  problem.ball({0.02, -1, 0.01}, {0, 2, 0}, 7, 0.13, 0.8);
  problem.options.duration = 1;

  const State exact = run_exact(problem).end;

  double previous = 1;
  for (double step : {1e-3, 1e-4, 1e-5}) {
    const auto book = make_book_simulator(problem.world, problem.initial, {step, false, 0, true});
    const State end = run_to_end(*book, 1).end;

    const double error = (end.position[0] - exact.position[0]).norm();
    EXPECT_LT(error, 3 * step) << "step " << step;
    EXPECT_LT(error, previous);
    previous = error;
  }
}

}  // namespace
}  // namespace carom
