// Rest: a body at rest presses by the laws of statics, stays in place, and wakes when it is struck.
#include <gtest/gtest.h>

#include "geometry/contact_time.h"
#include "physics/force_law.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

struct Press {
  Entity a, b;
  double force;  // N
};

/// Runs to the end; at `times` nothing moves, to the last bit, and the forces are these.
void expect_rest(const Problem& problem, const vector<Press>& forces, const vector<double>& times, const string& what,
                 double tolerance) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

  vector<Vec3> first;
  for (double t : times) {
    go_to(*simulator, t);
    EXPECT_EQ(kinetic_energy(problem.world, simulator->state()), 0) << what << " at " << t;
    for (const Press& p : forces) {
      const double f = force_between(*simulator, p.a, p.b);
      EXPECT_NEAR(f, p.force, tolerance * p.force) << what << " at " << t << ": " << p.a << " on " << p.b;
    }
    EXPECT_EQ(simulator->contacts().size(), forces.size()) << what << " at " << t;
    if (first.empty()) first = simulator->state().position;
    EXPECT_EQ(simulator->state().position, first) << what << " at " << t;
  }

  EXPECT_EQ(simulator->tally().resting, problem.world.body_count()) << what;
  EXPECT_LE(simulator->tally().max_overlap, 1e-9 * problem.world.radius[0]) << what;

  const double before =
      kinetic_energy(problem.world, problem.initial) + potential_energy(problem.world, problem.initial);
  const double after = potential_energy(problem.world, simulator->state());
  EXPECT_NEAR(before - after, simulator->tally().energy_lost, 1e-9 * std::abs(before)) << what;
  EXPECT_GE(simulator->tally().energy_lost, -1e-14 * std::abs(before)) << what << ": energy is not made";
}

/// The same, begun at rest and begun a little above.
void expect_rest_and_landing(Problem problem, const vector<Press>& forces, const string& what) {
  problem.options.duration = 20;
  expect_rest(problem, forces, {0, 0.1, 3, 20}, what + ", from the start", 1e-14);  // measured: 8.9e-16
  for (Vec3& x : problem.initial.position) x -= 0.125 * problem.world.gravity.normalized();
  for (double& e : problem.world.restitution) e = 0.5;
  expect_rest(problem, forces, {15, 20}, what + ", after a fall", 1e-9);  // measured: 4.5e-10
}

TEST(Rest, ABallInAGrooveDividesItsWeight) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  const double p = M_PI / 5, q = M_PI / 7;
  const Vec3 n1(std::sin(p), std::cos(p), 0), n2(-std::sin(q), std::cos(q), 0);
  problem.plane({0, 0, 0}, n1);
  problem.plane({0, 0, 0}, n2);
  // The centre is at r from both planes: in the groove's bisector.
  const double r = 0.3, along = r / std::cos((p + q) / 2);
  problem.ball(along * Vec3(std::sin((p - q) / 2), std::cos((p - q) / 2), 0), {0, 0, 0}, 2, r, 0);
  const double weight = 2 * g_n;
  expect_rest_and_landing(
      problem, {{0, 1, weight * std::sin(q) / std::sin(p + q)}, {0, 2, weight * std::sin(p) / std::sin(p + q)}},
      "groove");
}

TEST(Rest, ABallInACornerPressesOnAllThreeSides) {
  Problem problem;
  problem.world.gravity = Vec3(-1, -9, -2);
  problem.room({0, 0, 0}, {3, 3, 3});
  problem.ball({0.25, 0.25, 0.25}, {0, 0, 0}, 2, 0.25, 0);
  expect_rest_and_landing(problem, {{0, 1, 2}, {0, 3, 18}, {0, 5, 4}}, "corner");
}

TEST(Rest, ABallInThePocketOfThreeFixedBallsPressesOnEach) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  // Fixed centres at 0.6 m around the axis, radii that sum to 1 m: 0.8 m below the ball.
  for (int k = 0; k < 3; ++k)
    problem.obstacle({0.6 * std::cos(2 * M_PI * k / 3), 0, 0.6 * std::sin(2 * M_PI * k / 3)}, Volume::sphere(0.5));
  problem.ball({0, 0.8, 0}, {0, 0, 0}, 3, 0.5, 0);
  const double f = 3 * g_n / 3 / 0.8;
  expect_rest_and_landing(problem, {{0, 1, f}, {0, 2, f}, {0, 3, f}}, "pocket");
}

Problem pyramid() {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  // Three balls on the floor, 0.6 m from the axis, each in a corner of two planes; the fourth 0.8 m above their
  // centres.
  for (int k = 0; k < 3; ++k) {
    const Vec3 out(std::cos(2 * M_PI * k / 3), 0, std::sin(2 * M_PI * k / 3)), aside(-out.z(), 0, out.x());
    problem.ball(0.6 * out + Vec3(0, 0.5, 0), {0, 0, 0}, 1, 0.5, 0);
    for (const double side : {-1, 1}) {
      const Vec3 n = (-out + side * aside).normalized();
      problem.plane(0.6 * out - 0.5 * n, n);
    }
  }
  problem.ball({0, 1.3, 0}, {0, 0, 0}, 3, 0.5, 0);
  return problem;
}

TEST(Rest, APyramidOfFourPressesOnFloorAndWalls) {
  const double f = 3 * g_n / 3 / 0.8, wall = f * 0.6 / sqrt(2.0), floor = g_n + g_n;
  vector<Press> forces;
  for (Entity k = 0; k < 3; ++k) {
    forces.push_back({k, 3, f});
    forces.push_back({k, 4, floor});
    forces.push_back({k, 5 + 2 * k, wall});
    forces.push_back({k, 6 + 2 * k, wall});
  }
  expect_rest_and_landing(pyramid(), forces, "pyramid");
}

TEST(Rest, ASmallBodyBouncesOnALargeOneInContactAsByItself) {
  for (const double r : {2e-5, 1e-3}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    problem.options.duration = 0.9 * sqrt(2 * 30 * r / g_n) * 2;
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.body(Volume::box({2, 1, 2}), {0, 0.5, 0}, {0, 0, 0}, 1000, 0);
    problem.ball({0.5, 1 + r, 0}, {0, 0, 0}, 1e-3, r, 0);
    problem.ball({-0.5, 1 + 31 * r, 0}, {0, 0, 0}, 1e-3, r, 0.5);
    problem.world.restitution[0] = 0.5;

    const Outcome run = run_exact(problem);
    ASSERT_FALSE(run.collisions.empty()) << r;

    const Collision& first = run.collisions.front();
    EXPECT_NEAR(first.approach_speed, sqrt(2 * g_n * 30 * r), 1e-9) << r;
    EXPECT_NEAR(first.separation_speed, 0.5 * first.approach_speed, 1e-9) << r;
  }
}

TEST(Rest, ABoxOnABoxOnTheFloor) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.body(Volume::box({1, 0.5, 1}), {0, 0.25, 0}, {0, 0, 0}, 4, 0);
  problem.body(Volume::box({0.5, 0.25, 0.75}), {0.125, 0.625, 0}, {0, 0, 0}, 2, 0);
  expect_rest_and_landing(problem, {{0, 1, 2 * g_n}, {0, 2, 6 * g_n}}, "boxes");
}

TEST(Rest, ACylinderOnABoxThatIsFixed) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.obstacle({0, 0, 0}, Volume::box({2, 1, 2}));
  problem.body(Volume::cylinder(0.25, 0.5), {0.5, 0.75, 0.25}, {0, 0, 0}, 2, 0);
  expect_rest_and_landing(problem, {{0, 1, 2 * g_n}}, "cylinder on box");
}

TEST(Rest, ABallOnACylinderOnABoxOnAWall) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.wall({0, 0, 0}, {0, 1, 0}, 4, 4, {0, 0, 1});
  problem.body(Volume::box({1, 0.5, 1}), {0, 0.25, 0}, {0, 0, 0}, 4, 0);
  problem.body(Volume::cylinder(0.25, 0.5), {0.125, 0.75, 0}, {0, 0, 0}, 2, 0);
  problem.ball({0.125, 1.125, 0.0625}, {0, 0, 0}, 1, 0.125, 0);
  expect_rest_and_landing(problem, {{0, 1, 3 * g_n}, {0, 3, 7 * g_n}, {1, 2, g_n}}, "ball, cylinder, box, wall");
}

TEST(Rest, AColumnOfBallsBetweenWallsStands) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.room({-0.25, 0, -0.25}, {0.25, 100, 0.25});
  for (int i = 0; i < 10; ++i) problem.ball({0, 0.25 + 0.5 * i, 0}, {0, 0, 0}, 1, 0.25, 0);
  vector<Press> forces;
  for (Entity i = 0; i < 9; ++i) forces.push_back({i, i + 1, g_n * (9 - i)});
  forces.push_back({0, 12, 10 * g_n});
  problem.options.duration = 20;
  expect_rest(problem, forces, {0, 0.1, 20}, "column", 1e-14);
}

TEST(Rest, ABodyThatLiesStillCostsNothing) {
  Problem problem = pyramid();
  problem.options.duration = 1e6;
  const Outcome run = run_exact(problem);  // soon, or the test's time limit ends it
  EXPECT_EQ(run.end.velocity[3], Vec3(0, 0, 0));
}

TEST(Rest, AColumnThrowsBackABallThatFallsOnIt) {
  // As many balls as move as a crowd, and fewer: at e = 1 the one that falls from 0.5 m comes up again.
  for (int n : {2, 16, 17, 18, 24, 40}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    problem.plane({0, 0, 0}, {0, 1, 0});
    for (int i = 0; i < n; ++i) problem.ball({0, 0.125 + 0.25 * i, 0}, Vec3::Zero(), 1, 0.125, 1);
    problem.ball({0, 0.125 + 0.25 * n + 0.5, 0}, Vec3::Zero(), 1, 0.125, 1);
    const double fall = sqrt(2 * 0.5 / g_n);
    problem.options.duration = 1.5 * fall;
    const Outcome run = run_exact(problem);
    EXPECT_NEAR(run.end.velocity.back().y(), 0.5 * g_n * fall, 1e-6) << n;
    EXPECT_NEAR(run.tally.energy_lost, 0, 1e-5) << n;  // 2e-6 of 4.9 J
  }
}

TEST(Rest, AnElasticHopBelowRoundingIsNone) {
  for (const bool by_a_ball : {false, true}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -100, 0);
    problem.plane({0, 0, 0}, {0, 1, 0});
    const double under = by_a_ball ? 1 : 0, along = by_a_ball ? 0 : 1;
    problem.ball({0, under + 0.5, 0}, {along, 1e-11, 0}, 1, 0.5, 1);  // by 5e-25 m
    if (by_a_ball) problem.ball({0, 0.5, 0}, Vec3::Zero(), 1, 0.5, 1);

    problem.options.duration = 1;
    problem.options.max_collisions = 10;
    const Outcome run = run_exact(problem);
    EXPECT_EQ(run.end.position[0], Vec3(along, under + 0.5, 0)) << by_a_ball;
  }
}

/// A ball of 1 kg with e = 1 strikes body `target` along `v` at 1 s; the body is at rest before, and moves after.
void expect_wakes(Problem problem, Entity target, const Vec3& from, const Vec3& v, const string& what) {
  const Vec3 x = problem.initial.position[target];
  const Entity n = problem.world.body_count();
  problem.world.restitution[target] = 1;
  problem.world.forces.push_back({UniformAcceleration{-problem.world.gravity}, 0, infinity, {n}});
  problem.ball(from - v, v, 1, 0.125, 1);
  problem.options.duration = 3;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 0.99);
  EXPECT_EQ(simulator->state().velocity[target], Vec3(0, 0, 0)) << what;
  EXPECT_LT((simulator->state().position[target] - x).norm(), 1e-15) << what;
  go_to(*simulator, 1.0 + 1e-9);
  // Free along the impact: as two free masses.
  EXPECT_GT(simulator->state().velocity[target].norm(), 0.1 * v.norm()) << what;
  EXPECT_GE(simulator->tally().body_body, 1u) << what;
}

/// Three kinds of bodies on one another or side by side, sliding along x at `speed` (m/s).
Problem gliding(int kind, double speed, bool forced_far_away) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  const Vec3 v(speed, 0, 0);
  const double e = 0.5;

  if (kind == 0) {
    problem.body(Volume::box({1, 1, 1}), {0, 0.5, 0}, v, 2, e);
    problem.body(Volume::box({0.5, 0.5, 0.5}), {0, 1.25, 0}, v, 1, e);
  } else if (kind == 1) {
    problem.body(Volume::box({1, 1, 1}), {0, 0.5, 0}, v, 1, e);
    problem.body(Volume::box({1, 1, 1}), {1, 0.5, 0}, v, 1, e);
  } else {
    problem.body(Volume::box({1, 1, 1}), {0, 0.5, 0}, v, 1, e);
    problem.ball({0, 1.5, 0}, v, 1, 0.5, e);
    problem.body(Volume::box({1, 1, 1}), {0, 2.5, 0}, v, 1, e);
  }

  if (forced_far_away) {
    const Entity far = problem.ball({0, 0.5, 100}, Vec3::Zero(), 1, 0.5, e);
    problem.world.forces.push_back({UniformForce{Vec3(0, 0, 1e6)}, 0, never, {far}});
  }

  problem.options.duration = 2;
  return problem;
}

TEST(Rest, WhatGlidesHoweverSlowlyGlidesOn) {
  for (int kind = 0; kind < 3; ++kind)
    for (const bool forced_far_away : {false, true})
      for (double speed = 1; speed > 0.9e-10; speed /= 10) {
        const Problem problem = gliding(kind, speed, forced_far_away);
        const Outcome run = run_exact(problem);
        for (Entity i = 0; i < (kind == 2 ? 3u : 2u); ++i) {
          const Vec3 moved = run.end.position[i] - problem.initial.position[i];
          EXPECT_NEAR(moved.x(), 2 * speed, 1e-12 * speed + 1e-15) << kind << ' ' << speed << ' ' << forced_far_away;
          EXPECT_LE(std::abs(moved.y()), 1e-14) << kind << ' ' << speed;
        }
      }
}

TEST(Rest, AStruckBodyWakes) {
  Problem groove;
  groove.world.gravity = Vec3(0, -g_n, 0);
  groove.plane({0, 0, 0}, {1, 1, 0});
  groove.plane({0, 0, 0}, {-1, 1, 0});
  groove.ball({0, 0.25 * sqrt(2.0), 0}, {0, 0, 0}, 1, 0.25, 0);
  expect_wakes(groove, 0, {0, 0.25 * sqrt(2.0), -0.375}, {0, 0, 2}, "groove");
  expect_wakes(pyramid(), 3, {0, 1.3, -0.625}, {0, 0, 2}, "pyramid");

  Problem boxes;
  boxes.world.gravity = Vec3(0, -g_n, 0);
  boxes.plane({0, 0, 0}, {0, 1, 0});
  boxes.body(Volume::box({1, 0.5, 1}), {0, 0.25, 0}, {0, 0, 0}, 4, 0);
  boxes.body(Volume::box({0.5, 0.25, 0.75}), {0.125, 0.625, 0}, {0, 0, 0}, 2, 0);
  expect_wakes(boxes, 1, {0.125, 0.625, -0.5}, {0, 0, 2}, "upper box");
  expect_wakes(boxes, 0, {0, 0.25, -0.625}, {0, 0, 2}, "lower box");
}

}  // namespace
}  // namespace carom
