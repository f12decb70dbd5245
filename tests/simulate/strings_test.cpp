// Strings against closed forms: where they go taut and slack, impacts of them, and what they hold.
#include <gtest/gtest.h>

#include "numerics/polynomial.h"
#include "physics/force_law.h"
#include "simulate/regions.h"
#include "simulate/ties.h"
#include "std.h"

namespace carom {
namespace {

TEST(Strings, ASlackStringHoldsNothingAndGoesTautAtTheTimeOfTheClosedForm) {
  // Falls by h, until the string of length L is straight; e = 0: hangs.
  Tied problem;
  const Entity bob = problem.ball({0.3, 0, 0.4}, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, 1.3);
  problem.options.duration = 1;

  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  const Collision& taut = run.collisions[0];

  const double drop = sqrt(1.3 * 1.3 - 0.25), at = sqrt(2 * drop / g_n), v = g_n * at;
  EXPECT_EQ(taut.kind, CollisionKind::taut);
  EXPECT_NEAR(taut.time, at, 1e-15);
  EXPECT_NEAR(taut.approach_speed, v * drop / 1.3, 1e-14);
  EXPECT_EQ(taut.separation_speed, 0);
  EXPECT_NEAR(taut.impulse, 2 * v * drop / 1.3, 1e-14);
  EXPECT_NEAR(taut.energy_lost, pow(v * drop / 1.3, 2), 1e-13);
  EXPECT_LT((taut.normal - Vec3(0.3, -drop, 0.4) / 1.3).norm(), 1e-15);

  EXPECT_NEAR(run.end.position[0].norm(), 1.3, 1e-12);
  EXPECT_NEAR(residual(problem, run), 0, 1e-11);
}

TEST(Strings, ABallInASlackSphereOfStringBouncesByItsRestitution) {
  Tied problem;
  problem.world.gravity.setZero();
  const Entity bob = problem.ball({0.6, 0, 0}, {0, 2, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, 1).restitution = 1;
  problem.options.duration = 0.4 + 10.5 * 0.8;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.collisions.size(), 11u);
  EXPECT_NEAR(run.end.velocity[0].norm(), 2, 1e-14);
  EXPECT_NEAR(run.end.position[0].norm(), 0.6, 1e-13);
  for (size_t k = 0; k < run.collisions.size(); ++k)
    EXPECT_NEAR(run.collisions[k].time, 0.4 + 0.8 * static_cast<double>(k), 1e-13);
}

TEST(Strings, AHangingBallSleeps) {
  Tied problem;
  const Entity bob = problem.ball({0.1, -1, 0}, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0.1, 0.5, 0}, 1.5);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 10);
  EXPECT_EQ(simulator->state().position[0], problem.initial.position[0]);
  EXPECT_TRUE(simulator->state().velocity[0].isZero(0));
  EXPECT_LT(simulator->effort().events, 10u);
  ASSERT_EQ(simulator->contacts().size(), 1u);
  EXPECT_NEAR(simulator->contacts()[0].force, 2 * g_n, 1e-14);
}

TEST(Strings, AnImpulseAlongATautStringAtTheStartIsAnImpactOfIt) {
  for (const bool rod : {false, true}) {
    Tied problem;
    const Entity bob = problem.ball({0, -1, 0}, {0, 0, 0}, 2, 0.05);
    problem.anchored(bob, {0, 0, 0}, 1).rod = rod;
    problem.world.impulse = {Vec3(0.6, -4, 0)};

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    simulator->advance_to(0.1);

    ASSERT_EQ(simulator->tally().collisions(), 1u);
    ASSERT_EQ(simulator->collisions().size(), 1u);
    const Collision& impact = simulator->collisions()[0];

    EXPECT_EQ(impact.kind, CollisionKind::taut);
    EXPECT_EQ(impact.time, 0);
    EXPECT_NEAR(impact.approach_speed, 2, 1e-15);
    EXPECT_NEAR(impact.impulse, 4, 1e-14);
    EXPECT_NEAR(impact.energy_lost, 4, 1e-14);
    EXPECT_NEAR(simulator->tally().energy_lost, 4, 1e-14);

    const double v = simulator->state().velocity[0].norm(), y = simulator->state().position[0].y();
    EXPECT_NEAR(v * v, 0.09 - 2 * g_n * (y + 1), 1e-10);
  }
}

TEST(Strings, AWhipOfTwoMassesTurnsAboutItsCenterOfMass) {
  // The string goes taut with e = 0: an impulse by the reduced mass. The pair then turns uniformly.
  for (const double heavy : {1.0, 5.0})
    for (const bool swapped : {false, true}) {
      Tied problem;
      problem.world.gravity.setZero();

      const double length = 1, m = 1;
      const Entity still = problem.ball({0, 0, 0}, {0, 0, 0}, heavy, 0.05);
      const Entity flung = problem.ball({0.6, -0.3, 0}, {0, 2, 0}, m, 0.05);
      swapped ? problem.between(still, flung, length) : problem.between(flung, still, length);

      const double taut = 1.1 / 2, later = 3;
      problem.options.duration = taut + later;
      const Outcome run = run_exact(problem);

      ASSERT_EQ(run.collisions.size(), 1u);
      const Collision& c = run.collisions[0];
      const double reduced = m * heavy / (m + heavy);

      EXPECT_NEAR(c.time, taut, 1e-15);
      EXPECT_NEAR(c.approach_speed, 1.6, 1e-14);
      EXPECT_NEAR(c.impulse, reduced * 1.6, 1e-14);
      EXPECT_NEAR(c.energy_lost, 0.5 * reduced * 1.6 * 1.6, 1e-13);

      // Across the string: 2 * 0.6 m/s.
      const double turn = 1.2 / length * later, start = std::atan2(0.8, 0.6);
      const Vec3 center = (m * Vec3(0.6, 0.8, 0) / (m + heavy)) + later * (m * Vec3(0, 2, 0) / (m + heavy));
      const Vec3 along(std::cos(start + turn), std::sin(start + turn), 0);
      EXPECT_LT((run.end.position[flung] - (center + heavy / (m + heavy) * along)).norm(), 1e-12) << heavy;
      EXPECT_LT((run.end.position[still] - (center - m / (m + heavy) * along)).norm(), 1e-12) << heavy;
      EXPECT_NEAR(residual(problem, run), 0, 1e-11);
    }
}

TEST(Strings, UnderASpringAStringGoesTautAtTheTimeOfTheClosedForm) {
  // x = v / w sin w t, until the string of length L is straight; e = 1: there and back.
  Tied problem;
  problem.world.gravity.setZero();
  const double stiffness = 8, mass = 2, w = 2, v = 3, length = 0.75;
  const Entity bob = problem.ball({0, 0, 0}, {v, 0, 0}, mass, 0.05);
  problem.world.forces.push_back({Spring{Vec3::Zero(), stiffness, 0, 0}});
  problem.anchored(bob, {0, 0, 0}, length).restitution = 1;
  const double taut = std::asin(w * length / v) / w;
  problem.options.duration = 10 * taut;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 5u);
  for (size_t k = 0; k < 5; ++k) EXPECT_NEAR(run.collisions[k].time, (2.0 * static_cast<double>(k) + 1) * taut, 1e-13);
  EXPECT_LT(run.end.position[bob].norm(), 1e-12);
}

TEST(Strings, UnderDragAStringGoesTautAtTheTimeOfTheClosedForm) {
  // x = v / k (1 - exp(-k t)).
  for (const double fade : {0.01, 1.0, 3.0}) {
    Tied problem;
    problem.world.gravity.setZero();
    const double mass = 2, v = 3, length = 0.75;
    const Entity bob = problem.ball({0, 0, 0}, {0, v, 0}, mass, 0.05);
    problem.world.forces.push_back({Drag{mass * fade, 0, Vec3::Zero()}});
    problem.anchored(bob, {0, 0, 0}, length);
    problem.options.duration = 3;

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u);
    EXPECT_NEAR(run.collisions[0].time, -std::log1p(-fade * length / v) / fade, 1e-14) << fade;
    EXPECT_NEAR(run.collisions[0].approach_speed, v - fade * length, 1e-13);
    EXPECT_LT(run.end.velocity[bob].norm(), 1e-12);
  }
}

TEST(Strings, NoMethodOfStepsLetsAStringLengthen) {
  for (const Integrator integrator : {Integrator::dop853, Integrator::rk4, Integrator::verlet, Integrator::euler}) {
    Tied problem;
    const Entity a = problem.ball({0.5, 0, 0}, {1, 2, 0.5}, 2, 0.05);
    const Entity b = problem.ball({1, 0.5, 0}, {-1, 1, 0}, 1, 0.05);
    problem.anchored(a, {0, 0, 0}, 0.8).restitution = 0.5;
    problem.between(b, a, 1);
    problem.world.forces.push_back({Spring{Vec3(0.3, 0, 0), 20, 0.3, 0.1}});

    problem.options.integrator = integrator;
    problem.options.step = 0.01;
    problem.options.duration = 3;

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int k = 1; k <= 300; ++k) {
      go_to(*simulator, 0.01 * k);
      const State& state = simulator->state();
      ASSERT_LT(state.position[a].norm(), 0.8 + 1e-12) << int(integrator) << " " << k;
      ASSERT_LT((state.position[a] - state.position[b]).norm(), 1 + 1e-12) << int(integrator) << " " << k;
    }

    EXPECT_GT(simulator->tally().tautened, 0u);
  }
}

TEST(Strings, BouncesOfAStringEndInHanging) {
  Tied problem;
  const Entity bob = problem.ball({0, 0, 0}, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, 1).restitution = 0.5;
  problem.options.duration = 5;
  const Outcome run = run_exact(problem);
  EXPECT_GT(run.collisions.size(), 3u);
  EXPECT_LT((run.end.position[bob] - Vec3(0, -1, 0)).norm(), 1e-12);
  EXPECT_EQ(run.end.velocity[bob], Vec3(0, 0, 0));
  EXPECT_NEAR(run.tally.energy_lost, 2 * g_n, 1e-12);
  EXPECT_NEAR(residual(problem, run), 0, 1e-12);
}

TEST(Strings, AFallingPairTurnsAboutItsCenterOfMass) {
  Tied problem;
  problem.ball({-0.5, 0, 0}, {0, 0, -1.5}, 1, 0.05);
  problem.ball({0.5, 0, 0}, {0, 0, 1.5}, 1, 0.05);
  problem.between(0, 1, 1);
  problem.options.duration = 4;
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.collisions.empty());
  const Vec3 center(0, -0.5 * g_n * 16, 0), along(std::cos(12.0), 0, std::sin(12.0));
  EXPECT_LT((run.end.position[1] - center - 0.5 * along).norm(), 1e-11);
  EXPECT_LT((run.end.position[0] - center + 0.5 * along).norm(), 1e-11);
  EXPECT_NEAR(residual(problem, run), 0, 1e-9);
}

TEST(Strings, ABodyThatIsRemovedIsUntied) {
  // A pair turns; the region takes the one that enters it. The other flies straight.

  Tied problem;
  problem.world.gravity.setZero();
  problem.ball({-0.5, 0, 0}, {0, 0, -1}, 1, 0.05);
  problem.ball({0.5, 0, 0}, {0, 0, 1}, 1, 0.05);
  problem.between(0, 1, 1);
  problem.world.regions.push_back(removing(side_at({0, 0, 0.4}, {0, 0, 1})));
  problem.options.duration = 2;

  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.tally.changes.removed.bodies, 1u);

  const double angle = std::asin(0.8), since = 2 - angle / 2;
  const Vec3 at(-0.3, 0, -0.4), v(0.8, 0, -0.6);
  EXPECT_LT((run.end.position[0] - (at + since * v)).norm(), 1e-11);
}

TEST(Strings, WhatABodyHangsOnFallsWhenItIsRemoved) {
  Tied problem;
  const Entity upper = problem.ball({0, -1, 0}, {0, 0, 0}, 1, 0.05);
  const Entity lower = problem.ball({0, -2, 0}, {0, 0, 0}, 1, 0.05);
  problem.anchored(upper, {0, 0, 0}, 1);
  problem.between(lower, upper, 1);
  // Pushed by a wind from 1 s on until it enters the region.

  problem.world.forces.push_back({UniformForce{Vec3(0.5, 0, 0)}, 1, never, {upper}});
  problem.world.regions.push_back(removing(side_at({0.01, 0, 0}, {1, 0, 0})));

  problem.options.duration = 3;
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.tally.changes.removed.bodies, 1u);
  EXPECT_LT(run.end.position[lower].y(), -5);
}

TEST(Strings, ATiedBallThatSlidesOnAFloorIsHeldOnACircle) {
  Tied problem;
  const Entity bob = problem.ball({1, 0.1, 0}, {0, 0, 2}, 1, 0.1);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.anchored(bob, {0, 0.1, 0}, 1);
  problem.options.duration = 5;
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_LT((run.end.position[bob] - Vec3(std::cos(10.0), 0.1, std::sin(10.0))).norm(), 1e-11);
  EXPECT_NEAR(residual(problem, run), 0, 1e-10);
}

TEST(Strings, ATowedBallFollowsItsTow) {
  // A force on the first of two balls on a floor; the string between them goes taut, and both accelerate.
  Tied problem;
  const Entity first = problem.ball({0, 0.1, 0}, {0, 0, 0}, 1, 0.1);
  const Entity second = problem.ball({-0.5, 0.1, 0}, {0, 0, 0}, 3, 0.1);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.between(second, first, 1);
  problem.world.forces.push_back({UniformForce{Vec3(4, 0, 0)}, 0, never, {first}});
  problem.options.duration = 2.5;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  // Taut after 0.5 s at 2 m/s; then both at 0.5 m/s, with 1 m/s^2.
  EXPECT_NEAR(run.collisions[0].time, 0.5, 1e-15);
  EXPECT_NEAR(run.collisions[0].energy_lost, 0.5 * 0.75 * 4, 1e-14);
  EXPECT_NEAR(run.end.position[first].x(), 0.5 + 1 + 2, 1e-13);
  EXPECT_NEAR(run.end.position[second].x(), -0.5 + 1 + 2, 1e-13);
}

TEST(Strings, AStringThatIsTooShortAtTheStartIsAnError) {
  Tied problem;
  const Entity bob = problem.ball({0, -1, 0}, {0, 0, 0}, 1, 0.1);
  problem.anchored(bob, {0, 0, 0}, 0.99);
  EXPECT_NE(error_of(problem).find("the string of body 0 is 0.98999999999999999 m long"), string::npos)
      << error_of(problem);
  problem.world.strings[0] = {bob, no_entity, Vec3::Zero(), 1.01, 0, true};
  EXPECT_NE(error_of(problem).find("the rod of body 0"), string::npos);
}

TEST(Strings, BodiesThatMergeHaveNone) {
  Tied problem = pendulum(0.5, 1);
  problem.options.merge = true;
  EXPECT_NE(error_of(problem).find("cannot merge"), string::npos);
}

TEST(Strings, ARunThatStopsAtRestEndsWhereTheLastBallHangs) {
  Tied problem;
  const Entity bob = problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.1);
  problem.anchored(bob, {0, 0, 0}, 1).restitution = 0.5;
  problem.options.stop_at_rest = true;
  problem.options.duration = 100;
  const Outcome run = run_exact(problem);
  ASSERT_TRUE(run.tally.end.has_value());
  // The fall takes f, the hops after it f each, by half as much speed: f (1 + 2 (1/2 + 1/4 + ...)).
  EXPECT_NEAR(run.tally.end->time, 3 * sqrt(2 / g_n), 0.05);
}

// A ball that hangs on two almost straight strings: forces of m g / (2 sag), until they have less than three digits.
TEST(Strings, ThatAreAlmostStraightBearAsTheirSagSays) {
  for (const double far : {0.0, 700.0})
    for (const double sag : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      Tied problem;
      problem.world.gravity = Vec3(0, -10, 0);
      const Vec3 ball(far, 0.5 - sag, 0);
      problem.ball(ball, {0, 0, 0}, 1, 0.1);
      for (const double side : {-1, 1}) {
        const Vec3 anchor(far + side, 0.5, 0);
        problem.anchored(0, anchor, (ball - anchor).norm());
      }

      problem.options.duration = 1;
      // What the rounding of coordinates makes of the sag, as a share of it.
      const double rounding = 0x1p-53 * (far + 1) / (sag * sag);
      if (rounding > 4e-3) {
        EXPECT_NE(error_of(problem).find("jammed"), string::npos) << far << ' ' << sag;
        continue;
      }
      if (rounding > 1e-4) continue;

      const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
      const Outcome run = run_to_end(*simulator, 1);
      EXPECT_LT((run.end.position[0] - ball).norm(), 1e-3 * sag);

      const span<const ContactForce> forces = simulator->contacts();
      ASSERT_EQ(forces.size(), 2u);
      for (const ContactForce& f : forces) EXPECT_NEAR(f.force * 2 * sag / 10, 1, 4 * rounding + 2 * sag * sag);
    }
}

// An impulse along a rod from b1 to b0, which a taut string ties to b2. All fall together, so that the string has no
// tension: it is an impact with its own restitution. By hand: the rod takes 1/3 J, the string gives the ends 0.4 m/s.
TEST(Strings, WithoutTensionAtTheStartBounceInAnyOrderOfBodies) {
  const Vec3 places[] = {{0, 0, 0}, {1, 0, 0}, {0.6, -0.8, 0}};
  for (const vector<Entity>& order : {vector<Entity>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 2, 1}})
    for (const bool falls : {false, true})
      for (const bool far_floor : {false, true})
        for (const bool swapped : {false, true}) {
          Tied problem;
          if (!falls) problem.world.gravity = Vec3::Zero();
          Entity at[3];
          for (const Entity b : order) at[b] = problem.ball(places[b], {0, 0, 0}, b == 1 ? 0.5 : 1, 0.125);

          problem.world.impulse.assign(3, Vec3::Zero());
          problem.world.impulse[at[1]] = Vec3(-1, 0, 0);
          if (far_floor) problem.plane({0, -1e3, 0}, {0, 1, 0});

          const auto rod = [&] { problem.between(at[1], at[0], 1).rod = true; };
          if (swapped) rod();
          problem.between(at[2], at[0], 1).restitution = 1;
          if (!swapped) rod();
          problem.options.duration = 0.25;

          const Outcome run = run_exact(problem);
          EXPECT_NEAR(run.tally.energy_lost, 2.0 / 3, 1e-13) << falls << far_floor << swapped;

          size_t of_string = 0;
          for (const Collision& c : run.collisions) {
            if (c.restitution == 0) continue;
            ++of_string;
            EXPECT_NEAR(c.approach_speed, 0.4, 1e-14);
            EXPECT_NEAR(c.separation_speed, 0.4, 1e-14);
          }

          EXPECT_EQ(of_string, 1u);
        }
}

}  // namespace
}  // namespace carom
