// Impacts keep their restitution at any speed where nothing presses the two together, and whatever else the scene has.
#include <gtest/gtest.h>

#include "geometry/contact_time.h"
#include "physics/force_law.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

constexpr double weight = 9.75;  // m/s^2

/// Balls side by side on strings of 1 m. The first is drawn aside by an angle (degrees).
Problem cradle(int balls, double angle, double e, double radius = 0.0625) {
  Problem problem;
  problem.world.gravity = Vec3(0, -weight, 0);
  problem.options.duration = 0.7;
  for (int k = 0; k < balls; ++k) {
    const double q = k == 0 ? angle * M_PI / 180 : 0;
    problem.ball({2 * radius * k - std::sin(q), -std::cos(q), 0}, {0, 0, 0}, 1, radius, e);
    problem.world.strings.push_back({static_cast<Entity>(k), no_entity, Vec3(2 * radius * k, 0, 0), 1});
  }
  return problem;
}

/// The speed (m/s) at the lowest point of a ball of the cradle, by its energy, with the sign of its place.
double speed_at_the_bottom(const Problem& problem, const State& state, size_t k) {
  const double x = state.position[k].x() - problem.world.strings[k].anchor.x();
  const double height = x * x / (1 + sqrt(1 - x * x));
  return std::copysign(sqrt(state.velocity[k].squaredNorm() + 2 * weight * height), x);
}

TEST(SlowImpacts, ACradlesBallsSeparateByTheirRestitution) {
  for (int balls = 2; balls <= 7; ++balls)
    for (const double angle : {0.1, 0.5, 2.0, 5.0})
      for (const double e : {0.5, 0.7, 0.9, 0.95, 0.99, 0.999, 1.0}) {
        const Problem problem = cradle(balls, angle, e);
        const Outcome run = run_exact(problem);
        ASSERT_GE(run.collisions.size(), static_cast<size_t>(balls - 1)) << balls << " " << angle << " " << e;

        // All impacts happen at the bottom, in the order of the records.
        const double first = 2 * sqrt(weight) * std::sin(angle * M_PI / 360);  // m/s
        vector<double> v(static_cast<size_t>(balls), 0.0);
        v[0] = first;
        for (const Collision& met : run.collisions) {
          const double approach = v[met.a] - v[met.b], change = (1 + e) / 2 * approach;
          EXPECT_NEAR(met.approach_speed, approach, 1e-10 * first) << balls << " " << angle << " " << e;
          v[met.a] -= change;
          v[met.b] += change;
        }
        // At e = 0.5 the impacts of 6 and 7 balls are a collapse, which leaves exp(-8).
        const double bound = e == 0.5 && balls > 5 ? 1e-4 : 1e-10;
        for (size_t k = 0; k < v.size(); ++k)
          EXPECT_NEAR(speed_at_the_bottom(problem, run.end, k), v[k], bound * first)
              << balls << " " << angle << " " << e;
        for (size_t k = 1; k < v.size(); ++k) EXPECT_LE(v[k - 1] - v[k], bound * first);
      }
}

TEST(SlowImpacts, ARestSpeedDoesNotStopWhatNothingPresses) {
  Problem problem = cradle(2, 0.5, 0.999);
  problem.options.rest_speed = 0.05;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  const double met = 2 * sqrt(weight) * std::sin(0.25 * M_PI / 180);
  EXPECT_NEAR(speed_at_the_bottom(problem, run.end, 1), 0.9995 * met, 1e-11);
}

TEST(SlowImpacts, LadenCartsBounceAsEmptyOnes) {
  for (const double size : {0.1, 1.0, 10.0})
    for (const double e : {0.9, 0.999})
      for (const bool laden : {false, true}) {
        const double v = 0.05 * sqrt(size);
        Problem problem;
        problem.world.gravity = Vec3(0, -weight, 0);
        problem.body(Volume::box({size, size, size}), {-size, size / 2, 0}, {v, 0, 0}, 1, e);
        problem.body(Volume::box({size, size, size}), {size, size / 2, 0}, {0, 0, 0}, 1, e);
        for (const double x : {-size, size})
          if (laden) problem.ball({x, 1.05 * size, 0}, {x < 0 ? v : 0, 0, 0}, 1e-6, 0.05 * size, e);
        problem.plane({0, 0, 0}, {0, 1, 0});

        problem.options.duration = 1.5 * size / v;
        const State end = run_exact(problem).end;

        EXPECT_NEAR(end.velocity[0].x() / v, (1 - e) / 2, 1e-9) << size << " " << e << " " << laden;
        EXPECT_NEAR(end.velocity[1].x() / v, (1 + e) / 2, 1e-9) << size << " " << e << " " << laden;
      }
}

/// Two balls, one of them at v (m/s), on what carries them.
enum class Track { plane, wall, box, table, rails, groove };

Problem marbles(Track track, double v, double e) {
  const double r = 0.01;
  Problem problem;
  problem.world.gravity = Vec3(0, -weight, 0);
  problem.options.duration = 3 * r / v;

  double height = r;
  if (track == Track::rails) height = 0.008;
  if (track == Track::groove) height = r * sqrt(2.0);
  problem.ball({-2 * r, height, 0}, {v, 0, 0}, 0.01, r, e);
  problem.ball({2 * r, height, 0}, {0, 0, 0}, 0.01, r, e);

  switch (track) {
    case Track::plane:
      problem.plane({0, 0, 0}, {0, 1, 0});
      break;
    case Track::wall:
      problem.wall({0, 0, 0}, {0, 1, 0}, 1, 1, {0, 0, 1});
      break;
    case Track::box:
      problem.obstacle({0, -0.05, 0}, Volume::box({1, 0.1, 1}));
      break;

    case Track::table:
      problem.body(Volume::box({1, 0.1, 1}), {0, -0.05, 0}, {0, 0, 0}, 10, 0.5);
      problem.plane({0, -0.1, 0}, {0, 1, 0});
      break;

    case Track::rails:
      for (const double z : {-1.0, 1.0}) problem.wall({0, -0.5, 0.006 * z}, {0, 0, z}, 1, 1, {0, 1, 0});
      break;
    case Track::groove:
      for (const double z : {-1.0, 1.0}) problem.plane({0, 0, 0}, {0, 1, z});
      break;
  }

  return problem;
}

TEST(SlowImpacts, MarblesBounceTheSameOnAnythingThatCarriesThem) {
  for (const Track track : {Track::plane, Track::wall, Track::box, Track::table, Track::rails, Track::groove})
    for (const double v : {0.02, 0.002})
      for (const double e : {0.95, 0.5}) {
        const State end = run_exact(marbles(track, v, e)).end;
        EXPECT_NEAR(end.velocity[0].x() / v, (1 - e) / 2, 1e-9) << static_cast<int>(track) << " " << v << " " << e;
        EXPECT_NEAR(end.velocity[1].x() / v, (1 + e) / 2, 1e-9) << static_cast<int>(track) << " " << v << " " << e;
      }
}

TEST(SlowImpacts, ABallThatGrazesASleepingOneKeepsItsSpeedAlongIt) {
  // The normal part of 0.02 m/s is small, and is reversed with e. At b = 1 - 1e-5 and 1 - 1e-6 of the balls' distance.
  for (const double z : {0.9928, 0.99282, 0.98, 0.9})
    for (const double e : {0.9, 0.5, 0.0}) {
      Problem problem;
      problem.world.gravity = Vec3(0, -weight, 0);
      problem.ball({0, 0.619615242270663, 0}, {0, 0, 0}, 1, 0.5, e);
      problem.ball({-1.5, 0.5, z}, {0.02, 0, 0}, 1, 0.5, e);
      for (int k = 0; k < 3; ++k)
        problem.obstacle({0.3 * std::cos(2 * k * M_PI / 3), 0.1, 0.3 * std::sin(2 * k * M_PI / 3)},
                         Volume::sphere(0.1));
      problem.plane({0, 0, 0}, {0, 1, 0});
      problem.options.duration = 120;
      const Outcome run = run_exact(problem);

      ASSERT_FALSE(run.collisions.empty()) << z;
      const Collision& met = run.collisions.front();
      EXPECT_NEAR(met.separation_speed, e * met.approach_speed, 1e-17) << z << " " << e;
      EXPECT_NEAR(met.energy_lost, (1 - e * e) / 2 * met.approach_speed * met.approach_speed, 1e-18) << z << " " << e;
      // The floor takes what is downward of the blow. No more than the two normal parts is lost.
      const double fast = run.end.velocity[1].norm();
      EXPECT_LT(0.02 * 0.02 - fast * fast, 1.3 * met.approach_speed * met.approach_speed) << z << " " << e;
      EXPECT_TRUE(run.end.velocity[0].isZero(0));
    }
}

/// Balls that fall freely and strike one another, with e = 0.9 or so low that they collapse.
Problem swarm(uint64_t seed) {
  Problem problem;
  problem.world.gravity = Vec3(0, -weight, 0);
  problem.options.duration = 3;
  Random random(seed);
  const double e = seed % 3 == 0 ? 0.9 : seed % 3 == 1 ? 0.3 : 0.02;
  for (int k = 0; k < 12; ++k) {
    const Vec3 place(1.1 * (k % 3), 1.1 * (k / 3 % 2), 1.1 * (k / 6));
    const double mass = k % 4 == 0 ? 300 : 1;
    problem.ball(place, -0.3 * (place - Vec3(1.1, 0.55, 0.55)) + in_cube(random, 0.02), mass, 0.5, e);
  }
  return problem;
}

TEST(SlowImpacts, WhatIsFarAwayOrWithoutStrengthChangesNoBitOfFreeFall) {
  size_t impacts = 0;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Problem alone = swarm(seed);
    Problem above_a_plane = alone, beside_a_wall = alone, in_no_wind = alone, above_a_globe = alone;
    above_a_plane.plane({0, -1e5, 0}, {0, 1, 0});
    beside_a_wall.wall({1e4, 0, 0}, {1, 0, 0}, 5, 5);
    in_no_wind.world.forces.push_back({UniformAcceleration{Vec3::Zero()}});
    above_a_globe.obstacle({0, -1e5, 0}, Volume::sphere(0.5));

    const Outcome first = run_exact(alone);
    impacts += first.collisions.size();
    for (const Problem* other : {&above_a_plane, &beside_a_wall, &in_no_wind, &above_a_globe}) {
      const Outcome run = run_exact(*other);
      EXPECT_EQ(run.end.position, first.end.position) << seed;
      EXPECT_EQ(run.end.velocity, first.end.velocity) << seed;
      EXPECT_EQ(run.collisions.size(), first.collisions.size()) << seed;
    }
  }

  EXPECT_GT(impacts, 1000u);
}

TEST(SlowImpacts, TwoHeavyBallsCloseInOnALightOneWithAllTheirBounces) {
  // Pair by pair in 50 decimals: 50 impacts, after which b moves at 0.000350997 m/s.
  for (const bool plane : {false, true}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -weight, 0);
    problem.ball({-1.01, 0, 0}, {0.005, 0, 0}, 300, 0.5, 0.9);
    problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.5, 0.9);
    problem.ball({1.02, 0, 0}, {-0.005, 0, 0}, 300, 0.5, 0.9);
    if (plane) problem.plane({0, -1e5, 0}, {0, 1, 0});
    const Outcome run = run_exact(problem);
    EXPECT_EQ(run.collisions.size(), 50u);
    EXPECT_NEAR(run.end.velocity[2].x(), 0.000350997, 5e-10);
  }
}

TEST(MassRatios, AHeavyBallFallsOnALightOneOfAnyMass) {
  // The light one is struck from both sides until the heavy one rests on it. Its mass decides nothing.
  for (const auto& [light, heavy] :
       {pair(1e-6, 1.0), pair(1e-20, 1.0), pair(1e-30, 1.0), pair(1e-60, 1.0), pair(1.0, 1e60), pair(1e-60, 1e60)}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -9.8, 0);
    problem.ball({0, 1, 0}, {0, 0, 0}, light, 0.1, 0.9);
    problem.ball({0, 3, 0}, {0, 0, 0}, heavy, 0.1, 0.9);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.options.duration = 2;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    const Outcome run = run_to_end(*simulator, 2);

    EXPECT_NEAR(static_cast<double>(run.collisions.size()), 393, 1) << light << " " << heavy;
    EXPECT_LT((run.end.position[0] - Vec3(0, 0.1, 0)).norm(), 1e-15) << light << " " << heavy;
    EXPECT_LT((run.end.position[1] - Vec3(0, 0.3, 0)).norm(), 1e-15) << light << " " << heavy;
    EXPECT_EQ(run.tally.doubts.contacts, 0u);

    ASSERT_EQ(simulator->contacts().size(), 2u);
    for (const ContactForce& contact : simulator->contacts()) EXPECT_NEAR(contact.force / (9.8 * heavy), 1, 1e-5);
  }
}

TEST(MassRatios, LightBodiesBesideHeavyOnesPressWithTheirOwnWeight) {
  // A ball of 1e-50 kg on a plane touches one of 1 kg, and carries one of 3e-50 kg.
  Problem problem;
  problem.world.gravity = Vec3(0, -9.8, 0);
  problem.ball({0, 0.1, 0}, {0, 0, 0}, 1e-50, 0.1, 0);
  problem.ball({0.2, 0.1, 0}, {0, 0, 0}, 1, 0.1, 0);
  problem.ball({0, 0.3, 0}, {0, 0, 0}, 3e-50, 0.1, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.options.duration = 1;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 1);

  const Entity floor = 3;
  for (const ContactForce& contact : simulator->contacts()) {
    const double carried = contact.b == floor ? (contact.a == 0 ? 4e-50 : 1) : 3e-50;  // kg
    EXPECT_NEAR(contact.force / (9.8 * carried), 1, 1e-12) << contact.a << " " << contact.b;
  }
}

/// Two balls that touch nothing else, each on its own spring (N/m), stretched so that both are pulled alike at first.
Problem on_two_springs(double x, double gap, double radius, double first, double second, double at_first) {
  Problem problem;
  problem.ball({x, 0, 0}, {0, 0, 0}, 1, radius);
  problem.ball({x + 2 * radius + gap, 0, 0}, {0, 0, 0}, 1, radius);
  const double right = problem.initial.position[1].x();
  problem.world.forces.push_back({Spring{Vec3(x - at_first / first, 0, 0), first, 0, 0}, 0, never, {0}});
  problem.world.forces.push_back({Spring{Vec3(right - at_first / second, 0, 0), second, 0, 0}, 0, never, {1}});
  return problem;
}

TEST(EqualAccelerations, BodiesOnSpringsMeetWhenTheirPathsPart) {
  // gap = a1 (1 - cos w1 t) - a2 (1 - cos w2 t) with a w^2 the same: by bisection.
  struct Case {
    double x, gap, radius, first, second, pull;
  };
  for (const Case& c : {Case{1024, 1e-7, 0.0001, 1, 64, 64}, Case{1024, 1e-7, 0.0001, 64, 1, 64},
                        Case{0, 1e-9, 0.1, 64, 1, 64}, Case{0, 1e-9, 0.1, 100, 1, 10}}) {
    for (const bool closed : {true, false}) {
      Problem problem = on_two_springs(c.x, c.gap, c.radius, c.first, c.second, c.pull);
      problem.options.duration = 0.03;
      problem.options.closed_forms = closed;
      const double gap = problem.initial.position[1].x() - problem.initial.position[0].x() - 2 * c.radius;
      const auto way = [&](double k, double t) { return 2 * c.pull / k * pow(std::sin(sqrt(k) * t / 2), 2); };
      const auto left = [&](double t) { return gap + way(c.first, t) - way(c.second, t); };
      const Outcome run = run_exact(problem);
      // The stiffer spring slackens first: the left ball must be on it for a meeting.
      if (left(0.03) > 0) {
        EXPECT_TRUE(run.collisions.empty());
        continue;
      }
      double before = 0, after = 0.03;
      for (int k = 0; k < 100; ++k) (left(0.5 * (before + after)) > 0 ? before : after) = 0.5 * (before + after);
      ASSERT_FALSE(run.collisions.empty()) << c.x << " " << c.gap << " " << closed;
      EXPECT_NEAR(run.collisions[0].time / after, 1, 1e-5) << c.x << " " << c.gap << " " << closed;
      EXPECT_LT(run.tally.max_overlap, 1e-12);
      EXPECT_GT(run.end.position[1].x() - run.end.position[0].x(), 2 * c.radius - 1e-12);
    }
  }
}

TEST(EqualAccelerations, ABallFallsOntoOneOnAStifferSpringAtOnce) {
  for (const Integrator method : {Integrator::dop853, Integrator::rk4, Integrator::verlet}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -weight, 0);
    problem.ball({1000, 0.2, 0}, {0, 0, 0}, 1, 0.1, 0);
    problem.ball({1000, 0, 0}, {0, 0, 0}, 1, 0.1, 0);
    problem.world.forces.push_back({Spring{Vec3(1000, 0.2, 0), 1, 0, 0}, 0, never, {0}});
    problem.world.forces.push_back({Spring{Vec3(1000, 0, 0), 100, 0, 0}, 0, never, {1}});
    problem.options.duration = 0.1;
    problem.options.integrator = method;
    if (method != Integrator::dop853) problem.options.step = 0.05;
    const Outcome run = run_exact(problem);
    EXPECT_LT(run.tally.max_overlap, 1e-12) << static_cast<int>(method);
    // They swing together: both weigh on springs of 101 N/m in all.
    const double w = sqrt(101.0 / 2), fallen = weight / (w * w) * (1 - std::cos(w * 0.1));
    if (method == Integrator::dop853) {
      EXPECT_NEAR(run.end.position[0].y(), 0.2 - fallen, 1e-9);
      EXPECT_NEAR(run.end.position[1].y(), -fallen, 1e-9);
    }
  }
}

TEST(Losses, OfALightCylinderUnderAFallingBoxAreThoseOfEachImpact) {
  // The box (e = 0) takes the cylinder with it onto the floor. A row cannot lose more than there is.
  for (const double up : {0.0, 3.0})
    for (const double e : {0.0, 0.95}) {
      Problem problem;
      problem.world.gravity = Vec3(0, -weight, 0);
      problem.body(Volume::cylinder(0.2, 0.1), {0, 0.05, 0}, {0, up, 0}, 0.5, e);
      problem.body(Volume::box({0.4, 0.4, 0.4}), {0, 0.302, 0}, {0, -6, 0}, 95, 0);
      problem.plane({0, 0, 0}, {0, 1, 0});
      problem.world.restitution[1] = 0;
      problem.options.duration = 1;

      const Outcome run = run_exact(problem);
      const double start = energy(problem, problem.initial);
      double lost = run.tally.taken_up.energy;

      for (const Collision& met : run.all) {
        EXPECT_GE(met.energy_lost, 0) << up << " " << e;
        EXPECT_LE(met.energy_lost, start) << up << " " << e;
        lost += met.energy_lost;
      }

      EXPECT_NEAR(lost / run.tally.energy_lost, 1, 1e-12) << up << " " << e;
    }
}

TEST(Losses, OfARodThatOthersMoveBackAreNone) {
  // Two rods and a string stop a ball that an impulse moves at (1, 1, -0.2). Both rods and the string lengthen, but the
  // slanted rod's impulse is along its motion, because the others take back more than the ball has.
  for (const double e : {0.0, 0.5}) {
    Problem problem;
    problem.world.gravity = Vec3::Zero();
    problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.1, e);
    problem.world.impulse = {Vec3(1, 1, -0.2)};

    const Vec3 slanted = Vec3(0.8, 0.5, 0.33).normalized();
    problem.world.strings.push_back({0, no_entity, Vec3(-1, 0, 0), 1, 0, true});
    problem.world.strings.push_back({0, no_entity, Vec3(0, -1, 0), 1, 0, false});
    problem.world.strings.push_back({0, no_entity, -slanted, 1, 0, true});
    problem.options.duration = 0.1;

    const Outcome run = run_exact(problem);
    ASSERT_GE(run.all.size(), 2u);
    double lost = run.tally.taken_up.energy;
    for (const Collision& met : run.all) {
      EXPECT_GE(met.energy_lost, 0);
      lost += met.energy_lost;
    }

    EXPECT_NEAR(lost, 0.5 * 2.04, 1e-12);  // m v^2 / 2: the three directions hold the ball
    EXPECT_LT(run.end.velocity[0].norm(), 1e-12);
  }
}

}  // namespace
}  // namespace carom
