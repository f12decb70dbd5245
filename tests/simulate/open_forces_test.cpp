// Forces at rest that statics leaves open: those of equally stiff contacts, under any names.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

/// N, by the numbers that the two things have in `order`: body k of the problem is number order[k] there.
using Forces = map<pair<Entity, Entity>, double>;

Forces forces_of(const Problem& problem, const vector<Entity>& order) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, problem.options.duration);
  const auto name = [&](Entity e) { return problem.world.is_body(e) ? order[e] : e; };
  Forces forces;
  for (const ContactForce& c : simulator->contacts()) {
    const pair<Entity, Entity> names = std::minmax(name(c.a), name(c.b));
    forces[names] += c.force;
  }
  return forces;
}

vector<Entity> in_order(const Problem& problem) {
  vector<Entity> order(problem.world.body_count());
  std::iota(order.begin(), order.end(), Entity{0});
  return order;
}

/// A slab of 80 N on a square of n x n supports of 20 N each.
Problem slab_on(uint32_t n, bool balls) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.options.duration = 0.01;
  problem.plane(Vec3::Zero(), Vec3::UnitY());
  problem.body(Volume::box(Vec3(2.0 * n, 0.5, 2.0 * n)), {1.0 * (n - 1), 1.25, 1.0 * (n - 1)}, Vec3::Zero(), 8);
  for (uint32_t k = 0; k < n * n; ++k) {
    const Vec3 x(2.0 * (k % n), 0.5, 2.0 * (k / n));
    problem.body(balls ? Volume::sphere(0.5) : Volume::box(Vec3::Ones()), x, Vec3::Zero(), 2);
  }
  return problem;
}

TEST(OpenForces, SupportsOfASlabShareItsWeight) {
  for (const bool balls : {false, true})
    for (const uint32_t n : {2u, 5u, 8u}) {
      const Problem problem = slab_on(n, balls);
      const Forces forces = forces_of(problem, in_order(problem));
      const Entity floor = problem.world.body_count();
      for (Entity k = 1; k <= n * n; ++k) {
        EXPECT_NEAR(forces.at({0, k}), 80.0 / (n * n), 1e-9) << n << ' ' << k;
        EXPECT_NEAR(forces.at({k, floor}), 20 + 80.0 / (n * n), 1e-9) << n << ' ' << k;
      }
    }
}

/// Walls that just touch a stack do not press on it.
TEST(OpenForces, WallsThatJustTouchAStackDoNotPress) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.options.duration = 0.01;
  for (int k = 0; k < 3; ++k) problem.body(Volume::box(Vec3::Ones()), {0, 0.5 + k, 0}, Vec3::Zero());
  problem.plane(Vec3::Zero(), Vec3::UnitY());
  problem.plane({-0.5, 0, 0}, Vec3::UnitX());
  problem.plane({0.5, 0, 0}, -Vec3::UnitX());
  const Forces forces = forces_of(problem, in_order(problem));
  EXPECT_NEAR(forces.at({0, 3}), 30, 1e-12);
  EXPECT_NEAR(forces.at({0, 1}), 20, 1e-12);
  EXPECT_EQ(forces.size(), 3u);
}

/// A wall of 36 bricks in courses, its bodies in this order, mirrored with sign -1.
Problem brick_wall(const vector<Entity>& order, double sign) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 0.01;
  for (const Entity k : order) {
    const double course = k / 6;
    const double along = 0.2 * (k % 6 + 0.5 * (k / 6 % 2));
    problem.body(Volume::box(Vec3(0.2, 0.1, 0.1)), {sign * along, 0.1 * (course + 0.5), 0}, Vec3::Zero(), 2.5, 0.2);
  }
  problem.plane(Vec3::Zero(), Vec3::UnitY());
  return problem;
}

TEST(OpenForces, OfAWallOfBricksAreTheSameUnderAnyNamesAndInTheMirror) {
  vector<Entity> order(36);
  std::iota(order.begin(), order.end(), Entity{0});
  const Forces expected = forces_of(brick_wall(order, 1), order);
  EXPECT_EQ(expected.size(), 61u);

  std::mt19937 draw(1);
  for (int k = 0; k < 8; ++k) {
    const Forces forces = forces_of(brick_wall(order, k % 2 == 0 ? -1 : 1), order);
    ASSERT_EQ(forces.size(), expected.size());
    for (const auto& [names, force] : forces) EXPECT_NEAR(force, expected.at(names), 1e-12 * 883) << k;
    std::shuffle(order.begin(), order.end(), draw);
  }
}

}  // namespace
}  // namespace carom
