// Islands of up to 60 balls against an independent solution of high order (constrained_reference.h).
#include <gtest/gtest.h>

#include <numeric>

#include "physics/force_law.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/constrained_reference.h"
#include "simulate/random.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// The same for the simulator, with its balls in this order, each under a force of its own.
Problem same(const ConstrainedReference& reference, const vector<size_t>& order, double duration, double e) {
  Problem problem;
  problem.options.duration = duration;
  if (reference.has_floor) problem.plane({0, 0, 0}, {0, 1, 0});
  for (const auto& [center, radius] : reference.globes) problem.obstacle(center, Volume::sphere(radius));
  for (const size_t k : order) {
    const Entity i = problem.ball(reference.start[k], Vec3::Zero(), reference.mass[k], reference.radius[k], e);
    problem.world.forces.push_back({UniformForce{reference.mass[k] * reference.force[k]}, 0, infinity, {i}});
  }
  return problem;
}

struct Errors {
  double position = 0, velocity = 0;  // of the least radius, and of a radius a second
};

/// Distance of the simulator from the reference, for either order of the bodies.
Errors compare(const ConstrainedReference& reference, const ConstrainedReference::Motion& expected, double e) {
  const size_t n = reference.mass.size();
  vector<size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  const double least = *ranges::min_element(reference.radius);

  Errors errors;

  for (int turn = 0; turn < 2; ++turn) {
    const Outcome run = run_exact(same(reference, order, expected.time, e));
    for (size_t k = 0; k < n; ++k) {
      errors.position = std::max(errors.position, (run.end.position[k] - expected.x[order[k]]).norm() / least);
      errors.velocity = std::max(errors.velocity, (run.end.velocity[k] - expected.v[order[k]]).norm() / least);
    }

    EXPECT_TRUE(run.collisions.empty());
    EXPECT_EQ(run.tally.stepped_contact, 0);
    EXPECT_EQ(run.tally.doubts.contacts, 0u);

    ranges::reverse(order);
  }
  return errors;
}

/// m: the place of a ball of radius r that touches one, two or three of those there, or the floor; one that overlaps
/// nothing. False: not found in so many trials.
bool place_touching(const ConstrainedReference& there, double r, Random& random, Vec3& x) {
  const size_t n = there.mass.size();
  for (int trial = 0; trial < 200; ++trial) {
    const auto pick = [&] { return std::min(n - 1, static_cast<size_t>(random(0, static_cast<double>(n)))); };

    vector<size_t> on;
    const int touches = 1 + static_cast<int>(random(0, 3));
    for (int k = 0; k < touches && n > 0; ++k) on.push_back(pick());
    const bool floor = n == 0 || random(0, 1) < 0.3;

    Eigen::Matrix<long double, 3, 1> at =
        (n == 0 ? Vec3(Vec3::Zero()) : there.start[on[0]]).cast<long double>() +
        Eigen::Matrix<long double, 3, 1>(random(-1, 1), random(-0.3, 1), random(-1, 1));

    // Newton's method on the gaps, by least change.
    for (int pass = 0; pass < 60; ++pass) {
      for (const size_t k : on) {
        const Eigen::Matrix<long double, 3, 1> d = at - there.start[k].cast<long double>();
        const long double size = d.norm();
        at += ((static_cast<long double>(there.radius[k]) + r) / size - 1) * d;
      }
      if (floor) at.y() = r;
    }

    x = at.cast<double>();
    bool good = x.y() > r - 1e-15;
    for (const size_t k : on) good = good && std::abs((x - there.start[k]).norm() - there.radius[k] - r) < 4e-16;
    for (size_t k = 0; k < n; ++k) good = good && (x - there.start[k]).norm() - there.radius[k] - r > -4e-16;
    if (good) return true;
  }
  return false;
}

/// n balls of many sizes and masses that touch one another and a floor, each pulled by a force of its own.
ConstrainedReference random_island(size_t n, uint64_t seed) {
  Random random(seed);
  ConstrainedReference island;
  while (island.mass.size() < n) {
    const double r = random(0.2, 0.6);

    Vec3 x;
    if (!place_touching(island, r, random, x)) continue;
    island.start.push_back(x);
    island.radius.push_back(r);
    island.mass.push_back(pow(2.0, random(-3, 3)));
    island.force.emplace_back(random(-2, 2), -g_n + random(-2, 2), random(-2, 2));
  }
  return island;
}

TEST(ConstrainedReference, RandomIslandsOfUpTo60BallsFollowIt) {
  SLOW_WITH_SANITIZERS();
  Errors worst;

  size_t openings = 0, islands = 0;

  for (const size_t n : {2, 3, 5, 8, 12, 16, 17, 24, 40, 60}) {
    for (uint64_t seed = 1; seed <= (n <= 17 ? 10u : 2u); ++seed) {
      ConstrainedReference island = random_island(n, 1000 * n + seed);
      const ConstrainedReference::Motion expected = island.follow(0.15, 1.0 / 128);
      if (expected.time == 0) continue;

      ++islands;
      openings += expected.openings;

      const Errors errors = compare(island, expected, seed % 2 == 0 ? 0 : 0.5);
      EXPECT_LT(errors.position, 1e-10) << n << " balls, seed " << seed << ", " << expected.time << " s";
      EXPECT_LT(errors.velocity, 1e-9) << n << " balls, seed " << seed << ", " << expected.time << " s";
      worst = {std::max(worst.position, errors.position), std::max(worst.velocity, errors.velocity)};
    }
  }

  std::printf("%zu islands, %zu openings: off by %.2g of a radius, %.2g of one a second\n", islands, openings,
              worst.position, worst.velocity);
}

/// A train of n balls on a fixed globe, the first one in front, pushed by the last one.
ConstrainedReference train(size_t n, double push) {
  ConstrainedReference train;
  train.has_floor = false;

  const double globe = 5, r = 0.25, out = globe + r, turn = 2 * std::asin(r / out);
  train.globes.push_back({{0, -globe, 0}, globe});

  for (size_t k = 0; k < n; ++k) {
    const double angle = -0.05 - static_cast<double>(k) * turn;
    train.start.emplace_back(out * std::sin(angle), out * std::cos(angle) - globe, 0);
    train.radius.push_back(r);
    train.mass.push_back(1 + 0.25 * static_cast<double>(k % 3));
    train.force.emplace_back(0, -g_n, 0);
  }
  train.force.back().x() += push * static_cast<double>(n) / train.mass.back();
  return train;
}

TEST(ConstrainedReference, TrainsArePushedOverAHumpAndComeApartOnTheFarSide) {
  SLOW_WITH_SANITIZERS();
  Errors worst;
  for (const size_t n : {2, 3, 5, 9, 17}) {
    for (const double push : {4.0, 10.0}) {
      ConstrainedReference cars = train(n, push);
      const ConstrainedReference::Motion expected = cars.follow(1.2, 1.0 / 64);

      const bool over = push == 10 && n <= 9;  // longer ones, or those pushed less, come no farther or slide back
      EXPECT_GT(expected.x[0].x(), over ? 1 : -1) << n;  // m, from the top

      const Errors errors = compare(cars, expected, 0.5);
      EXPECT_LT(errors.position, 1e-10) << n << ' ' << push << ' ' << expected.time;
      EXPECT_LT(errors.velocity, 1e-9) << n << ' ' << push;
      worst = {std::max(worst.position, errors.position), std::max(worst.velocity, errors.velocity)};
    }
  }
}

TEST(ConstrainedReference, HalvedStepsOfItMakeNoDifference) {
  SLOW_WITH_SANITIZERS();
  ConstrainedReference island = random_island(8, 8001), cars = train(3, 10);
  for (ConstrainedReference* of : {&island, &cars}) {
    const auto one = of->follow(0.15, 1.0 / 128), two = of->follow(one.time, 1.0 / 256);
    for (size_t k = 0; k < one.x.size(); ++k) EXPECT_LT((one.x[k] - two.x[k]).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace carom
