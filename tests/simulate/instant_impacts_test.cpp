// Impacts of one instant in whole runs: what is symmetric stays so, names decide nothing, and the books balance.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "simulate/build.h"

namespace carom {
namespace {

const double half_root_of_3 = std::sqrt(3.0) / 2;

/// The triangle of a break, with `rows` rows of balls of radius 0.5 m, and a ball that strikes it at 10 m/s. off: m,
/// beside its axis.
Problem break_of(int rows, double e, double off = 0) {
  Problem problem;
  problem.ball({-3, 0, off}, {10, 0, 0}, 1, 0.5, e);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j <= i; ++j) problem.ball({half_root_of_3 * i, 0, j - 0.5 * i}, {0, 0, 0}, 1, 0.5, e);
  problem.options.duration = 0.21;
  return problem;
}

/// The greatest difference between the velocities of balls of a break and those of their images in its axis (m/s).
double asymmetry(int rows, const State& state) {
  double most = std::abs(state.velocity[0].z());
  std::size_t first = 1;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j <= i; ++j) {
      Vec3 image = state.velocity[first + static_cast<std::size_t>(i - j)];
      image.z() = -image.z();
      most = std::max(most, (state.velocity[first + static_cast<std::size_t>(j)] - image).norm());
    }
    first += static_cast<std::size_t>(i) + 1;
  }
  return most;
}

TEST(InstantImpacts, ABreakIsSymmetric) {
  for (const int rows : {2, 3, 5, 8})
    for (const double e : {1.0, 0.9, 0.5, 0.0}) {
      const Problem problem = break_of(rows, e);
      const Outcome run = run_exact(problem);
      EXPECT_LT(asymmetry(rows, run.end), 1e-14) << rows << ' ' << e;  // measured: 2e-16
      EXPECT_GE(run.collisions.size(), static_cast<std::size_t>(rows));
    }
}

TEST(InstantImpacts, ABallOnTwoThatTouchLeavesByTheClosedForm) {
  for (const double e : {1.0, 0.5, 0.0}) {
    Problem problem;
    problem.ball({-3, 0, 0}, {10, 0, 0}, 1, 0.5, e);
    problem.ball({0, 0, 0.5}, {0, 0, 0}, 1, 0.5, e);
    problem.ball({0, 0, -0.5}, {0, 0, 0}, 1, 0.5, e);
    problem.options.duration = 0.3;
    const Outcome three = run_exact(problem);
    EXPECT_NEAR(three.end.velocity[0].x(), 4 - 6 * e, 1e-13);
    EXPECT_NEAR(three.end.velocity[1].x(), 3 * (1 + e), 1e-13);
    EXPECT_NEAR(three.end.velocity[1].z(), 2 * half_root_of_3 * (1 + e), 1e-13);
    EXPECT_NEAR(three.end.velocity[2].z(), -2 * half_root_of_3 * (1 + e), 1e-13);
  }
}

/// The same scene with its bodies in another order: body k is number order[k].
Problem reordered(const Problem& given, const std::vector<std::size_t>& order) {
  Problem other = given;
  for (std::size_t k = 0; k < order.size(); ++k) {
    other.initial.position[order[k]] = given.initial.position[k];
    other.initial.velocity[order[k]] = given.initial.velocity[k];
    other.world.mass[order[k]] = given.world.mass[k];
    other.world.radius[order[k]] = given.world.radius[k];
    other.world.restitution[order[k]] = given.world.restitution[k];
  }
  return other;
}

TEST(InstantImpacts, NamesDecideNothing) {
  for (const double e : {1.0, 0.9, 0.5}) {
    Problem problem = break_of(5, e, 0.01);
    problem.room(Vec3(-4, -1, -4), Vec3(6, 1, 4));
    problem.options.duration = 1;
    const Outcome first = run_exact(problem);
    EXPECT_GT(first.collisions.size(), 30u);

    std::vector<std::size_t> order(problem.world.mass.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int k = 0; k < 6; ++k) {
      std::rotate(order.begin(), order.begin() + 3, order.end());
      std::reverse(order.begin() + k, order.end());
      const Outcome run = run_exact(reordered(problem, order));
      ASSERT_EQ(run.collisions.size(), first.collisions.size()) << e;
      for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(run.end.position[order[i]], first.end.position[i]) << e << ' ' << i;
        EXPECT_EQ(run.end.velocity[order[i]], first.end.velocity[i]) << e << ' ' << i;
      }
    }
  }
}

/// Five touching balls in a row, struck from both ends at one instant.
TEST(InstantImpacts, ACradleWorksFromBothEnds) {
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0}, 1, 0.5, 1);
  for (int i = 0; i < 3; ++i) problem.ball({1.0 * i, 0, 0}, {0, 0, 0}, 1, 0.5, 1);
  problem.ball({3.5, 0, 0}, {-0.5, 0, 0}, 1, 0.5, 1);
  problem.options.duration = 1.5;
  const Outcome run = run_exact(problem);
  const double expected[] = {-0.5, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(run.end.velocity[i].x(), expected[i]) << i;
}

TEST(InstantImpacts, ABallInAValleyComesBackOnItsAxis) {
  for (const double e : {1.0, 0.5}) {
    Problem problem;
    problem.plane({0, 0, 0}, {1, 1, 0});
    problem.plane({0, 0, 0}, {-1, 1, 0});
    problem.ball({0, 3, 0}, {0, -2, 0}, 1, 0.5, e);
    problem.options.duration = 2;
    const Outcome run = run_exact(problem);
    EXPECT_NEAR(run.end.velocity[0].y(), 2 * e, 1e-14);
    EXPECT_EQ(run.end.velocity[0].x(), 0);
    EXPECT_EQ(run.collisions.size(), 2u);
  }
}

/// The triangle of a 6-8-10: both strings go taut at one instant.
TEST(InstantImpacts, TwoStringsThatGoTautAtOnceKeepTheirBobOnItsAxis) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.1);
  for (const double side : {-6.0, 6.0}) {
    problem.world.strings.push_back({0, no_entity, {side, 0, 0}, 10, 0.5, false});
  }
  problem.options.duration = std::sqrt(1.6) + 0.1;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 2u);
  EXPECT_EQ(run.end.velocity[0].x(), 0);
  EXPECT_NEAR(run.end.velocity[0].y(), 0.5 * std::sqrt(160.0) - 1, 1e-12);
}

TEST(InstantImpacts, TheBooksBalance) {
  for (const double e : {1.0, 0.7, 0.3, 0.0}) {
    const Problem problem = break_of(8, e);
    const Outcome run = run_exact(problem);
    double after = 0;
    double rows = run.tally.taken_up.energy;
    for (const Vec3& v : run.end.velocity) after += 0.5 * v.squaredNorm();
    for (const Collision& collision : run.collisions) rows += collision.energy_lost;
    EXPECT_NEAR(50 - after, run.tally.energy_lost, 1e-11) << e;
    EXPECT_NEAR(rows, run.tally.energy_lost, 1e-11) << e;
  }
}

}  // namespace
}  // namespace carom
