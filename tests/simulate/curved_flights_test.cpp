// The exact simulator under forces that bend paths in no closed form: against Kepler's equation, oscillations, and the
// energy balance.
#include <gtest/gtest.h>

#include <tuple>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/path/curved_flights.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

Force spring(Entity on, const Vec3& anchor, double stiffness, double rest_length, double damping) {
  Force force;
  force.law = Spring{anchor, stiffness, rest_length, damping};
  force.on = {on};
  return force;
}

TEST(CurvedFlights, KeepToKeplersEllipses) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, sqrt(0.5), 0}, 1, 0.01);  // from the far end of an ellipse of eccentricity 1/2
  Force attractor;
  attractor.law = Attractor{Vec3::Zero(), 1, 0};
  problem.world.forces.push_back(attractor);
  const double period = 2 * std::acos(-1.0) * pow(2.0 / 3, 1.5);
  problem.options.duration = 10 * period;
  const Outcome outcome = run_exact(problem);
  EXPECT_LT((outcome.end.position[0] - Vec3(1, 0, 0)).norm(), 5e-11);  // measured: 1.9e-11 m
  EXPECT_NEAR(energy(problem, outcome.end), -0.75, 1e-12);
}

/// A ball that drag brakes from 0.25 s on, so briefly that it hardly moves meanwhile: its position at the end. Linear
/// drag c fades its velocity by exp(-c w), quadratic drag q by 1 / (1 + q v w) (unit mass).
struct Brake {
  double linear, quadratic, window, speed, duration;  // kg/s, kg/m, s, m/s, s
  double end() const {
    const double from = 0.25, w = (from + window) - from, f = quadratic * speed * w;
    const double faded = linear > 0 ? std::exp(-linear * w) : 1 / (1 + f);
    const double way = linear > 0 ? speed * -std::expm1(-linear * w) / linear : std::log1p(f) / quadratic;
    return speed * from + way + speed * faded * (duration - (from + window));
  }
};

// The accuracy of the speed in a moment of strong drag does not depend on the size of the ball. measured: 4e-12
TEST(CurvedFlights, KeepTheirSpeedsDigitsInAMomentOfStrongDrag) {
  for (const double radius : {0.01, 1.0, 1000.0})
    for (const Brake& brake : {Brake{0, 2e8, 1e-9, 5, 1}, Brake{0, 1e6, 1e-9, 1000, 1000},
                               Brake{4e7, 0, 1e-7, 0.5, 1000}, Brake{1e9, 0, 4e-9, 5, 100}}) {
      Problem problem;
      problem.world.gravity = Vec3::Zero();
      problem.ball(Vec3::Zero(), {brake.speed, 0, 0}, 1, radius);

      for (const Drag& drag : {Drag{brake.linear, brake.quadratic, Vec3::Zero()}, Drag{0, 1e-60, Vec3::Zero()}}) {
        Force force{drag};
        force.from = 0.25;
        force.until = 0.25 + brake.window;
        problem.world.forces.push_back(force);
      }

      problem.options.duration = brake.duration;
      const double end = brake.end();
      EXPECT_NEAR(run_exact(problem).end.position[0].x() / end, 1, 1e-10) << radius << ", " << brake.window;
    }
}

// Nor does the accuracy where forces change over a shorter distance than the ball. measured: 2e-7 m, 5e-9 J
TEST(CurvedFlights, PastASmallAttractorAreTheSameForLargeAndSmallBodies) {
  vector<Vec3> ends;
  for (const double radius : {1e-3, 0.1, 10.0, 1000.0}) {
    Problem problem;
    problem.world.gravity = Vec3::Zero();
    problem.ball({1, 0.001, 0}, {-1, 0, 0}, 1, radius);
    problem.world.forces = {{Attractor{Vec3::Zero(), 1, 1e-3}}};
    problem.options.duration = 100;

    const Outcome outcome = run_exact(problem);
    EXPECT_NEAR(energy(problem, outcome.end), energy(problem, problem.initial), 1e-7) << radius;
    ends.push_back(outcome.end.position[0]);
    EXPECT_LT((ends.back() - ends.front()).norm(), 1e-5) << radius;
  }
}

// The ball passes the attractor at 1 / sqrt(2 softening) times the speed of its start's energy. Only that energy is
// left on the other side, so an error of the passage counts by so much more. measured: 3e-7 of the energy
TEST(CurvedFlights, ThroughASmallAttractorKeepTheEnergyThatTheyLeaveWith) {
  for (const double softening : {1e-3, 1e-5, 1e-7, 1e-8})
    for (const double radius : {0.01, 1.0}) {
      Problem problem;
      problem.world.gravity = Vec3::Zero();
      problem.ball({1, 0, 0}, Vec3::Zero(), 1, radius);
      problem.world.forces = {{Attractor{Vec3::Zero(), 1, softening}}};
      problem.options.duration = 4;
      const Outcome outcome = run_exact(problem);
      EXPECT_NEAR(energy(problem, outcome.end), energy(problem, problem.initial), 3e-6) << softening << radius;
    }
}

// Drag takes energy without impacts, at a rising rate.
TEST(CurvedFlights, OfElasticBallsThatDragBrakesEndOnTheFloor) {
  SLOW_WITH_SANITIZERS();
  for (const Force& force : {Force{Drag{10, 0, Vec3::Zero()}}, Force{Drag{10, 0.1, Vec3::Zero()}},
                             Force{Spring{Vec3(0, 0.1, 0), 100, 0, 10}}}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -9.81, 0);
    problem.ball({0, 1, 0}, Vec3::Zero(), 1, 0.2);
    problem.plane(Vec3::Zero(), {0, 1, 0});
    problem.world.forces = {force};
    problem.options.duration = 10;

    const Outcome outcome = run_exact(problem);
    EXPECT_LT(outcome.tally.collisions(), 200'000u);
    EXPECT_GT(outcome.tally.collisions(), 10'000u);
    EXPECT_NEAR(outcome.end.position[0].y(), 0.2, 1e-9);
    EXPECT_TRUE(outcome.end.velocity[0].isZero(0));
    EXPECT_LT(outcome.tally.energy_lost, 1e-8);
    EXPECT_EQ(outcome.tally.resting, 1u);
  }
}

/// The direction of a line.
const vector<Vec3> lines = {Vec3(1, 0, 0), Vec3(0.6, 0.8, 0), Vec3(-1, 2, 2) / 3};

// A push k (l - |s|) turns round at the anchor, s = 0. Between two passages it is an oscillation about l: from rest at
// s0 to the anchor it takes acos(-l / (s0 - l)) / sqrt(k). measured: 2e-8 m, 5e-10 of the energy
TEST(CurvedFlights, ThroughTheAnchorOfASpringWithARestLengthAreOscillationsPutTogether) {
  SLOW_WITH_SANITIZERS();
  for (const Vec3& line : lines)
    for (const Vec3& anchor : {Vec3(0, 0, 0), Vec3(3, -1, 2)})
      for (const auto& [stiffness, length, start] : {std::tuple(10.0, 0.5, 1.5), std::tuple(1e6, 1.0, 2.5)}) {
        Problem problem;
        problem.world.gravity = Vec3::Zero();
        problem.ball(anchor + start * line, Vec3::Zero(), 1, 0.1);
        problem.world.forces = {spring(0, anchor, stiffness, length, 0)};

        const double period = 4 * std::acos(-length / (start - length)) / sqrt(stiffness);
        problem.options.duration = 100 * period;

        const Outcome outcome = run_exact(problem);
        EXPECT_LT((outcome.end.position[0] - problem.initial.position[0]).norm(), 2e-6) << line << stiffness;
        EXPECT_NEAR(energy(problem, outcome.end) / energy(problem, problem.initial), 1, 2e-9) << line << stiffness;
        EXPECT_NEAR(outcome.tally.fastest.speed / ((start - length) * sqrt(stiffness)), 1, 1e-9) << line << stiffness;
      }
}

// A path that misses the anchor: the push turns within a short time. Two anchors on one line turn it twice.
TEST(CurvedFlights, NearTheAnchorOfASpringWithARestLengthKeepTheirEnergy) {
  for (const double miss : {1e-2, 1e-4, 1e-6, 1e-9, 1e-12}) {
    Problem problem;
    problem.world.gravity = Vec3::Zero();
    problem.ball({1.5, miss, 0}, Vec3::Zero(), 1, 0.1);
    problem.world.forces = {spring(0, {0, 0, 0}, 10, 0.5, 0), spring(0, {0.3, 0, 0}, 4, 0.2, 0)};
    problem.options.duration = 20;
    const Outcome outcome = run_exact(problem);
    EXPECT_NEAR(energy(problem, outcome.end) / energy(problem, problem.initial), 1, 1e-8) << miss;
  }
}

TEST(CurvedFlights, MeetWhenTwoOscillationsDo) {
  // Mirror images: each strikes where its spring is slack, so that they swing half periods, back and forth.
  Problem problem;
  for (const double side : {-1.0, 1.0}) {
    const Entity i = problem.ball({side, 0, 0}, Vec3::Zero(), 1, 0.1);
    problem.world.forces.push_back(spring(i, {0.1 * side, 0, 0}, 100, 0, 0));
  }
  const Outcome outcome = run_exact(problem);
  const double half = std::acos(-1.0) / 10;
  ASSERT_EQ(outcome.collisions.size(), 32u);
  for (size_t k = 0; k < 32; ++k)
    EXPECT_NEAR(outcome.collisions[k].time, (static_cast<double>(k) + 0.5) * half, 1e-12) << k;  // measured: 1.3e-13 s
}

TEST(CurvedFlights, MeetWhateverElseFlies) {
  // A ball far away, on another spring, changes no bit.
  Problem problem;
  problem.world.gravity = Vec3(0, -9.81, 0);
  for (const double side : {-1.0, 1.0}) {
    const Entity i = problem.ball({side, 0, 0}, Vec3::Zero(), 1, 0.1);
    problem.world.forces.push_back(spring(i, {0.1 * side, 0, 0}, 100, 0.3, 0.01));
  }

  const Outcome alone = run_exact(problem);

  const Entity far = problem.ball({100, 0, 0}, {1, 2, 3}, 1, 0.1);
  problem.world.forces.push_back(spring(far, {101, 0, 0}, 1e4, 0, 1));
  const Outcome both = run_exact(problem);

  ASSERT_GT(alone.collisions.size(), 10u);
  ASSERT_EQ(alone.collisions.size(), both.collisions.size());
  for (Entity i = 0; i < 2; ++i) EXPECT_EQ(alone.end.position[i], both.end.position[i]);
}

TEST(CurvedFlights, ComeToRestOnAFloorUnderDrag) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 10, 0}, Vec3::Zero(), 1, 0.1, 0.5);
  Force drag;
  drag.law = Drag{0, 0.5, Vec3::Zero()};
  problem.world.forces.push_back(drag);
  const Outcome outcome = run_exact(problem);
  // It strikes at sqrt(g / k) tanh, with v^2 = (g / k) (1 - exp(-2 k h)), k the drag by the mass.
  EXPECT_NEAR(outcome.collisions.front().approach_speed, sqrt(20 * (1 - std::exp(-9.9))), 1e-11);
  EXPECT_EQ(outcome.end.position[0], Vec3(0, 0.1, 0));
  EXPECT_EQ(outcome.end.velocity[0], Vec3(Vec3::Zero()));
  EXPECT_EQ(outcome.tally.resting, 1u);
  EXPECT_NEAR(energy(problem, outcome.end) - 100, outcome.tally.work - outcome.tally.energy_lost, 1e-11);
}

/// Balls side by side on stiff springs, the first lifted by 30 degrees.
Problem cradle(int balls, double stiffness, double damping) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.81, 0);
  const double length = 1 + 9.81 / stiffness;
  for (int k = 0; k < balls; ++k) {
    const Vec3 anchor(0.1 * k, 1, 0);
    const double angle = k == 0 ? std::acos(-1.0) / 6 : 0;
    const Entity i = problem.ball(anchor + length * Vec3(-std::sin(angle), -std::cos(angle), 0), Vec3::Zero(), 1, 0.05);
    problem.world.forces.push_back(spring(i, anchor, stiffness, 1, damping));
  }
  problem.options.duration = 1;
  return problem;
}

TEST(CurvedFlights, OfACradleOnSpringsMakeNoEnergy) {
  SLOW_WITH_SANITIZERS();
  for (const int balls : {3, 7, 12})
    for (const double stiffness : {1e3, 1e5})
      for (const double damping : {0.0, 100.0}) {
        const Problem problem = cradle(balls, stiffness, damping);
        const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
        const double before = energy(problem, simulator->state());

        for (int k = 1; k <= 10000; ++k) {
          while (simulator->time() < 1e-4 * k) simulator->advance_to(1e-4 * k);
          ASSERT_LT(energy(problem, simulator->state()) - before, 1e-9) << balls << " " << stiffness << " " << damping;
        }

        const Tally& tally = simulator->tally();
        EXPECT_GE(tally.energy_lost, -1e-9);
        EXPECT_LT(tally.max_overlap, 1e-12);
        EXPECT_LT(tally.fastest.speed, 1.64);  // of the first, where it strikes
        EXPECT_NEAR(energy(problem, simulator->state()) - before, tally.work - tally.energy_lost, 1e-10);
      }
}

TEST(CurvedFlights, OfACradleInStepsOfAMethodMakeNoEnergyEither) {
  SLOW_WITH_SANITIZERS();
  for (const int balls : {3, 7})
    for (const double stiffness : {1e3, 1e5})
      for (const double damping : {0.0, 100.0})
        for (const auto& [method, step] : {pair(Integrator::rk4, 1e-3), pair(Integrator::verlet, 1e-4)}) {
          Problem problem = cradle(balls, stiffness, damping);
          problem.options.integrator = method;
          problem.options.step = step;

          const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
          const double before = energy(problem, simulator->state());

          for (int k = 1; k <= 1000; ++k) {
            while (simulator->time() < 1e-3 * k) simulator->advance_to(1e-3 * k);
            ASSERT_LT(energy(problem, simulator->state()) - before, 1e-8)
                << balls << " " << stiffness << " " << damping;
          }

          EXPECT_LT(simulator->tally().max_overlap, 1e-12);
          EXPECT_LT(simulator->tally().fastest.speed, 1.64);
        }
}

}  // namespace
}  // namespace carom
