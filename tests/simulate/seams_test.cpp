// Floors of several pieces: tiles, walls, planes that are level, exactly or nearly. A body slides over them as over
// one piece.
#include <gtest/gtest.h>

#include "physics/force_law.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/floors.h"
#include "std.h"

namespace carom {
namespace {

TEST(Seams, OfTilesAndWallsDoNothingToABodyNorToOneThatCarriesOthers) {
  for (const Sliding kind : {Sliding::ball, Sliding::box, Sliding::cylinder})
    for (const int riders : {0, 1, 2})
      for (uint64_t seed = 1; seed <= 200; ++seed)
        EXPECT_EQ(fault_of(random_crossing(kind, seed, riders)), "")
            << seed << ", body " << static_cast<int>(kind) << ", " << riders;
}

// Where two planes meet at an angle, the body continues along the second: it rises by the angle times the distance.
TEST(Seams, OfPlanesThatAreNearlyLevelDoNothing) {
  for (const Sliding kind : {Sliding::ball, Sliding::box, Sliding::cylinder})
    for (uint64_t seed = 1; seed <= 60; ++seed) {
      Random random(seed);
      const double e = 0.5 * static_cast<double>(seed % 3), r = random(0.05, 0.5);
      const double top = seed % 4 == 0 ? 0 : random(-2, 2), speed = random(0.5, 3);
      const double angle = 3e-8 * pow(2.0, -static_cast<double>(seed % 25));
      const double meet = seed % 2 == 0 ? 0.7 * speed : 0;  // ahead, or where the body is

      Problem problem;
      problem.world.gravity = Vec3(0, -g_n, 0);
      problem.options.duration = 1.5;
      problem.plane({0, top, 0}, {0, 1, 0});
      problem.plane({meet, top, 0}, {-angle, 1, 0});

      const Vec3 start(0, top + r, 0), velocity(speed, 0, 0);
      if (kind == Sliding::ball) problem.ball(start, velocity, 1, r, e);
      if (kind == Sliding::box) problem.body(Volume::box({2 * r, 2 * r, 2 * r}), start, velocity, 1, e);
      if (kind == Sliding::cylinder) problem.body(Volume::cylinder(r, 2 * r), start, velocity, 1, e);

      const Outcome run = run_exact(problem);
      EXPECT_LT((run.end.position[0] - start - 1.5 * velocity).norm(),
                angle * (1.5 * speed + 1.2 * g_n * 1.5 * 1.5) + 1e-12)
          << seed;
      EXPECT_TRUE(run.collisions.empty()) << seed;
    }
}

/// Boxes and upright cylinders with half extents a and b, in decimals as in a scene. One passes the other with their
/// faces in one plane, except for rounding.
Problem passing(uint64_t seed) {
  Random random(seed);
  const auto decimal = [&](double low, double high) { return std::round(random(low, high) * 20) / 20; };
  const auto three = [&](double low, double high) {
    const double x = decimal(low, high), y = decimal(low, high);
    return Vec3(x, y, decimal(low, high));
  };

  const bool round_a = seed / 6 % 2 == 1, round_b = seed / 12 % 2 == 1;
  auto along = static_cast<int>(seed % 3), across = (along + 1 + static_cast<int>(seed / 3 % 2)) % 3;
  if (round_a || round_b) {
    along = along == 1 ? 0 : along;
    across = 1;
  }

  const Vec3 a = three(0.1, 0.6), b = three(0.1, 0.6), center = three(-3, 3);
  const auto volume = [](bool round, const Vec3& half) {
    return round ? Volume::cylinder(half.x(), 2 * half.y()) : Volume::box(2 * half);
  };

  Vec3 start = center, other = center, velocity = Vec3::Zero();
  other[across] += (random(0, 1) < 0.5 ? -1 : 1) * (a[across] + b[across]);
  start[along] -= 2;
  velocity[along] = decimal(0.5, 4);

  Problem problem;
  problem.body(volume(round_a, a), start, velocity);
  if (seed % 2 == 0)
    problem.body(volume(round_b, b), other, Vec3::Zero());
  else
    problem.obstacle(other, volume(round_b, b));

  problem.options.duration = 3;
  return problem;
}

TEST(FlushFaces, DoNotMeet) {
  for (uint64_t seed = 1; seed <= 2000; ++seed) {
    Problem problem = passing(seed);
    EXPECT_TRUE(run_exact(problem).collisions.empty()) << seed;
    problem.world.forces = {{Drag{0.2, 0, Vec3::Zero()}}};
    EXPECT_TRUE(run_exact(problem).collisions.empty()) << seed << " with drag";
  }
}

}  // namespace
}  // namespace carom
