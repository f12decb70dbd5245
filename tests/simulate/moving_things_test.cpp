// Fixed things that move: closed forms of impacts and of bodies that they carry, and the work that they do.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

constexpr double forever = infinity;

void expect_balanced(const Problem& problem, const Outcome& run, double scale, const string& what = "") {
  const double rounding = 2e-14 * (1 + sqrt(static_cast<double>(run.collisions.size())));
  EXPECT_NEAR(residual(problem, run), 0, rounding * scale) << what;
  EXPECT_NEAR(unbooked(problem, run), 0, rounding * scale) << what;
}

// A point between planes at 0 and at L - u t. Impacts on the second change the speed from v to v + 2 u. From an impact
// there at the gap L_k, the next one is at the gap L_k (v - u) / (v + u), with v the speed after the first of them.
TEST(MovingThings, ABallBetweenAWallAtRestAndOneThatClosesInHasTheSpeedsOfTheClosedForm) {
  for (const double u : {0.25, 0.0625, 1e-3, -0.03}) {
    Problem problem;
    const double radius = 0.5, length = 1, v0 = 1;
    problem.ball({radius, 0, 0}, {v0, 0, 0}, 2, radius);
    problem.plane({0, 0, 0}, {1, 0, 0});
    problem.plane({length + 2 * radius, 0, 0}, {-1, 0, 0});
    problem.move(2, {{0, forever, {-u, 0, 0}}});
    // The ball starts at the wall at rest: the first impact is after L / (v0 + u).
    double v = v0, t = length / (v0 + u), gap = length - u * t;
    problem.options.duration = u > 0 ? 0.987 * length / u : 100;
    if (u < 0) problem.options.duration = 20;

    vector<double> times, speeds;
    while (t < problem.options.duration) {
      v += 2 * u;
      times.push_back(t), speeds.push_back(v);
      const double back = gap / v;
      if (v <= -u * (1 + 1e-9) || !(v + u > 0)) break;
      if (t + back < problem.options.duration) times.push_back(t + back), speeds.push_back(v);
      // In the frame of the wall at rest the ball returns while the other closes in.
      const double next = (gap - u * back) / (v + u);
      t += back + next;
      gap = gap - u * (back + next);
    }

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), times.size()) << u;
    for (size_t k = 0; k < times.size(); ++k) {
      EXPECT_NEAR(run.collisions[k].time, times[k], 1e-13 * times[k]) << u << ' ' << k;
      EXPECT_NEAR(run.collisions[k].energy_lost, 0, 1e-13) << k;
    }

    EXPECT_NEAR(std::abs(run.end.velocity[0].x()), speeds.back(), 1e-13 * speeds.back());
    expect_balanced(problem, run, speeds.back() * speeds.back(), to_string(u));
    EXPECT_NEAR(run.tally.work, speeds.back() * speeds.back() - v0 * v0, 1e-12 * speeds.back() * speeds.back());
  }
}

TEST(MovingThings, ABatDrivesABallByTheSpeedOfTheirApproach) {
  for (int kind = 0; kind < 5; ++kind) {
    Problem problem;
    problem.options.duration = 1;
    const double e = 0.5, mass = 0.145;
    problem.ball({30, 0, 0}, {-40, 0, 0}, mass, 0.25, e);

    if (kind == 0) problem.plane({0, 0, 0}, {1, 0, 0});
    if (kind == 1) problem.wall({0, 0, 0}, {1, 0, 0}, 2, 2);
    if (kind == 2) problem.obstacle({-0.5, 0, 0}, Volume::sphere(0.5));
    if (kind == 3) problem.obstacle({-0.5, 0, 0}, Volume::cylinder(0.5, 1));
    if (kind == 4) problem.obstacle({-0.5, 0, 0}, Volume::box({1, 2, 2}));
    problem.move(1, {{0, forever, {20, 0, 0}}});

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u) << kind;

    const Collision& hit = run.collisions[0];
    EXPECT_NEAR(hit.time, 29.75 / 60, 1e-15) << kind;
    EXPECT_NEAR(hit.approach_speed, 60, 1e-13);
    EXPECT_NEAR(hit.separation_speed, 30, 1e-13);
    EXPECT_NEAR(hit.impulse, mass * 90, 1e-13);
    EXPECT_NEAR(hit.energy_lost, 0.5 * mass * (60 * 60 - 30 * 30), 1e-11);

    EXPECT_NEAR(run.end.velocity[0].x(), 20 + e * 60, 1e-13) << kind;
    EXPECT_NEAR(run.tally.work, mass * 90 * 20, 1e-11) << kind;
    expect_balanced(problem, run, 1e3, to_string(kind));
  }
}

TEST(MovingThings, ATableCarriesABallUpAndThrowsItWhereItStops) {
  for (const double e : {0.0, 0.5}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    const double u = 0.5, mass = 3;
    problem.options.duration = 4;
    problem.ball({0, 0.5, 0}, {0, 0, 0}, mass, 0.5, e);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.move(1, {{0, 2, {0, u, 0}}});
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    go_to(*simulator, 1.5);
    // The hops in the table's frame end 2 e u / (g (1 - e)) after the start.
    EXPECT_NEAR(simulator->state().position[0].y(), 0.5 + u * 1.5, 1e-15);
    EXPECT_NEAR(simulator->state().velocity[0].y(), u, 1e-15);
    go_to(*simulator, 2 + u / g_n);
    EXPECT_NEAR(simulator->state().position[0].y(), 0.5 + u * 2 + u * u / (2 * g_n), 1e-14);
    const Outcome run = run_exact(problem);
    double landing = 0;
    for (const Collision& c : run.collisions)
      if (landing == 0 && c.time > 2) landing = c.time;
    if (e > 0) {
      EXPECT_NEAR(landing, 2 + 2 * u / g_n, 1e-14);
    }
    EXPECT_NEAR(run.end.position[0].y(), 0.5 + 2 * u, 1e-15);
    EXPECT_EQ(run.end.velocity[0].y(), 0);
    // The start: m u^2 (1 + e) and the hops' losses; lasting contact: the weight, and what hops have left.
    expect_balanced(problem, run, mass * g_n, to_string(e));
    EXPECT_NEAR(run.tally.work, mass * g_n * 2 * u + 0.5 * mass * u * u + 0.5 * mass * u * u, 1e-13 * mass * g_n);
  }
}

TEST(MovingThings, ATableThatFallsAwayLeavesItsBallBehind) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 3;
  problem.ball({0, 0.5, 0}, {0, 0, 0}, 2, 0.5, 0.25);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.move(1, {{1, 2, {0, -2, 0}}});

  const Outcome run = run_exact(problem);
  ASSERT_FALSE(run.collisions.empty());
  EXPECT_NEAR(run.collisions[0].time, 1 + 4 / g_n, 1e-15) << "it falls g t^2 / 2, the table 2 t";
  EXPECT_NEAR(run.collisions[0].approach_speed, 2, 1e-14);
  EXPECT_NEAR(run.end.position[0].y(), -1.5, 1e-14);
  expect_balanced(problem, run, 40);
}

// Hops on a plane that steps up by h within each hop: v^2 falls by 2 g h where the plane arrives at rest before.
TEST(MovingThings, APaddleInWindowsChangesEachHop) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.options.duration = 7;
  problem.ball({0, 5.5, 0}, {0, 0, 0}, 1, 0.5, 1);
  problem.plane({0, 0, 0}, {0, 1, 0});
  // It meets the ball at 1 s at its own speed of 1 m/s, then stands 0.125 m higher.
  problem.move(1, {{0.9375, 1.0625, {0, 1, 0}}, {3, 3.5, {0, -0.5, 0}}});
  // The ball falls from 5 m. The plane is at t - 0.9375 then: 5 - 5 t^2 = t - 0.9375.
  const double t1 = (-1 + sqrt(1 + 4 * 5 * 5.9375)) / 10, v1 = 10 * t1 + 2;
  const double y1 = t1 - 0.9375;
  // y1 + v1 s - 5 s^2 = 0.125 (the plane stands at 0.125 until 3 s, then goes down at 0.5 m/s to -0.125).
  const double s = (v1 + sqrt(v1 * v1 + 20 * (y1 - 0.125))) / 10, t2 = t1 + s;
  ASSERT_GT(t2, 3);
  // y1 + v1 s - 5 s^2 = 0.125 - 0.5 (t1 + s - 3)
  const double b = v1 + 0.5, c = y1 - 0.125 + 0.5 * (t1 - 3);
  const double s2 = (b + sqrt(b * b + 20 * c)) / 10;
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.collisions.size(), 2u);
  EXPECT_NEAR(run.collisions[0].time, t1, 1e-15);
  EXPECT_NEAR(run.collisions[1].time, t1 + s2, 2e-15);
  expect_balanced(problem, run, 100);
}

TEST(MovingThings, ManyWindowsMoveAThingWithoutErrorThatGrows) {
  // 10,000 windows of 0.1 m/s over 0.01 s: the sum of the products of the doubles, not of rounded sums.
  vector<MotionWindow> windows;
  long double sum = 0;
  for (int k = 0; k < 10000; ++k) {
    const double from = 0.02 * k, until = from + 0.01;
    windows.push_back({from, until, {0.1, 0, 0}});
    sum += static_cast<long double>(0.1) * (static_cast<long double>(until) - static_cast<long double>(from));
  }
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.plane({1, 0, 0}, {1, 0, 0});
  problem.move(1, windows);
  EXPECT_NEAR(fixed_position(problem.world, 1, {1e9, 0}).x(), static_cast<double>(1.0L + sum), 2e-15);
}

TEST(MovingThings, AFloorThatHasMovedAllTheTimeIsNoEventForAPileOnIt) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 20;
  const Vec3 u(0.25, 0.5, 0);
  for (int k = 0; k < 3; ++k) problem.body(Volume::box({1, 1, 1}), {0, 0.5 + k, 0}, u, 2, 0.5);
  problem.ball({5, 0.5, 0}, u, 1, 0.5, 0.5);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.move(4, {{0, forever, u}});

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 20);
  EXPECT_LT(simulator->effort().events, 100u);

  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.all.empty());
  for (Entity i = 0; i < 4; ++i) {
    EXPECT_LT((run.end.position[i] - problem.initial.position[i] - 20 * u).norm(), 1e-13);
    EXPECT_LT((run.end.velocity[i] - u).norm(), 1e-15);
  }

  EXPECT_NEAR(run.tally.work, 7 * g_n * 10, 1e-11) << "the weights times the height";
  expect_balanced(problem, run, 700);
}

TEST(MovingThings, AFloorThatStartsAndStopsUnderAPileDoesTheWorkOfItsEnergy) {
  for (const double e : {0.0, 0.4}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    problem.options.duration = 8;
    for (int k = 0; k < 3; ++k) problem.body(Volume::box({1, 1, 1}), {0, 0.5 + k, 0}, {0, 0, 0}, 1 + k, e);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.move(3, {{1, 3, {0, 0.5, 0}}, {4, 5, {0, -0.25, 0}}});

    const Outcome run = run_exact(problem);
    for (Entity i = 0; i < 3; ++i) {
      EXPECT_NEAR(run.end.position[i].y(), 0.75 + 0.5 + i, 1e-9) << e;
      EXPECT_LT(run.end.velocity[i].norm(), 1e-9) << e;
    }

    EXPECT_NEAR(residual(problem, run), 0, 1e-6) << e;
    EXPECT_NEAR(run.tally.work - run.tally.energy_lost, 6 * g_n * 0.75, 1e-6) << e;
  }
}

TEST(MovingThings, ASleepingPileWakesWhereItsFloorStarts) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 3;

  for (int k = 0; k < 2; ++k) problem.ball({1.0 * k, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.ball({0.5, 0.5 + sqrt(0.75), 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.obstacle({0.5, -0.5, 0}, Volume::box({2, 1, 2}));
  problem.wall({-0.5, 0.5, 0}, {1, 0, 0}, 2, 2);
  problem.wall({1.5, 0.5, 0}, {-1, 0, 0}, 2, 2);
  problem.move(5, {{2, forever, {0, -20, 0}}});  // it is gone at once

  const Outcome run = run_exact(problem);
  for (Entity i = 0; i < 2; ++i)
    EXPECT_NEAR(run.end.position[i].y(), 0.5 - 0.5 * g_n, 1e-9) << "it falls freely for a second";
  expect_balanced(problem, run, 100);
}

TEST(MovingThings, ABodyWithoutRoomEndsTheRun) {
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const bool gravity : {false, true}) {
      Problem problem;
      if (gravity) problem.world.gravity = Vec3(0, -g_n, 0);
      problem.options.duration = 10;
      problem.ball({0, 0.5, 0}, {0, gravity ? 0 : -1.0, 0}, 1, 0.5, e);
      problem.plane({0, 0, 0}, {0, 1, 0});
      problem.plane({0, 2, 0}, {0, -1, 0});
      problem.move(2, {{0, forever, {0, -0.5, 0}}});
      const string error = error_of(problem);
      EXPECT_NE(error.find("no room left between"), string::npos) << e << ' ' << gravity << ": " << error;
      // A press that leaves room is no error.
      problem.move(2, {{0, 1.9, {0, -0.5, 0}}});
      EXPECT_EQ(error_of(problem), "") << e << ' ' << gravity;
    }
  }
}

// A ball in the corner of a floor and a wall, and an obstacle that presses it into the corner from above.
TEST(MovingThings, ABodyInACornerHasNoRoomBetweenAllThreeThings) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.options.duration = 3;
  problem.ball({0, 0.1, 0}, {0, 0, 0}, 1, 0.1, 0);
  problem.plane({2, 0, 0}, {-1, 0, 0});
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.obstacle({-1, 0.45, 0}, Volume::sphere(0.3));
  problem.move(3, {{0, forever, {1, 0, 0}}});

  const string error = error_of(problem);
  EXPECT_NE(error.find("body 0 has no room left between body 1, body 2 and body 3: end or slow their `motion`"),
            string::npos)
      << error;
}

}  // namespace
}  // namespace carom
