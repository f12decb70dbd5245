// Restitution, impact, contact of one body with several surfaces, compensated sums.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "numerics/compensated.h"
#include "paths.h"
#include "physics/energy.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

TEST(Restitution, EveryRuleGivesTheReferencesNumber) {
  std::ifstream file(string(DATA_DIR) + "/references/restitution_rules.json");
  const auto all = nlohmann::json::parse(file);
  for (const auto& r : all["rows"]) {
    const double a = r["e1"], b = r["e2"];
    const auto e = [&](Combine rule) { return combine_restitution(rule, a, 1, b, 1); };

    EXPECT_DOUBLE_EQ(e(Combine::average), r["average"]);
    EXPECT_DOUBLE_EQ(e(Combine::product), r["product"]);
    EXPECT_DOUBLE_EQ(e(Combine::minimum), r["minimum"]);
    EXPECT_DOUBLE_EQ(e(Combine::maximum), r["maximum"]);
    EXPECT_DOUBLE_EQ(e(Combine::geometric_mean), r["geometric"]);
    EXPECT_DOUBLE_EQ(e(Combine::book), r["book_listing"]);
  }

  EXPECT_DOUBLE_EQ(combine_restitution(Combine::mass_weighted, 0.5, 1, 0.9, 3), 0.8);
}

World two_balls_and_a_floor() {
  World world;
  world.mass = {1, 3};
  world.radius = {1, 1};
  world.restitution = {0.5, 0.9};
  world.planes = {{Vec3::Zero(), Vec3::Unit(1), nullopt}};
  return world;
}

TEST(Restitution, ASurfaceThatNamesNoneTakesTheBodys) {
  const World world = two_balls_and_a_floor();
  EXPECT_DOUBLE_EQ(pair_restitution(world, 0, 2), 0.5);
  EXPECT_DOUBLE_EQ(pair_restitution(world, 1, 2), 0.9);
}

TEST(Restitution, ASurfacesOwnIsCombined) {
  World world = two_balls_and_a_floor();
  world.planes[0].restitution = 0.1;
  EXPECT_DOUBLE_EQ(pair_restitution(world, 0, 2), 0.3);
  world.combine = Combine::mass_weighted;
  EXPECT_DOUBLE_EQ(pair_restitution(world, 0, 2), 0.1) << "an immovable surface outweighs the body";
}

TEST(Restitution, TheLastPairThatFitsOverrulesEverything) {
  World world = two_balls_and_a_floor();
  world.pairs = {{0, 2, 2, 1, 0.25}, {0, 1, 1, 1, 0.75}, {2, 1, 1, 1, 0.125}};
  EXPECT_EQ(pair_restitution(world, 0, 1), 0.75);
  EXPECT_EQ(pair_restitution(world, 0, 2), 0.25);
  EXPECT_EQ(pair_restitution(world, 1, 2), 0.125) << "in either order";
}

TEST(Impact, ImpulseAndLossAreTheChapters) {
  const double m1 = 2, m2 = 3, u1 = 4, u2 = -1, e = 0.5;
  const double j = impact_impulse(m1, m2, u1 - u2, e * (u1 - u2));
  const double v1 = ((m1 - e * m2) * u1 + (1 + e) * m2 * u2) / (m1 + m2);
  const double v2 = ((m2 - e * m1) * u2 + (1 + e) * m1 * u1) / (m1 + m2);
  EXPECT_DOUBLE_EQ(u1 - j / m1, v1);
  EXPECT_DOUBLE_EQ(u2 + j / m2, v2);
  const double before = 0.5 * (m1 * u1 * u1 + m2 * u2 * u2), after = 0.5 * (m1 * v1 * v1 + m2 * v2 * v2);
  EXPECT_DOUBLE_EQ(impact_loss(m1, m2, u1 - u2, e * (u1 - u2)), before - after);
  EXPECT_DOUBLE_EQ(impact_impulse(2, INFINITY, 3, 1.5), 9) << "against a fixed surface";
}

TEST(Compensated, DifferenceOfProductsKeepsWhatCancels) {
  const double a = 1 + 0x1p-30, b = 1 - 0x1p-30;
  EXPECT_EQ(difference_of_products(a, b, 1, 1).value(), -0x1p-60);
  EXPECT_EQ(squared_gap(Vec3(1 + 0x1p-52, 0, 0), 1), 0x1p-51 + 0x1p-104);
}

TEST(Compensated, ASumLosesNothing) {
  Sum sum;
  for (double x : {1.0, 1e100, 1.0, -1e100}) sum.add(x);
  EXPECT_EQ(sum.value(), 2);
}

TEST(Energy, IsKineticAndOfGravity) {
  World world = two_balls_and_a_floor();
  world.gravity = Vec3(0, -10, 0);
  const State state{0, {Vec3(0, 2, 0), Vec3(1, 1, 1)}, {Vec3(3, 0, 4), Vec3(0, 0, 1)}};
  EXPECT_DOUBLE_EQ(kinetic_energy(world, state), 12.5 + 1.5);
  EXPECT_DOUBLE_EQ(potential_energy(world, state), 20 + 30);
  EXPECT_EQ(momentum(world, state), Vec3(3, 0, 4 + 3));
}

}  // namespace
}  // namespace carom
