// The lists of neighbours against all pairs, and the next body against a search.
#include <gtest/gtest.h>

#include "numerics/tournament.h"
#include "physics/world.h"
#include "simulate/random.h"
#include "simulate/space/neighbours.h"
#include "std.h"

namespace carom {
namespace {

struct Wandering {
  string name;
  double radii;  // the largest over the smallest
  Vec3 from;     // m
  double half;   // m, of the cube that bodies wander in
  double scale;
};

class Near : public ::testing::TestWithParam<Wandering> {};

/// Bodies along a space diagonal: in a grid of that whole space most cells would be empty, and the others full.
TEST(NearOnADiagonal, HasAllThatMayTouch) {
  constexpr Entity bodies = 3000;
  World world;
  vector<Vec3> x;

  for (Entity i = 0; i < bodies; ++i) {
    world.mass.push_back(1);
    world.radius.push_back(0.1);
    world.restitution.push_back(1);
    x.push_back(0.12 * i * Vec3::Ones());
  }

  Neighbours neighbours(world);
  neighbours.start(x);

  for (int round = 0; round < 2; ++round)
    for (Entity i = 1; i + 1 < bodies; ++i) {
      const span<const Entity> list = neighbours.bodies(i);
      EXPECT_LT(list.size(), 50u);
      for (const Entity j : {i - 1, i + 1}) EXPECT_EQ(ranges::count(list, j), 1);
      neighbours.renew(i, x[i], Vec3::Zero());
    }
}

TEST(NearThoseThatStay, HasAllWithinReachAndFewBeyond) {
  Random random;
  for (const double reach : {1e-9, 1e-3, 0.03, 0.5}) {
    constexpr Entity bodies = 400;
    World world;
    vector<Vec3> x;

    for (Entity i = 0; i < bodies; ++i) {
      world.mass.push_back(1);
      world.radius.push_back(random(0.3, 0.5));
      world.restitution.push_back(1);
      x.push_back(in_cube(random, 3.5));
    }

    Neighbours neighbours(world);
    neighbours.start(x);
    for (Entity i = 0; i < bodies; ++i) neighbours.stay(i, x[i], reach);

    for (Entity i = 0; i < bodies; ++i) {
      const span<const Entity> list = neighbours.bodies(i);
      for (Entity j = 0; j < bodies; ++j) {
        if (j == i) continue;
        const double gap = (x[j] - x[i]).norm() - world.radius[i] - world.radius[j];
        const auto times = ranges::count(list, j);
        EXPECT_LE(times, gap > 12 * reach + 2 ? 0 : 1) << reach;
        EXPECT_GE(times, gap <= 2 * reach ? 1 : 0) << reach;
      }
    }
  }
}

/// Bodies wander and get new regions when they leave theirs. At all times each body that may touch another within
/// their regions is on both lists, once, and so is every plane in reach.
TEST_P(Near, HasAllThatMayTouch) {
  const Wandering& how = GetParam();
  constexpr Entity bodies = 150;
  Random random;
  World world;
  vector<Vec3> x;

  for (Entity i = 0; i < bodies; ++i) {
    world.mass.push_back(1);
    world.radius.push_back(how.scale * 0.1 * pow(how.radii, random(0, 1)));
    world.restitution.push_back(1);
    x.push_back(how.scale * (how.from + in_cube(random, how.half)));
  }

  for (int k = 0; k < 20; ++k) {
    const Vec3 normal = in_cube(random, 1).normalized();
    world.planes.push_back({how.scale * (how.from - random(0.2, 1) * how.half * normal), normal, 1.0});
  }

  Neighbours neighbours(world);
  neighbours.start(x);
  int renewed = 0;

  for (int round = 0; round < 60; ++round) {
    for (Entity i = 0; i < bodies; ++i) {
      x[i] += how.scale * in_cube(random, 0.1 * how.half);
      if (random(0, 1) < 0.01) x[i] = how.scale * (how.from + in_cube(random, 100 * how.half));
      if ((x[i] - neighbours.center(i)).norm() <= neighbours.room(i)) continue;

      ++renewed;
      // Those it did not know are told.
      const span<const Entity> before = neighbours.bodies(i);
      const set<Entity> known(before.begin(), before.end());
      const span<const Entity> came = neighbours.renew(i, x[i], how.scale * in_cube(random, 1));
      for (const Entity j : came) EXPECT_FALSE(known.contains(j));
      for (const Entity j : neighbours.bodies(i)) EXPECT_TRUE(known.contains(j) || contains(came, j));
      EXPECT_LE((x[i] - neighbours.center(i)).norm(), neighbours.room(i));
      if (random(0, 1) < 0.05) neighbours.shrink(i, x[i]);
    }

    if (round % 10 != 9) continue;
    // No two may touch that are not on each other's lists.
    for (Entity i = 0; i < bodies; ++i) {
      const span<const Entity> list = neighbours.bodies(i);
      const set<Entity> known(list.begin(), list.end());
      EXPECT_EQ(known.size(), list.size());
      for (Entity j = 0; j < bodies; ++j) {
        const double apart = (neighbours.center(i) - neighbours.center(j)).norm();
        const double reach = neighbours.room(i) + neighbours.room(j) + world.radius[i] + world.radius[j];
        if (j != i && apart <= reach) {
          EXPECT_TRUE(known.contains(j)) << i << " and " << j;
        }
        if (apart > 1.001 * reach) {
          EXPECT_FALSE(known.contains(j)) << i << " and " << j;
        }
      }

      const span<const Entity> surfaces = neighbours.surfaces(i);
      for (Entity k = 0; k < world.planes.size(); ++k) {
        const Plane& plane = world.planes[k];
        const double gap = (neighbours.center(i) - plane.point).dot(plane.normal) - world.radius[i];
        if (gap <= neighbours.room(i)) {
          EXPECT_TRUE(contains(surfaces, bodies + k));
        }
      }
    }
  }

  EXPECT_GT(renewed, 500);
}

INSTANTIATE_TEST_SUITE_P(Wander, Near,
                         ::testing::Values(Wandering{"equal", 1, {0, 0, 0}, 1, 1},
                                           Wandering{"unequal", 30, {0, 0, 0}, 3, 1},
                                           Wandering{"far_off", 3, {1e7, -1e6, 3e5}, 2, 1},
                                           Wandering{"tiny", 3, {0, 1, 0}, 1, 0x1p-200},
                                           Wandering{"huge", 3, {0, 1, 0}, 1, 0x1p200}),
                         [](const auto& wandering) { return wandering.param.name; });

struct First {
  const vector<int>* rank;
  bool operator()(uint32_t i, uint32_t j) const { return (*rank)[i] < (*rank)[j]; }
};

TEST(Tournament, FindsTheFirstOfManyAndOfEqualTimesTheOneBefore) {
  Random random;

  for (const uint32_t entries : {1u, 7u, 8u, 9u, 64u, 65u, 700u}) {
    vector<double> time(entries, infinity);
    vector<int> rank(entries);
    for (int& r : rank) r = static_cast<int>(random(0, 5));
    Tournament<First> queue(entries, First{&rank});
    EXPECT_EQ(queue.first(), Tournament<First>::none);

    for (int step = 0; step < 3000; ++step) {
      const auto i = static_cast<uint32_t>(random(0, entries));
      rank[i] = static_cast<int>(random(0, 1000)) * 1000 + static_cast<int>(i);  // no two alike
      time[i] = random(0, 1) < 0.2 ? infinity : floor(random(0, 9));
      queue.update(i, time[i]);

      uint32_t first = 0;
      for (uint32_t k = 1; k < entries; ++k)
        if (time[k] < time[first] || (time[k] == time[first] && rank[k] < rank[first])) first = k;

      EXPECT_EQ(queue.first_time(), time[first]);
      if (time[first] < infinity) {
        ASSERT_EQ(queue.first(), first);
      }
    }
  }
}

}  // namespace
}  // namespace carom
