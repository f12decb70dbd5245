// Balls in hollow spheres and tubes, against closed forms and against strings: the centre of a ball in a hollow sphere
// moves as if it were tied to the sphere's centre.
#include <gtest/gtest.h>

#include "geometry/touch.h"
#include "simulate/regions.h"
#include "simulate/ties.h"
#include "std.h"

namespace carom {
namespace {

struct Hollows : Tied {
  void shell(const Vec3& center, double radius, Hollow hollow = Hollow::whole, optional<double> e = nullopt) {
    world.obstacles.push_back({center, Volume::sphere(radius), e, hollow});
  }
  /// The side of a tube, and its ends.
  void tube(const Vec3& center, double radius, double height, bool bottom = true, bool top = true) {
    world.obstacles.push_back({center, Volume::cylinder(radius, height), nullopt, Hollow::side});
    if (bottom) obstacle(center - Vec3(0, height / 2, 0), Volume::cylinder(radius, 0));
    if (top) obstacle(center + Vec3(0, height / 2, 0), Volume::cylinder(radius, 0));
  }
  /// How far a ball is from the nearest shell or end (m).
  double least_gap(const State& state) const {
    double least = infinity;
    for (Entity i = 0; i < world.body_count(); ++i)
      for (Entity e = world.body_count(); e < world.entity_count(); ++e)
        least = min(least, touch(world, i, state.position[i], e, world.fixed_position(e)).gap);
    return least;
  }
};

TEST(Shells, ABallInAHollowSphereFollowsAPolygonOfReflections) {
  Hollows problem;
  problem.world.gravity.setZero();
  problem.ball({0.6, 0, 0}, {0, 2, 0}, 2, 0.25);
  problem.shell({0, 0, 0}, 1.25);
  problem.options.duration = 0.4 + 1000.5 * 0.8;
  const Outcome run = run_exact(problem);

  ASSERT_EQ(run.collisions.size(), 1001u);
  for (size_t k = 0; k < run.collisions.size(); ++k) {
    const Collision& c = run.collisions[k];
    EXPECT_NEAR(c.time, 0.4 + 0.8 * double(k), 1e-12 * (1 + double(k)));
    EXPECT_NEAR(c.approach_speed, 2 * 0.8, 1e-12);
  }
  EXPECT_NEAR(run.end.velocity[0].norm(), 2, 1e-12);
  EXPECT_NEAR(run.end.position[0].norm(), 0.6, 1e-11);
}

TEST(Shells, BouncesOnADiameterSlowDownByTheRestitution) {
  for (const double e : {0.3, 0.8, 0.99}) {
    Hollows problem;
    problem.world.gravity.setZero();
    problem.ball({0, 0, 0}, {1.2, 0, -1.6}, 2, 0.25, e);
    problem.shell({0, 0, 0}, 1.25);
    problem.options.duration = 20;
    const Outcome run = run_exact(problem);

    double time = 0, way = 1, speed = 2;
    for (const Collision& c : run.collisions) {
      time += way / speed;
      EXPECT_NEAR(c.time, time, 1e-12 * time);
      EXPECT_NEAR(c.approach_speed, speed, 1e-12);
      speed *= e;
      way = 2;
    }
    EXPECT_GT(time + 2 / speed, 20);
  }
}

TEST(Shells, ABallInATubeMeetsItsSideAndItsEndsIndependently) {
  Hollows problem;
  problem.world.gravity.setZero();
  problem.ball({0.6, 0.1, 0}, {0, 1.5, 2}, 2, 0.25);
  problem.tube({0, 0, 0}, 1.25, 2.5);
  problem.options.duration = 40;
  const Outcome run = run_exact(problem);

  size_t sides = 0, ends = 0;
  for (const Collision& c : run.collisions) {
    if (c.b == 1)
      EXPECT_NEAR(c.time, 0.4 + 0.8 * double(sides++), 1e-12);
    else
      EXPECT_NEAR(c.time, (0.9 + 2 * double(ends++)) / 1.5, 1e-12);
  }
  EXPECT_EQ(sides, 50u);
  EXPECT_EQ(ends, 30u);
  EXPECT_NEAR(residual(problem, run), 0, 1e-13);
}

TEST(Shells, ABallThatSlidesInABowlIsAPendulum) {
  for (const bool forth : {true, false}) {
    const double angle = 0.5, length = 0.9, once = period(length, angle);
    Hollows problem;
    // In one of two orders of bodies, and with something far away.
    if (forth) problem.ball({300, 0, 0}, {0, 0, 0}, 1, 0.1, 0);
    const Entity ball = problem.ball({length * std::sin(angle), -length * std::cos(angle), 0}, {0, 0, 0}, 2, 0.1, 0);
    if (!forth) problem.ball({300, 0, 0}, {0, 0, 0}, 1, 0.1, 0);
    problem.shell({0, 0, 0}, 1, forth ? Hollow::lower_half : Hollow::whole);
    problem.plane({0, -8000, 0}, {0, 1, 0});
    problem.options.duration = 10 * once;

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int k = 1; k <= 20; ++k) {
      go_to(*simulator, 0.5 * k * once);
      const Vec3& x = simulator->state().position[ball];
      const double side = k % 2 == 0 ? 1 : -1;
      EXPECT_NEAR(x.x(), side * length * std::sin(angle), 1e-11) << k;
      EXPECT_NEAR(x.norm(), length, 1e-12);
    }
    EXPECT_EQ(simulator->tally().collisions(), 0u);
  }
}

TEST(Shells, ABallCirclesInABowlAtTheSpeedOfTheConicalPendulum) {
  // omega^2 = g / h, with h the height of the centre above the circle.
  for (const double h : {0.2, 0.54, 0.8}) {
    Hollows problem;
    const double radius = sqrt(0.81 - h * h), omega = sqrt(g_n / h);
    problem.ball({radius, -h, 0}, {0, 0, omega * radius}, 2, 0.1, 0.5);
    problem.shell({0, 0, 0}, 1, Hollow::lower_half);
    problem.options.duration = 5 * 2 * M_PI / omega;
    const Outcome run = run_exact(problem);
    EXPECT_LT((run.end.position[0] - Vec3(radius, -h, 0)).norm(), 1e-11) << h;
    EXPECT_TRUE(run.collisions.empty());
    EXPECT_NEAR(residual(problem, run), 0, 1e-11);  // measured: 2e-12
  }
}

TEST(Shells, ABallInATubeWithoutWeightCirclesAlongItsSide) {
  Hollows problem;
  problem.world.gravity = Vec3(3, 0, 0);
  const double length = 0.75, angle = 0.5, once = period(length, angle, 3);
  problem.ball({length * std::cos(angle), -0.5, length * std::sin(angle)}, {0, 0.01, 0}, 1, 0.25, 0);
  problem.tube({0, 0, 0}, 1, 4);
  problem.options.duration = 4 * once;
  const Outcome run = run_exact(problem);
  EXPECT_NEAR(run.end.position[0].z(), length * std::sin(angle), 1e-11);
  EXPECT_NEAR(run.end.position[0].y(), -0.5 + 0.01 * 4 * once, 1e-12);
}

TEST(Shells, AHollowSphereIsAStringThatPushes) {
  // Flights, bounces and slides, by every kind of path. In the string problem the ball is on the string's inside, too.
  struct Kind {
    double drag;
    bool spring;
    double e;
  };
  for (const Kind& kind : {Kind{0, false, 0.6}, {0, false, 0}, {0.3, false, 0.6}, {0.2, true, 0.5}, {0, true, 0}}) {
    Hollows hollow, tied;
    for (Hollows* problem : {&hollow, &tied}) {
      const Entity ball = problem->ball({0.3, 0.2, -0.1}, {1, 2, 0.5}, 1, 0.1, kind.e);
      if (problem == &hollow) problem->shell({0, 0, 0}, 1);
      if (problem == &tied) problem->anchored(ball, {0, 0, 0}, 0.9).restitution = kind.e;

      if (kind.drag > 0) problem->world.forces.push_back({Drag{kind.drag, 0, Vec3::Zero()}});
      if (kind.spring) problem->world.forces.push_back({Spring{Vec3(0.3, 0.1, 0), 3, 0.3, 0}});
      problem->options.duration = 3;
    }

    const Outcome a = run_exact(hollow), b = run_exact(tied);
    ASSERT_EQ(a.collisions.size(), b.collisions.size()) << kind.drag;
    EXPECT_GT(a.collisions.size(), 1u);
    for (size_t k = 0; k < a.collisions.size(); ++k)
      EXPECT_NEAR(a.collisions[k].time, b.collisions[k].time, 1e-10) << kind.drag << " " << k;
    EXPECT_LT((a.end.position[0] - b.end.position[0]).norm(), 1e-9);
    EXPECT_NEAR(residual(hollow, a), 0, 1e-11);
  }
}

TEST(Shells, UnderDragABallArrivesAtTheTimeOfTheClosedForm) {
  for (const double fade : {0.01, 1.0, 3.0}) {
    Hollows problem;
    problem.world.gravity.setZero();
    problem.ball({0, 0, 0}, {0, 3, 0}, 2, 0.25, 0);
    problem.world.forces.push_back({Drag{2 * fade, 0, Vec3::Zero()}});
    problem.shell({0, 0, 0}, 1);
    problem.options.duration = 1;
    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u);
    EXPECT_NEAR(run.collisions[0].time, -std::log1p(-fade * 0.75 / 3) / fade, 1e-14) << fade;
    EXPECT_NEAR(run.collisions[0].approach_speed, 3 - fade * 0.75, 1e-13);
  }
}

TEST(Shells, ThatMoveCarryTheirMotion) {
  // A hollow sphere at a constant velocity, and the same as seen from it.
  const Vec3 u(0.5, -0.25, 0.125);
  Hollows still, moving;
  still.ball({0.3, 0.2, -0.1}, {1, 2, 0.5}, 1, 0.1, 1);
  moving.ball({0.3, 0.2, -0.1}, Vec3(1, 2, 0.5) + u, 1, 0.1, 1);
  for (Hollows* problem : {&still, &moving}) {
    problem->shell({0, 0, 0}, 1);
    problem->options.duration = 3;
  }
  moving.move(1, {{0, infinity, u}});
  const Outcome a = run_exact(still), b = run_exact(moving);
  EXPECT_EQ(a.collisions.size(), b.collisions.size());
  EXPECT_GT(a.collisions.size(), 3u);
  EXPECT_LT((b.end.position[0] - 3 * u - a.end.position[0]).norm(), 1e-11);
}

TEST(Shells, ABallFallsThroughTheOpeningAndRestsOnTheBottom) {
  Hollows problem;
  problem.ball({0.2, 3, 0.1}, {0, 0, 0}, 1, 0.1, 0.5);
  problem.tube({0, 0, 0}, 1, 2, true, false);
  problem.options.duration = 10;
  const Outcome run = run_exact(problem);
  ASSERT_FALSE(run.collisions.empty());
  EXPECT_NEAR(run.collisions[0].time, sqrt(2 * 3.9 / g_n), 1e-14);
  EXPECT_EQ(run.collisions[0].b, 2u) << "the bottom";
  EXPECT_LT((run.end.position[0] - Vec3(0.2, -0.9, 0.1)).norm(), 1e-12);
  EXPECT_TRUE(run.end.velocity[0].isZero(0));
}

TEST(Shells, ABallThatFallsOntoTheRimGoesToItsSideOfIt) {
  // Outward and inward of the circle by 0.05 of a radius of 0.1.
  for (const double off : {0.05, -0.05}) {
    Hollows problem;
    problem.ball({1 + off, 1, 0}, {0, 0, 0}, 1, 0.1, 0);
    problem.tube({0, 0, 0}, 1, 1, true, false);
    problem.plane({0, -0.5, 0}, {0, 1, 0});
    problem.options.duration = 8;
    const Outcome run = run_exact(problem);
    EXPECT_NEAR(run.collisions.at(0).time, sqrt(2 * (0.5 - sqrt(0.01 - 0.0025)) / g_n), 1e-13);
    // From there it slides over the rim.
    EXPECT_NEAR(run.end.position[0].y(), -0.4, 1e-12);
    EXPECT_EQ(run.end.position[0].x() < 1, off < 0);
    EXPECT_NEAR(residual(problem, run), 0, 1e-11);
  }
}

TEST(Shells, ABallThatIsFastEnoughJumpsOutOfABowl) {
  // It slides down one side of a half sphere and leaves over the other rim with v^2 = 2 g d for its start d higher.
  Hollows problem;
  problem.ball({-0.9, 0.3, 0}, {0, 0, 0}, 1, 0.1, 0);
  problem.shell({0, 0, 0}, 1, Hollow::lower_half);
  problem.options.duration = 1.5;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  double highest = -1;
  for (int k = 1; k <= 1500; ++k) {
    go_to(*simulator, 0.001 * k);
    const State& state = simulator->state();
    if (state.position[0].x() > 0) highest = max(highest, state.position[0].y());
    ASSERT_GT(problem.least_gap(state), -1e-13) << 0.001 * k;
  }
  EXPECT_NEAR(highest, 0.3, 1e-5) << "as high as it came from";
}

TEST(Shells, NoBallPassesOneUnderAnyForces) {
  Random random(11);
  const auto of = [&] { return random(-1, 1); };
  for (int k = 0; k < 60; ++k) {
    Hollows problem;
    if (k % 2 == 0)
      problem.tube({0, 0, 0}, 1, 1.5, k % 4 == 0, false);
    else
      problem.shell({0, 0, 0}, 1, k % 4 == 1 ? Hollow::lower_half : Hollow::whole);
    if (k % 3 == 1) problem.world.forces.push_back({Drag{0.5, 0, Vec3::Zero()}});
    if (k % 3 == 2) problem.world.forces.push_back({Spring{Vec3(0.2, 0.4, 0.1), 5, 0.3, 0.05}});
    problem.plane({0, -1.5, 0}, {0, 1, 0});

    for (int n = 0; n < 4; ++n) {
      const Vec3 x = Vec3(0.25 * of(), 0.35 * n - 0.4, 0.25 * of());
      problem.ball(x, 4 * Vec3(of(), of(), of()), 1, 0.08 + 0.04 * n, 0.2 * n);
    }
    problem.options.duration = 4;

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int step = 1; step <= 400; ++step) {
      go_to(*simulator, 0.01 * step);
      ASSERT_GT(problem.least_gap(simulator->state()), -1e-11) << k << " at " << 0.01 * step;
    }
  }
}

TEST(Shells, ManyBallsInATubeAndInASphereComeToRest) {
  for (const bool tube : {true, false}) {
    Hollows problem;
    Random random(5);
    for (int n = 0; n < 60; ++n) {
      const Vec3 at(n % 4 - 1.5, n / 16 - 1.5, n / 4 % 4 - 1.5);
      problem.ball(0.27 * at + 0.01 * in_cube(random, 0.5), {0, 0, 0}, 1, 0.12, 0.5);
    }

    if (tube)
      problem.tube({0, 0, 0}, 0.8, 1.6);
    else
      problem.shell({0, 0, 0}, 0.9);

    // In a smooth sphere a heap would swing without end.
    if (!tube) problem.world.forces.push_back({Drag{2, 0, Vec3::Zero()}});
    problem.options.duration = 20;

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int step = 1; step <= 100; ++step) {
      go_to(*simulator, 0.2 * step);
      EXPECT_GT(problem.least_gap(simulator->state()), -1e-3 * 0.12) << tube << " at " << 0.2 * step;
    }
    for (const Vec3& v : simulator->state().velocity) EXPECT_TRUE(v.isZero(0)) << tube;
  }
}

TEST(Shells, ACrowdThatTurnsInATubeKeepsItsMoment) {
  // Two layers turn about the tube's axis, each ball at its own speed: in the end as one.
  Hollows problem;
  for (int n = 0; n < 24; ++n) {
    const double angle = 2 * M_PI * (n % 12) / 12, out = 0.6;
    const Vec3 x(out * std::cos(angle), n < 12 ? -0.39 : -0.1, out * std::sin(angle));
    problem.ball(x, (n % 3 + 0.5) * Vec3(-std::sin(angle), 0, std::cos(angle)), 1, 0.1, 0.3);
  }
  problem.tube({0, 0, 0}, 0.72, 1);
  problem.options.duration = 5;

  const auto moment = [&](const State& state) {
    double sum = 0;
    for (size_t i = 0; i < state.position.size(); ++i) sum += state.position[i].cross(state.velocity[i]).y();
    return sum;
  };

  const Outcome run = run_exact(problem);
  EXPECT_NEAR(moment(run.end) / moment(problem.initial), 1, 1e-3);
}

}  // namespace
}  // namespace carom
