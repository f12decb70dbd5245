// Impacts of one instant in whole runs: what is symmetric stays so, names decide nothing, and the books balance.
#include <gtest/gtest.h>

#include <numeric>

#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

const double half_root_of_3 = sqrt(3.0) / 2;

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
  size_t first = 1;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j <= i; ++j) {
      Vec3 image = state.velocity[first + static_cast<size_t>(i - j)];
      image.z() = -image.z();
      most = std::max(most, (state.velocity[first + static_cast<size_t>(j)] - image).norm());
    }
    first += static_cast<size_t>(i) + 1;
  }
  return most;
}

TEST(InstantImpacts, ABreakIsSymmetric) {
  for (const int rows : {2, 3, 5, 8})
    for (const double e : {1.0, 0.9, 0.5, 0.0}) {
      const Problem problem = break_of(rows, e);
      const Outcome run = run_exact(problem);
      EXPECT_LT(asymmetry(rows, run.end), 1e-14) << rows << ' ' << e;  // measured: 2e-16
      EXPECT_GE(run.collisions.size(), static_cast<size_t>(rows));
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
Problem reordered(const Problem& given, const vector<size_t>& order) {
  Problem other = given;
  for (size_t k = 0; k < order.size(); ++k) {
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

    vector<size_t> order(problem.world.mass.size());
    std::iota(order.begin(), order.end(), size_t{0});
    for (int k = 0; k < 6; ++k) {
      std::rotate(order.begin(), order.begin() + 3, order.end());
      std::reverse(order.begin() + k, order.end());
      const Outcome run = run_exact(reordered(problem, order));
      ASSERT_EQ(run.collisions.size(), first.collisions.size()) << e;
      for (size_t i = 0; i < order.size(); ++i) {
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
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(run.end.velocity[i].x(), expected[i]) << i;
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
  problem.options.duration = sqrt(1.6) + 0.1;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 2u);
  EXPECT_EQ(run.end.velocity[0].x(), 0);
  EXPECT_NEAR(run.end.velocity[0].y(), 0.5 * sqrt(160.0) - 1, 1e-12);
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

/// A ball that just fits between two planes, and that moves along and across them.
Problem in_a_shaft(double e) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 2, 0}, 1, 0.5, e);
  problem.plane({-0.5, 0, 0}, {1, 0, 0});
  problem.plane({0.5, 0, 0}, {-1, 0, 0});
  problem.options.duration = 1;
  return problem;
}

TEST(InstantImpacts, WithoutRoomAnElasticBallStopsAcrossItsShaft) {
  const Outcome run = run_exact(in_a_shaft(1));
  EXPECT_EQ(run.end.velocity[0], Vec3(0, 2, 0));
  EXPECT_EQ(run.tally.shared.without_room, 1u);
  EXPECT_EQ(run.tally.shared.absorbed, 0.5);
  EXPECT_EQ(run.tally.energy_lost, 0.5);
  EXPECT_EQ(run.tally.shared.instants, 0u);
}

TEST(InstantImpacts, WithRestitutionAboveOneThatIsAnError) {
  EXPECT_THROW(run_exact(in_a_shaft(1.1)), SimulationError);
}

/// A hundred touching balls: more rounds at one instant than the loop takes one by one.
TEST(InstantImpacts, ALongChainPassesABlowOnAndEndsInItsLimit) {
  for (const double e : {1.0, 0.9, 0.5}) {
    Problem problem;
    problem.ball({-2, 0, 0}, {1, 0, 0}, 1, 0.5, e);
    for (int i = 0; i < 100; ++i) problem.ball({1.0 * i, 0, 0}, {0, 0, 0}, 1, 0.5, e);
    problem.options.duration = 2;
    const Outcome run = run_exact(problem);
    for (size_t i = 0; i < 101; ++i) {
      const double expected = e < 1 ? 1.0 / 101 : i == 100 ? 1 : 0;
      EXPECT_NEAR(run.end.velocity[i].x(), expected, e < 1 ? 1e-14 : 0) << e << ' ' << i;
    }
  }
}

/// Several impacts on a body, not all with e = 0, are counted, and the first such body is named.
TEST(InstantImpacts, WhatRigidBodiesLeaveOpenIsCounted) {
  const SharedImpacts elastic = run_exact(break_of(2, 1)).tally.shared;
  EXPECT_EQ(elastic.instants, 1u);
  EXPECT_EQ(elastic.ties, 0u);
  EXPECT_NEAR(elastic.first, 0.2, 1e-15);
  EXPECT_EQ(elastic.body, 1u);
  EXPECT_EQ(set({elastic.one, elastic.other}), set({Entity{2}, Entity{3}}));
  EXPECT_EQ(run_exact(break_of(2, 0)).tally.shared.instants, 0u);

  // From both sides at one speed: the outcome is the mean of two that a slight difference chooses between.
  Problem row;
  for (int i = -1; i <= 1; ++i) row.ball({2.0 * i, 0, 0}, {-1.0 * i, 0, 0}, 1, 0.5, 0.5);
  row.options.duration = 2;
  const Outcome run = run_exact(row);
  EXPECT_EQ(run.tally.shared.ties, 1u);
  for (int i = -1; i <= 1; ++i) EXPECT_EQ(run.end.velocity[static_cast<size_t>(i + 1)].x(), 0.5 * i);
}

/// One by one, the fastest first, is another law. It is what `check --accuracy` compares with.
TEST(InstantImpacts, OneByOneTheFirstOfTwoEqualImpactsTakesMore) {
  Problem problem = break_of(2, 1);
  problem.options.one_by_one = true;
  const Outcome run = run_exact(problem);
  const double first = std::max(run.end.velocity[2].norm(), run.end.velocity[3].norm());
  const double second = std::min(run.end.velocity[2].norm(), run.end.velocity[3].norm());
  EXPECT_NEAR(first, 5 * sqrt(3.0), 1e-13);
  EXPECT_NEAR(second, 2.5 * sqrt(3.0), 1e-13);
  EXPECT_NEAR(run.tally.energy_lost, 0, 1e-13);
}

/// With e = 0 what touches stays closed, although at first one pair alone approaches: one row for each pair.
TEST(InstantImpacts, APlasticBlowOnAColumnIsOneProjection) {
  Problem problem;
  problem.plane(Vec3::Zero(), Vec3::UnitY());
  problem.ball({0, 2.5, 0}, {0, -1, 0}, 1, 0.5, 0);
  problem.ball({0, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.options.duration = 2;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 2u);
  for (const Collision& collision : run.collisions) EXPECT_EQ(collision.impulse, 1);
  EXPECT_EQ(run.collisions[0].energy_lost + run.collisions[1].energy_lost, 0.5);
}

/// Two crates, one on the other, land together: the floor stops both.
TEST(InstantImpacts, CratesThatLandTogetherHaveOneRowForEachPair) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane(Vec3::Zero(), Vec3::UnitY());
  for (int k = 0; k < 2; ++k) problem.body(Volume::box(Vec3::Ones()), {0, 5.5 + k, 0}, Vec3::Zero(), 2, 0);
  problem.options.duration = 2;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 2u);
  EXPECT_EQ(run.collisions[0].kind, CollisionKind::body_fixed);
  EXPECT_NEAR(run.collisions[0].impulse, 40, 1e-12);
  EXPECT_NEAR(run.collisions[1].impulse, 20, 1e-12);
  EXPECT_NEAR(run.tally.energy_lost, 200, 1e-12);
}

/// Boxes that share an edge alone do not touch.
TEST(InstantImpacts, BoxesPassAlongASharedEdge) {
  for (const Vec3& corner : {Vec3(1, 0, 1), Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    Problem problem;
    problem.body(Volume::box(Vec3::Ones()), Vec3::Zero(), {1, 0, 0});
    problem.body(Volume::box(Vec3::Ones()), corner, Vec3::Zero());
    problem.options.duration = 3;
    EXPECT_EQ(run_exact(problem).collisions.size(), 0u) << corner.transpose();
  }
}

/// In a block of boxes those struck in front push those behind, and no others.
TEST(InstantImpacts, ABlowPassesStraightThroughABlockOfBoxes) {
  Problem problem;
  problem.body(Volume::box({1, 1, 2}), {-3, 0, 0}, {20, 0, 0}, 20, 0);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) problem.body(Volume::box(Vec3::Ones()), {1.0 * i, 0, j - 2.5}, Vec3::Zero(), 1, 0);
  problem.options.duration = 0.5;
  const Outcome run = run_exact(problem);
  for (size_t i = 0; i < 6; ++i)
    for (size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(run.end.velocity[1 + 6 * i + j].x(), j == 2 || j == 3 ? 12.5 : 0, 1e-13) << i << ' ' << j;
}

/// A shaft that moves as a whole leaves its ball as little room as one at rest, and no less.
/// A list of surfaces that carry a body has room for four.
TEST(InstantImpacts, ABallThatFallsIntoACornerOfSixSurfacesRestsThere) {
  Problem problem;
  problem.world.gravity = Vec3(-1, -1, -1);
  problem.ball({1.5, 1.5, 1.5}, {-1, -1, -1}, 1, 0.5, 0);
  for (int k = 0; k < 6; ++k) problem.plane({0, 0, 0}, Vec3::Unit(k % 3));
  problem.options.duration = 3;

  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 6u);
  for (const Collision& c : run.collisions) EXPECT_NEAR(c.time, sqrt(3) - 1, 1e-15);
  EXPECT_LT((run.end.position[0] - Vec3(0.5, 0.5, 0.5)).norm(), 1e-15);
  EXPECT_TRUE(run.end.velocity[0].isZero(0));
  EXPECT_NEAR(run.tally.energy_lost, 4.5, 1e-14);
}

TEST(InstantImpacts, WallsThatMoveTogetherCarryTheBallBetweenThem) {
  Problem problem = in_a_shaft(1);
  problem.initial.velocity[0] = Vec3::Zero();
  for (const Entity wall : {Entity{1}, Entity{2}}) problem.move(wall, {{0, 10, {1, 0, 0}}});
  const Outcome run = run_exact(problem);
  EXPECT_NEAR(run.end.velocity[0].x(), 1, 1e-15);
  EXPECT_EQ(run.tally.shared.without_room, 1u);
}

}  // namespace
}  // namespace carom
