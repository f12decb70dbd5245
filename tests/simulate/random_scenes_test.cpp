// Random scenes of balls, walls, planes and a room, held to what must hold of every scene: nothing overlaps beyond
// rounding, the energy books balance, the run ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/contact_time.h"
#include "simulate/build.h"
#include "simulate/random.h"

namespace carom {
namespace {

Problem random_problem(std::uint64_t seed) {
  Random random(seed);
  Problem problem;
  const double restitutions[] = {0, 0.3, 0.5, 0.9, 1, 1};
  const double e = restitutions[static_cast<int>(random(0, 6))];
  const double g = random(0, 1) < 0.5 ? 0 : random(0.1, 20);
  problem.world.gravity =
      Vec3(random(0, 1) < 0.3 ? random(-1, 1) * g : 0, -g, random(0, 1) < 0.3 ? random(-1, 1) * g : 0);
  const double half = 2;
  problem.room(Vec3::Constant(-half), Vec3::Constant(half));
  for (int i = static_cast<int>(random(0, 3)); i > 0; --i) {
    const Vec3 point(random(-1, 1), -1.5, random(-1, 1)), normal(random(-1, 1), 1, random(-1, 1));
    problem.plane(point, normal);
  }
  for (int i = static_cast<int>(random(0, 4)); i > 0; --i) {
    const Vec3 center(random(-1.5, 1.5), random(-1.5, 1.5), random(-1.5, 1.5));
    Vec3 normal(random(-1, 1), random(-1, 1), random(-1, 1));
    if (random(0, 1) < 0.3) normal = Vec3(0, 1, 0);
    const double width = random(0.1, 2), height = random(0.1, 2);
    problem.wall(center, normal, width, height, Vec3(0.11, 0.3, 1));
  }
  const bool spread_radii = random(0, 1) < 0.3, half_at_rest = random(0, 1) < 0.3;
  const int wanted = static_cast<int>(random(1, 16));
  for (int attempt = 0; attempt < 50 * wanted && problem.world.body_count() < static_cast<Entity>(wanted); ++attempt) {
    const double radius = spread_radii ? 0.25 * std::pow(2.0, -std::floor(random(0, 7))) : random(0.05, 0.3);
    const double reach = half - radius;
    const Vec3 x(random(-reach, reach), random(-reach, reach), random(-reach, reach));
    Vec3 v(random(-3, 3), random(-3, 3), random(-3, 3));
    if (half_at_rest && random(0, 1) < 0.5) v.setZero();
    bool free = true;
    for (Entity j = 0; j < problem.world.body_count(); ++j)
      free = free && (x - problem.initial.position[j]).norm() > radius + problem.world.radius[j];
    for (const Plane& p : problem.world.planes) free = free && plane_gap(x, p.point, p.normal, radius) > 0;
    for (const Wall& w : problem.world.walls) free = free && (x - nearest_on_wall(w, x)).norm() > radius;
    if (free) problem.ball(x, v, random(0.5, 2), radius, e);
  }
  problem.options.duration = 1;
  return problem;
}

double deepest_overlap(const World& world, const State& state) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (Entity i = 0; i < world.body_count(); ++i) {
    const Vec3& x = state.position[i];
    for (Entity j = 0; j < i; ++j)
      deepest = std::max(deepest, world.radius[i] + world.radius[j] - (x - state.position[j]).norm());
    for (const Plane& p : world.planes) deepest = std::max(deepest, -plane_gap(x, p.point, p.normal, world.radius[i]));
    for (const Wall& w : world.walls) deepest = std::max(deepest, world.radius[i] - (x - nearest_on_wall(w, x)).norm());
  }
  return deepest;
}

class RandomScene : public ::testing::TestWithParam<int> {};

TEST_P(RandomScene, KeepsItsBodiesApartAndItsBooks) {
  for (int k = 0; k < 10; ++k) {
    const int seed = 10 * GetParam() + k;
    const Problem problem = random_problem(static_cast<std::uint64_t>(seed));
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    const auto energy = [&](const State& s) {
      return kinetic_energy(problem.world, s) + potential_energy(problem.world, s);
    };
    const double start = energy(simulator->state());
    for (int i = 1; i <= 100; ++i) {
      const double t = problem.options.duration * i / 100;
      while (simulator->time() < t) simulator->advance_to(t);
      ASSERT_LT(deepest_overlap(problem.world, simulator->state()), 1e-10) << "seed " << seed << " t = " << t;
    }
    const double scale = std::abs(start) + kinetic_energy(problem.world, problem.initial) + 1;
    EXPECT_NEAR(energy(simulator->state()) - start + simulator->tally().energy_lost, 0, 1e-11 * scale)
        << "seed " << seed;
    EXPECT_LT(simulator->tally().max_overlap, 1e-10) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScene, ::testing::Range(0, 12));

}  // namespace
}  // namespace carom
