// Galilean invariance: where all fixed things move at one velocity from time 0 on, bodies that have it too move as in
// the scene at rest, displaced by that velocity times the time. This holds for every kind of contact.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

constexpr double forever = infinity;

/// The same scene with everything moving at u (m/s). Wind moves along.
Problem moving(Problem problem, const Vec3& u) {
  for (Vec3& v : problem.initial.velocity) v += u;
  for (Entity k = 0; k < problem.world.fixed_count(); ++k)
    problem.move(problem.world.body_count() + k, {{0, forever, u}});
  for (Force& force : problem.world.forces)
    if (auto* drag = std::get_if<Drag>(&force.law)) drag->wind += u;
  return problem;
}

struct Case {
  string name;
  function<Problem()> make;
  double precision;  // m and m/s
};

Problem falling(double duration) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = duration;
  return problem;
}

Problem bouncing() {
  Problem problem = falling(4);
  problem.ball({0, 1, 0}, {0.3, 0, 0}, 2, 0.25, 0.6);
  problem.ball({0.1, 2, 0}, {0, 0, 0.2}, 1, 0.125, 0.6);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.wall({1, 1, 0}, {-1, 0, 0}, 4, 4);
  return problem;
}

Problem groove() {
  Problem problem = falling(2);
  problem.ball({0, 1, 0}, {0.1, 0, 0.3}, 1, 0.25, 0);
  problem.plane({0, 0, 0}, {1, 1, 0.1});
  problem.plane({0, 0, 0}, {-1, 1.5, 0.1});
  return problem;
}

Problem over_a_rim() {
  Problem problem = falling(1.5);
  problem.ball({0, 0.25, 0}, {1, 0, 0}, 1, 0.25, 0.5);
  problem.wall({0, 0, 0}, {0, 1, 0}, 2, 2, {0, 0, 1});
  problem.ball({0, 1.25, 5}, {0.7, 0, 0}, 1, 0.25, 0);
  problem.obstacle({0, 0.5, 5}, Volume::box({2, 1, 2}));
  return problem;
}

Problem off_a_ball() {
  Problem problem = falling(0.6);
  problem.ball({0, 0.75, 0}, {0.5, 0, 0.1}, 1, 0.25, 0.5);
  problem.obstacle({0, 0, 0}, Volume::sphere(0.5));
  problem.ball({0, 0.75, 5}, {0.5, 0, 0.1}, 1, 0.25, 0.5);
  problem.obstacle({0, 0, 5}, Volume::cylinder(0.5, 1));
  return problem;
}

Problem boxes() {
  Problem problem = falling(1.5);
  problem.body(Volume::box({0.5, 0.5, 0.5}), {0, 0.25, 0}, {1, 0, 0.2}, 2, 0);
  problem.body(Volume::cylinder(0.25, 0.5), {0, 0.75, 0}, {1, 0, 0.2}, 1, 0.3);
  problem.obstacle({0, -0.5, 0}, Volume::box({2, 1, 2}));
  problem.plane({0, -1, 0}, {0, 1, 0});
  return problem;
}

Problem train() {
  Problem problem = falling(0.7);
  // Over a hump, in contact with each other.
  for (int k = 0; k < 4; ++k) problem.ball({-1.0 * k, 1, 0}, {1.5, 0, 0}, 1 + 0.2 * k, 0.5, 0);
  problem.obstacle({-2, 0, 0}, Volume::box({6, 1, 2}));
  problem.obstacle({1, 0, 0}, Volume::sphere(0.5));
  return problem;
}

Problem pyramid() {
  Problem problem = falling(1);
  for (int k = 0; k < 3; ++k) problem.ball({1.0 * k, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  for (int k = 0; k < 2; ++k) problem.ball({0.5 + k, 0.5 + sqrt(0.75), 0}, {0, 0, 0}, 1.5, 0.5, 0.5);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.plane({-0.5, 0, 0}, {1, 0, 0});
  problem.plane({2.5, 0, 0}, {-1, 0, 0});
  return problem;
}

Problem in_wind() {
  Problem problem = falling(2);
  problem.world.forces.push_back({Drag{0.8, 0, Vec3(0.5, 0.2, 0)}});
  problem.ball({0, 0.5, 0}, {2, 0, 0}, 1, 0.25, 0.5);
  problem.ball({3, 0.25, 1}, {0.2, 0, 0}, 2, 0.25, 0.3);
  problem.ball({3, 1.25, 5}, {0.2, 0, 0}, 2, 0.25, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.obstacle({3, 0.5, 5}, Volume::sphere(0.5));
  return problem;
}

Problem in_thick_air() {
  Problem problem = in_wind();
  problem.world.forces[0].law = Drag{0.1, 0.3, Vec3(0.5, 0.2, 0)};
  return problem;
}

Problem gas() {
  Problem problem;
  problem.options.duration = 1.5;
  Random random(7);
  for (int k = 0; k < 27; ++k) problem.ball({0.5 + k % 3, 0.5 + k / 3 % 3, 0.5 + k / 9}, in_cube(random, 1), 1, 0.2, 1);
  problem.room({0, 0, 0}, {3, 3, 3});
  return problem;
}

const vector<Case>& cases() {
  static const vector<Case> all = {
      {"bouncing", bouncing, 1e-12},
      {"groove", groove, 1e-12},
      {"over a rim", over_a_rim, 1e-11},
      {"off a ball", off_a_ball, 1e-9},
      {"boxes", boxes, 1e-10},
      {"train", train, 1e-8},
      {"pyramid", pyramid, 1e-10},
      {"in wind", in_wind, 1e-9},
      {"in thick air", in_thick_air, 1e-9},
      {"gas", gas, 1e-9},
  };

  return all;
}

/// Impacts fast enough that rounding does not decide how many there are.
size_t fast_impacts(const Outcome& run) {
  size_t count = 0;
  for (const Collision& c : run.collisions) count += c.approach_speed > 1e-6;
  return count;
}

double mass_of(const Problem& problem) {
  double mass = 0;
  for (const double m : problem.world.mass) mass += m;
  return mass;
}

/// The work of things that all move at u (m/s): their impulse, by the momentum of the bodies, times u (J).
double work_by_momentum(const Problem& problem, const Outcome& run, const Vec3& u) {
  const Vec3 given = mass_of(problem) * problem.options.duration * problem.world.gravity;
  return u.dot(momentum(problem.world, run.end) - momentum(problem.world, problem.initial) - given);
}

void expect_same(const Case& of, const Vec3& u, Integrator integrator, double step) {
  Problem still = of.make();
  still.options.integrator = integrator;
  if (step > 0) still.options.step = step, still.options.closed_forms = false;

  const Problem moved = moving(still, u);
  const Outcome a = run_exact(still), b = run_exact(moved);

  const double t = still.options.duration;
  double off = 0, fast = 0;
  for (Entity i = 0; i < still.world.body_count(); ++i) {
    off = std::max(off, (b.end.position[i] - a.end.position[i] - t * u).norm());
    fast = std::max(fast, (b.end.velocity[i] - a.end.velocity[i] - u).norm());
  }

  const double scale = mass_of(still) * (u.squaredNorm() + g_n * (1 + u.norm() * t));

  EXPECT_EQ(fast_impacts(a), fast_impacts(b)) << of.name;
  EXPECT_LT(off, of.precision) << of.name;
  EXPECT_LT(fast, 10 * of.precision) << of.name;
  // The work of forces along steps of lower order is right to their order.
  const double books = step > 0 ? 1e-4 * scale : 1e-12 * scale;
  EXPECT_NEAR(unbooked(moved, b), unbooked(still, a), books) << of.name;
  EXPECT_NEAR(residual(moved, b), residual(still, a), books) << of.name;
  if (still.world.forces.empty()) {
    EXPECT_NEAR(b.tally.work, work_by_momentum(moved, b, u), 1e-12 * scale) << of.name;
  }
}

Problem heap() {
  Problem problem = falling(1.5);
  Random random(3);
  for (int k = 0; k < 27; ++k)
    problem.ball(Vec3(0.6 + k % 3, 0.6 + k / 9, 0.6 + k / 3 % 3) + in_cube(random, 0.05), {0, 0, 0}, 1, 0.5, 0.3);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.plane({0, 0, 0}, {1, 0, 0});
  problem.plane({0, 0, 0}, {0, 0, 1});
  problem.plane({3.1, 0, 0}, {-1, 0, 0});
  problem.plane({0, 0, 3.1}, {0, 0, -1});
  return problem;
}

// Time stepping depends on speeds, so the motion differs. The balance of work and momentum does not: measured 1e-10,
// and 2e-4 where bodies are struck off their support within a step.
TEST(Galilean, AHeapOnAMovingFloorReceivesItsWork) {
  SLOW_WITH_SANITIZERS();
  for (const Vec3& u : {Vec3(0, 0.5, 0), Vec3(0.3, -0.7, 0.2), Vec3(-12, 3, 1)}) {
    const Problem problem = moving(heap(), u);
    const Outcome run = run_exact(problem);
    EXPECT_GT(run.tally.stepped_contact, 1);
    EXPECT_NEAR(run.tally.work, work_by_momentum(problem, run, u), 1e-3 * std::abs(run.tally.work)) << u.transpose();
    EXPECT_LT(std::abs(residual(problem, run)), 0.12 * run.tally.energy_lost) << "as at rest, to first order";
  }
}

TEST(Galilean, AllKindsOfContactAreTheSameInAFrameThatMoves) {
  for (const Case& of : cases())
    for (const Vec3& u : {Vec3(0, 0.5, 0), Vec3(0.3, -0.7, 0.2), Vec3(-12, 3, 1)})
      expect_same(of, u, Integrator::dop853, 0);
}

TEST(Galilean, ForcesOnCurvedSurfacesAreTheSameAtEachInstant) {
  const Problem still = off_a_ball(), drifting = moving(still, {0.3, -0.7, 0.2});
  const auto at_rest = make_exact_simulator(still.world, still.initial, still.options);
  const auto moves = make_exact_simulator(drifting.world, drifting.initial, drifting.options);

  size_t forces = 0;
  for (double t = 0.0137; t < 0.3; t += 0.0137) {
    go_to(*at_rest, t);
    go_to(*moves, t);
    const span<const ContactForce> a = at_rest->contacts(), b = moves->contacts();
    ASSERT_EQ(a.size(), b.size()) << t;
    for (size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k].force, b[k].force, 1e-10) << t;
    forces += a.size();
  }

  EXPECT_GT(forces, 20u);
}

TEST(Galilean, FlightsInStepsAreTheSameInAFrameThatMoves) {
  for (const Integrator integrator : {Integrator::verlet, Integrator::rk4})
    for (const Case& of : {Case{"in wind", in_wind, 1e-9}, Case{"in thick air", in_thick_air, 1e-9}})
      expect_same(of, {0.3, -0.7, 0.2}, integrator, 0.01);
}

}  // namespace
}  // namespace carom
