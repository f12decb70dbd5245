// Floors of several pieces: tiles, walls, planes that are level but for rounding or nearly so. A body that slides over
// them does so as on one.
#include <gtest/gtest.h>

#include <cmath>

#include "physics/force_law.h"
#include "simulate/build.h"
#include "simulate/random.h"

namespace carom {
namespace {

constexpr double g = 9.80665;
constexpr int pieces = 6;

enum class Sliding { ball, box, cylinder };

struct Crossing {
  Problem problem;
  Vec3 start, velocity;  // m, m/s
};

/// A body of a random size at the first piece's start, at a random speed, with e = 0, 0.5 or 1.
void add_body(Crossing& crossing, Sliding kind, double e, double r, const Vec3& start, const Vec3& velocity) {
  Problem& problem = crossing.problem;
  crossing.start = start;
  crossing.velocity = velocity;
  if (kind == Sliding::ball) problem.ball(start, velocity, 1, r, e);
  if (kind == Sliding::box) problem.body(Volume::box({2 * r, 2 * r, 2 * r}), start, velocity, 1, e);
  if (kind == Sliding::cylinder) problem.body(Volume::cylinder(r, 2 * r), start, velocity, 1, e);
}

void expect_to_cross(const Crossing& crossing, double off, const std::string& what) {
  const Outcome run = run_exact(crossing.problem);
  const double time = crossing.problem.options.duration;
  EXPECT_LT((run.end.position[0] - crossing.start - time * crossing.velocity).norm(), off) << what;
  EXPECT_TRUE(run.collisions.empty()) << what;
}

TEST(Seams, OfTilesAndWallsDoNothing) {
  for (const bool walls : {false, true})
    for (const Sliding kind : {Sliding::ball, Sliding::box, Sliding::cylinder})
      for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const double e = 0.5 * static_cast<double>(seed % 3), r = random(0.05, 0.5);
        const double top = seed % 4 == 0 ? 0 : random(-2, 2), width = random(0.3, 2);
        const double height = random(0.1, 1);
        Crossing crossing;
        crossing.problem.world.gravity = Vec3(0, -g, 0);
        for (int k = 0; k < pieces; ++k) {
          const double x = width * k + width / 2;
          if (walls)
            crossing.problem.wall({x, top, 0}, {0, 1, 0}, width, 4, {0, 0, 1});
          else
            crossing.problem.obstacle({x, top - height / 2, 0}, Volume::box({width, height, 4}));
        }
        const double speed = random(0.5, 3), start = 0.4 * width;
        crossing.problem.options.duration = (width * (pieces - 0.5) - start) / speed;
        const double aside = 1.5 / crossing.problem.options.duration;  // to stay on the floor
        add_body(crossing, kind, e, r, {start, top + r, 0}, {speed, 0, random(-aside, aside)});
        expect_to_cross(crossing, 1e-12, std::to_string(seed) + (walls ? " walls" : " tiles"));  // measured: 1e-13
      }
}

// Where two planes meet at an angle the body goes on along the second: up by the angle times the way.
TEST(Seams, OfPlanesThatAreNearlyLevelDoNothing) {
  for (const Sliding kind : {Sliding::ball, Sliding::box, Sliding::cylinder})
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      Random random(seed);
      const double e = 0.5 * static_cast<double>(seed % 3), r = random(0.05, 0.5);
      const double top = seed % 4 == 0 ? 0 : random(-2, 2), speed = random(0.5, 3);
      const double angle = 3e-8 * std::pow(2.0, -static_cast<double>(seed % 25));
      const double meet = seed % 2 == 0 ? 0.7 * speed : 0;  // ahead, or where the body is
      Crossing crossing;
      crossing.problem.world.gravity = Vec3(0, -g, 0);
      crossing.problem.options.duration = 1.5;
      crossing.problem.plane({0, top, 0}, {0, 1, 0});
      crossing.problem.plane({meet, top, 0}, {-angle, 1, 0});
      add_body(crossing, kind, e, r, {0, top + r, 0}, {speed, 0, 0});
      const double way = speed * crossing.problem.options.duration;
      expect_to_cross(crossing, angle * (way + 1.2 * g * 1.5 * 1.5) + 1e-12, std::to_string(seed));
    }
}

// Bodies on top of one another press on the floor together.
TEST(Seams, OfTilesAndWallsDoNothingToAStack) {
  for (const bool walls : {false, true})
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      Random random(seed);
      const double e = 0.5 * static_cast<double>(seed % 3), r = random(0.05, 0.5);
      const double top = seed % 4 == 0 ? 0 : random(-2, 2), width = random(0.3, 2), height = random(0.1, 1);
      Crossing crossing;
      Problem& problem = crossing.problem;
      problem.world.gravity = Vec3(0, -g, 0);
      for (int k = 0; k < pieces; ++k) {
        const double x = width * k + width / 2;
        if (walls)
          problem.wall({x, top, 0}, {0, 1, 0}, width, 4, {0, 0, 1});
        else
          problem.obstacle({x, top - height / 2, 0}, Volume::box({width, height, 4}));
      }
      const double speed = random(0.5, 3), start = 0.4 * width;
      problem.options.duration = (width * (pieces - 0.5) - start) / speed;
      const double time = problem.options.duration, aside = 1.5 / time;
      const Vec3 velocity(speed, 0, random(-aside, aside));
      const int bodies = 2 + static_cast<int>(seed % 3);
      std::vector<Vec3> first;
      for (int k = 0; k < bodies; ++k) {
        first.emplace_back(start, top + (2 * k + 1) * r, 0);
        const auto pick = static_cast<int>(seed / 3) + k;
        const int kind = k + 1 < bodies ? 1 + pick % 2 : pick % 3;  // nothing stands on a ball for long
        add_body(crossing, static_cast<Sliding>(kind), e, r, first.back(), velocity);
      }
      const Outcome run = run_exact(problem);
      const std::string what = std::to_string(seed) + (walls ? " walls" : " tiles");
      for (int k = 0; k < bodies; ++k)
        EXPECT_LT((run.end.position[k] - first[k] - time * velocity).norm(), 1e-12) << what;
      EXPECT_TRUE(run.collisions.empty()) << what;
      EXPECT_EQ(run.tally.stepped_contact, 0) << what;
    }
}

/// Boxes and upright cylinders, with half extents a and b, in decimals as a scene has them: one passes the other with
/// their faces in one plane, but for rounding.
Problem passing(std::uint64_t seed) {
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
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Problem problem = passing(seed);
    EXPECT_TRUE(run_exact(problem).collisions.empty()) << seed;
    problem.world.forces = {{Drag{0.2, 0, Vec3::Zero()}}};
    EXPECT_TRUE(run_exact(problem).collisions.empty()) << seed << " with drag";
  }
}

}  // namespace
}  // namespace carom
