// Rods: what they push and transmit, impulses along them, and where they jam.
#include <gtest/gtest.h>

#include "physics/force_law.h"
#include "simulate/ties.h"
#include "std.h"

namespace carom {
namespace {

TEST(Strings, ARodPushes) {
  // A bob on a rod that stands on end is carried, and falls when it is off balance.
  Tied problem = pendulum(M_PI, 1, true);
  problem.initial.position[0] = Vec3(0, 1, 0);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 10);
  EXPECT_EQ(simulator->state().position[0], Vec3(0, 1, 0));
  ASSERT_EQ(simulator->contacts().size(), 1u);
  EXPECT_NEAR(simulator->contacts()[0].force, -2 * g_n, 1e-14);
}

TEST(Strings, ADumbbellThatStrikesAWallTurns) {
  // Two masses on a rod move along x and meet a wall with one of them, e = 1. The rod transmits: the effective mass
  // along x is that of both masses where they are in line, and of one where the rod is across.
  for (const bool across : {false, true}) {
    Tied problem;
    problem.world.gravity.setZero();
    problem.ball({0, 0, 0}, {2, 0, 0}, 1, 0.1, 1);
    problem.ball(across ? Vec3(0, 1, 0) : Vec3(-1, 0, 0), {2, 0, 0}, 3, 0.05, 1);
    problem.between(0, 1, 1).rod = true;
    problem.plane({1.1, 0, 0}, {-1, 0, 0});
    problem.options.duration = 0.5 + 0.015625;
    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u);
    EXPECT_NEAR(run.collisions[0].time, 0.5, 1e-15);
    EXPECT_NEAR(run.collisions[0].impulse, across ? 4 : 16, 1e-14);
    EXPECT_NEAR(run.tally.energy_lost, 0, 1e-14);
    // Across, their center moves on at 1 m/s, and they turn at 4 rad/s.
    const Vec3 expected =
        across ? Vec3(1.015625 + 0.25 * std::sin(0.0625), 0.75 + 0.25 * std::cos(0.0625), 0) : Vec3(-0.03125, 0, 0);
    EXPECT_LT((run.end.position[1] - expected).norm(), 1e-12) << across;
    EXPECT_NEAR(residual(problem, run), 0, 1e-11);
  }
}

TEST(Strings, ADumbbellThatStrikesAWallWithBothBallsIsThrownBack) {
  Tied problem;
  problem.world.gravity.setZero();
  problem.ball({0, 0, 0}, {2, 0, 0}, 1, 0.1, 1);
  problem.ball({0, 1, 0}, {2, 0, 0}, 3, 0.1, 0.5);
  problem.between(0, 1, 1).rod = true;
  problem.plane({1.1, 0, 0}, {-1, 0, 0});
  problem.options.duration = 0.75;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.collisions.size(), 2u);
  EXPECT_NEAR(run.tally.energy_lost, 0.75 * 0.5 * 3 * 4, 1e-14);
}

// What a rod takes of impulses at time 0 is an impact, as that of a string that is taut.
TEST(Rods, TakeImpulsesAlongThemAsAnImpact) {
  for (const bool rod : {false, true}) {
    Tied problem;
    problem.world.gravity = Vec3::Zero();
    const Entity ball = problem.ball({5, -1, 0}, {0, 0, 0}, 2, 0.1);
    String& s = problem.anchored(ball, {5, 0, 0}, 1);
    s.rod = rod;

    problem.world.impulse = {Vec3(3, -7, 0)};
    problem.options.duration = 0.1;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    EXPECT_EQ(simulator->state().velocity[0], Vec3(1.5, -3.5, 0)) << rod;
    EXPECT_TRUE(simulator->collisions().empty());

    const Outcome run = run_to_end(*simulator, 0.1);
    ASSERT_EQ(run.collisions.size(), 1u) << rod;
    EXPECT_NEAR(run.collisions[0].impulse, 7, 1e-14);
    EXPECT_NEAR(run.tally.energy_lost, 0.5 * 2 * 3.5 * 3.5, 1e-13) << rod;
    EXPECT_NEAR(run.end.velocity[0].norm(), 1.5, 1e-12) << rod;
    EXPECT_NEAR(kinetic_energy(problem.world, run.end), 0.5 * 2 * 1.5 * 1.5, 3e-12);
  }

  // Between two bodies: the effective mass is 3/4 kg.
  Tied pair;
  pair.world.gravity = Vec3::Zero();
  pair.ball({0, 0, 0}, {0, 0, 0}, 1, 0.1);
  pair.ball({1, 0, 0}, {0, 0, 0}, 3, 0.1);
  pair.between(0, 1, 1).rod = true;
  pair.world.impulse = {Vec3(2, 0, 0), Vec3(0, 0, 0)};

  const Outcome run = run_exact(pair);
  EXPECT_NEAR(run.tally.energy_lost, 0.5 * 0.75 * 4, 1e-14);
  for (const Vec3& v : run.end.velocity) EXPECT_NEAR((v - Vec3(0.5, 0, 0)).norm(), 0, 1e-14);
}

// Along a rod between 1 and 3 kg, of 3/4 kg effectively: it pulls and pushes alike.
TEST(Rods, HaveARowForAnImpulseEitherWay) {
  for (const double side : {-1, 1}) {
    Tied pair;
    pair.world.gravity = Vec3::Zero();
    pair.ball({0, 0, 0}, {0, 0, 0}, 1, 0.1);
    pair.ball({1, 0, 0}, {0, 0, 0}, 3, 0.1);
    pair.between(0, 1, 1).rod = true;
    pair.world.impulse = {Vec3(2 * side, 0, 0), Vec3(0, 0, 0)};

    const Outcome run = run_exact(pair);
    ASSERT_EQ(run.collisions.size(), 1u) << side;

    EXPECT_NEAR(run.collisions[0].approach_speed, 2, 1e-14);
    EXPECT_NEAR(run.collisions[0].impulse, 1.5, 1e-14);
    EXPECT_NEAR(run.collisions[0].energy_lost, 1.5, 1e-14);
    EXPECT_NEAR(run.collisions[0].normal.x(), side, 1e-15) << "from the struck body on";
  }
}

// A bob on a rod that runs into another string, which is taut at time 0, or into a floor that it touches.
TEST(Rods, AreNotInTheWayOfImpactsAtTimeZero) {
  for (const bool floor : {false, true}) {
    Tied problem;
    problem.world.gravity = Vec3::Zero();
    const Entity bob = problem.ball({0, -1, 0}, {2, 0, 0}, 3, 0.1, 0);
    problem.anchored(bob, {0, 0, 0}, 1).rod = true;
    if (floor)
      problem.plane({0.1, 0, 0}, {-1, 0, 0});
    else
      problem.anchored(bob, {-1, -1, 0}, 1).restitution = 0;

    problem.options.duration = 0.1;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    EXPECT_EQ(simulator->state().velocity[0], Vec3(2, 0, 0)) << floor;
    EXPECT_TRUE(simulator->collisions().empty());

    const Outcome run = run_to_end(*simulator, 0.1);
    ASSERT_EQ(run.collisions.size(), 1u) << floor;
    EXPECT_NEAR(run.tally.energy_lost, 6, 1e-13) << floor;
    EXPECT_LT(run.end.velocity[0].norm(), 1e-14);
  }
}

// Upright cylinders that touch, joined by a level rod: any motion of one above the other would bring them closer than
// the rod lets them. Far from the origin they can move by less than the rounding of their positions.
TEST(Rods, ThatJamBodiesEndTheRun) {
  for (const double strength : {5.0, 1e-3})
    for (const double far : {0.0, 700.0, 1e5}) {
      Tied problem;
      problem.world.gravity = Vec3(0, -2, 0);
      problem.body(Volume::cylinder(0.25, 1), {far, 0, 0}, {0, 0, 0});
      problem.body(Volume::cylinder(0.5, 1), {far + 0.75, 0, 0}, {0, 0, 0});
      problem.between(0, 1, 0.75).rod = true;
      const Spring spring{{far + 3, 4, 1}, strength, 0, 0};
      problem.world.forces.push_back({spring, 0, infinity, {0}});
      EXPECT_NE(error_of(problem).find("jammed"), string::npos) << strength << ' ' << far << error_of(problem);
    }
}

// A ball between two strings that are exactly straight, and one on a floor to which a rod ties it: both are to move
// across.
TEST(Rods, AndStraightStringsThatJamABallEndTheRun) {
  for (const double far : {0.0, 700.0, 1e5}) {
    Tied rope;
    rope.ball({far, 0.5, 0}, {0, 0, 0}, 1, 0.1);
    for (const double side : {-1, 1}) rope.anchored(0, {far + side, 0.5, 0}, 1);
    EXPECT_NE(error_of(rope).find("jammed"), string::npos) << far << error_of(rope);

    Tied floor;
    floor.world.gravity = Vec3(0.5, -9.81, 0);
    floor.ball({far, 0.5, 0}, {0, 0, 0}, 1, 0.5);
    floor.plane({0, 0, 0}, {0, 1, 0});
    floor.anchored(0, {far, -1, 0}, 1.5).rod = true;
    EXPECT_NE(error_of(floor).find("jammed"), string::npos) << far << error_of(floor);
  }
}

// Frames of touching balls and rods bear more than they need, but nothing jams: thrown, they turn and lose nothing.
TEST(Rods, BetweenTouchingBallsAreNotJammed) {
  for (const double far : {0.0, 700.0}) {
    Tied problem;

    problem.world.gravity = Vec3(0, -9.81, 0);
    problem.ball({far, 0, 0}, {0, 0, 0}, 1, 0.5);
    problem.ball({far + 1, 0, 0}, {0, 0, 0}, 2, 0.5);
    problem.ball({far + 0.5, sqrt(0.75), 0}, {0, 0, 1}, 3, 0.5);
    for (const auto& [a, b] : {pair<Entity, Entity>{0, 1}, {1, 2}, {0, 2}}) problem.between(a, b, 1).rod = true;

    problem.options.duration = 4;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    const Outcome run = run_to_end(*simulator, 4);
    const State& end = run.end;

    for (const auto& [a, b] : {pair<int, int>{0, 1}, {1, 2}, {0, 2}})
      EXPECT_NEAR((end.position[a] - end.position[b]).norm(), 1, 1e-11);
    EXPECT_NEAR(energy(problem, end), energy(problem, problem.initial), 1e-9);
  }
}

// A bob on a rod presses a heavy ball, far from the origin, where rounding lets the two part by more than the clock
// resolves. The rod's curvature presses them together again.
TEST(Rods, PressBodiesTogetherFarFromTheOrigin) {
  Tied problem;
  problem.world.gravity = Vec3::Zero();
  const Vec3 far(-968.451535748, 269.919170012, -514.130972092);

  problem.ball(far, {-0.0832, 0.211, -0.1613}, 386132, 0.3, 0.3);
  problem.ball(far + Vec3(0, 0, 0.6), {-0.536, -0.0325, -0.2464}, 102891122, 0.3, 0.3);
  const Vec3 anchor(-968.4607621, 269.914206923, -514.1327055);
  problem.anchored(0, anchor, (far - anchor).norm()).rod = true;

  problem.world.combine = Combine::mass_weighted;
  problem.options.duration = 1;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  const Outcome run = run_to_end(*simulator, 1);

  EXPECT_LT(simulator->effort().events, 20000u);
  EXPECT_LT(run.tally.max_overlap, 1e-11);
  EXPECT_NEAR((run.end.position[0] - anchor).norm(), (far - anchor).norm(), 1e-11);
}

// A plane that moves on where rods or strings hold a ball, along a rod or between two strings; the same behind a ball
// that a rod and a wall hold up.
TEST(Rods, LeaveNoRoomBeforeAThingThatMoves) {
  const auto error_at = [](Tied& problem, double e, double time) {
    for (double& each : problem.world.restitution) each = e;
    problem.options.duration = 4;
    const string error = error_of(problem);
    EXPECT_NE(error.find("no room left between"), string::npos) << e << ": " << error;
    EXPECT_NEAR(std::strtod(error.c_str() + string("at t = ").size(), nullptr), time, 1e-12) << error;
  };

  for (const double e : {0.0, 0.5, 1.0}) {
    Tied rod;
    rod.world.gravity = Vec3::Zero();
    rod.ball({0, 0, 0}, {0, 0, 0}, 1, 0.125);
    rod.plane({-0.5, 0, 0}, {1, 0, 0});
    rod.move(1, {{0, 2, {0.5, 0, 0}}});
    rod.anchored(0, {1, 0, 0}, 1).rod = true;
    error_at(rod, e, 0.75);

    Tied hanging;
    hanging.ball({0, 1, 0}, {0, 0, 0}, 1, 0.125);
    hanging.plane({0, 0, 0}, {0, 1, 0});
    hanging.move(1, {{0, 9, {0, 0.5, 0}}});
    hanging.anchored(0, {0, 2, 0}, 1).rod = true;
    error_at(hanging, e, 1.75);

    Tied both;  // a string and a rod, neither upright
    both.ball({0, 1, 0}, {0, 0, 0}, 1, 0.125);
    both.plane({0, 0, 0}, {0, 1, 0});
    both.move(1, {{0, 9, {0, 0.5, 0}}});
    both.anchored(0, {-0.75, 2, 0}, 1.25).rod = true;
    both.anchored(0, {0.75, 2, 0}, 1.25).rod = true;
    error_at(both, e, 1.75);

    if (e > 0) continue;  // the balls would bounce between plane and wall
    Tied chain;
    chain.ball({0, 0.125, 0}, {0, 0, 0}, 1, 0.125);
    chain.ball({1, 0.125, 0}, {0, 0, 0}, 1, 0.125);
    chain.plane({0, 0, 0}, {0, 1, 0});
    chain.plane({-0.5, 0, 0}, {1, 0, 0});
    chain.plane({1.125, 0, 0}, {-1, 0, 0});
    chain.move(3, {{0, 2, {0.5, 0, 0}}});
    chain.between(0, 1, 1).rod = true;
    error_at(chain, e, 0.75);
  }
}

// A rod that a plane pushes along until it just fits before a wall, where the plane stops.
TEST(Rods, MayJustFit) {
  Tied problem;
  problem.ball({0, 0.125, 0}, {0, 0, 0}, 1, 0.125, 0);
  problem.ball({1, 0.125, 0}, {0, 0, 0}, 1, 0.125, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.plane({-0.5, 0, 0}, {1, 0, 0});
  problem.plane({1.25, 0, 0}, {-1, 0, 0});

  problem.move(3, {{0, 1, {0.5, 0, 0}}});
  problem.between(0, 1, 1).rod = true;
  problem.options.duration = 2;

  const Outcome run = run_exact(problem);
  EXPECT_NEAR(run.tally.energy_lost, 0.5, 1e-12);
  EXPECT_NEAR(run.end.position[1].x(), 1.125, 1e-12);
  EXPECT_LT(run.end.velocity[0].norm() + run.end.velocity[1].norm(), 1e-12);
}

}  // namespace
}  // namespace carom
