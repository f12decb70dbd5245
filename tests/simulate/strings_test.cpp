// Strings and rods against closed forms: pendulums, impacts on them, chains, cradles.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "numerics/polynomial.h"
#include "physics/force_law.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

struct Tied : Problem {
  Tied() { world.gravity = Vec3(0, -g_n, 0); }
  String& anchored(Entity body, const Vec3& anchor, double length) {
    world.strings.push_back({body, no_entity, anchor, length});
    return world.strings.back();
  }
  String& between(Entity body, Entity other, double length) {
    world.strings.push_back({body, other, Vec3::Zero(), length});
    return world.strings.back();
  }
};

/// The period of a pendulum (s) that swings out to `angle` (rad), by the arithmetic-geometric mean.
double period(double length, double angle) {
  double a = 1, b = std::cos(angle / 2);
  for (int k = 0; k < 8; ++k) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * M_PI * std::sqrt(length / g_n) / a;
}

Tied pendulum(double angle, double length, bool rod = false) {
  Tied problem;
  const Vec3 x(length * std::sin(angle), -length * std::cos(angle), 0);
  const Entity bob = problem.ball(x, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, x.norm()).rod = rod;
  return problem;
}

TEST(Strings, APendulumReturnsAfterThePeriodOfTheEllipticIntegral) {
  for (const bool rod : {false, true})
    for (const double angle : {0.01, 0.7, 1.5, M_PI / 2, 3.0}) {
      if (!rod && angle > M_PI / 2) continue;
      Tied problem = pendulum(angle, 1.25, rod);
      const double length = problem.world.strings[0].length, whole = period(length, angle);
      problem.options.duration = 10 * whole;
      const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
      for (int k = 1; k <= 10; ++k) {
        go_to(*simulator, k * whole);
        const State& state = simulator->state();
        // Measured: 3.3e-13. Near the top errors grow.
        const double error = angle < 2 ? 1e-12 : 1e-12 * k;
        EXPECT_LT((state.position[0] - problem.initial.position[0]).norm(), error) << angle << " " << k;
        EXPECT_LT(state.velocity[0].norm(), 10 * error) << angle << " " << k;  // measured: 2.6e-12
      }
      EXPECT_EQ(simulator->tally().collisions(), 0u);
      EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-11);
      // A step of the method is one flight.
      EXPECT_LT(simulator->effort().events, 3000u) << angle;  // measured: 282 to 2573
    }
}

TEST(Strings, ASlackStringHoldsNothingAndGoesTautAtTheTimeOfTheClosedForm) {
  // Falls by h, until the string of length L is straight; e = 0: hangs.
  Tied problem;
  const Entity bob = problem.ball({0.3, 0, 0.4}, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, 1.3);
  problem.options.duration = 1;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  const Collision& taut = run.collisions[0];
  const double drop = std::sqrt(1.3 * 1.3 - 0.25), at = std::sqrt(2 * drop / g_n), v = g_n * at;
  EXPECT_EQ(taut.kind, CollisionKind::taut);
  EXPECT_NEAR(taut.time, at, 1e-15);
  EXPECT_NEAR(taut.approach_speed, v * drop / 1.3, 1e-14);
  EXPECT_EQ(taut.separation_speed, 0);
  EXPECT_NEAR(taut.impulse, 2 * v * drop / 1.3, 1e-14);
  EXPECT_NEAR(taut.energy_lost, std::pow(v * drop / 1.3, 2), 1e-13);
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

TEST(Strings, ALargeSwingGoesSlackAndTautAgainAtTheClosedForms) {
  // From the lowest point at speed v, with 2 g L < v^2 < 5 g L: the string goes slack at the angle a above the
  // horizontal with sin a = (v^2 - 2 g L) / (3 g L). The speed is then w with w^2 = g L sin a, and the parabola meets
  // the circle again after t = 4 w cos a / g.
  Tied problem;
  const double length = 0.8, v2 = 3.5 * g_n * length;
  const Entity bob = problem.ball({0, -length, 0}, {std::sqrt(v2), 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, length);
  problem.options.duration = 2;
  const double sine = (v2 - 2 * g_n * length) / (3 * g_n * length), cosine = std::sqrt(1 - sine * sine);
  const double w = std::sqrt(g_n * length * sine), flight = 4 * w * cosine / g_n;
  const Vec3 slack = length * Vec3(cosine, sine, 0), u = w * Vec3(-sine, cosine, 0);
  const Vec3 again = slack + flight * u + Vec3(0, -0.5 * g_n * flight * flight, 0);
  EXPECT_NEAR(again.norm(), length, 1e-15);
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.collisions.size(), 1u);
  const Collision& taut = run.collisions[0];
  EXPECT_LT((taut.position - again).norm(), 1e-12);
  const Vec3 speed = u + Vec3(0, -g_n * flight, 0);
  EXPECT_NEAR(taut.approach_speed, speed.dot(again) / length, 1e-11);
  EXPECT_NEAR(residual(problem, run), 0, 1e-10);
  // The time of the swing up to there, by quadrature of the pendulum's equation.
  const double angle = M_PI / 2 + std::asin(sine);
  double swing = 0;
  const int n = 4000;
  for (int k = 0; k <= n; ++k) {
    const double a = angle * k / n, speed2 = v2 - 2 * g_n * length * (1 - std::cos(a));
    swing += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * length / std::sqrt(speed2);
  }
  swing *= angle / n / 3;
  EXPECT_NEAR(taut.time, swing + flight, 1e-12);
}

TEST(Strings, TheBobOfABallisticPendulumRisesByTheSquareOfItsShareOfTheImpulse) {
  // A bullet of mass m and horizontal speed u strikes a bob of mass M at rest: its speed is then (1 + e) m u / (m + M),
  // and a quarter of a period later it hangs still at its greatest angle.
  for (const double e : {0.25, 1.0}) {
    Tied problem;
    const double length = 1.5, m = 0.5, heavy = 3, u = 8, radius = 0.125, before = 0.25;
    const Entity bob = problem.ball({0, 0, 0}, {0, 0, 0}, heavy, radius, e);
    problem.anchored(bob, {0, length, 0}, length);
    const Vec3 meets(-2 * radius, 0, 0), speed(u, 0, 0), g(0, -g_n, 0);
    problem.ball(meets - before * speed + 0.5 * before * before * g, speed - before * g, m, radius, e);
    const double v = (1 + e) * m * u / (m + heavy), angle = std::acos(1 - v * v / (2 * g_n * length));
    problem.options.duration = before + period(length, angle) / 4;
    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u);
    EXPECT_NEAR(run.collisions[0].time, before, 1e-14);
    EXPECT_NEAR(run.collisions[0].impulse, heavy * v, 1e-13);
    EXPECT_NEAR(run.collisions[0].energy_lost, 0.5 * (1 - e * e) * u * u * m * heavy / (m + heavy), 1e-12);
    const Vec3 top = length * Vec3(std::sin(angle), 1 - std::cos(angle), 0);
    EXPECT_LT((run.end.position[bob] - top).norm(), 1e-12) << e;
    EXPECT_NEAR(residual(problem, run), 0, 1e-10);
  }
}

TEST(Strings, PendulumsThatMeetWithoutReboundRiseTogetherByTheSquareOfTheMassesRatio) {
  // m1 falls from the height h1. Both then rise to h1 (m1 / (m1 + m2))^2.
  Tied problem;
  const double length = 1, radius = 0.0625, angle = 0.8, m1 = 1, m2 = 3;
  const Entity first = problem.ball({-std::sin(angle), -std::cos(angle), 0}, {0, 0, 0}, m1, radius, 0);
  const Entity second = problem.ball({2 * radius, -1, 0}, {0, 0, 0}, m2, radius, 0);
  problem.anchored(first, {0, 0, 0}, problem.initial.position[0].norm());
  problem.anchored(second, {2 * radius, 0, 0}, length);
  const double rise = (1 - std::cos(angle)) / 16, after = std::acos(1 - rise);
  problem.options.duration = period(length, angle) / 4 + period(length, after) / 4;
  const Outcome run = run_exact(problem);
  EXPECT_LT((run.end.position[first] - Vec3(std::sin(after), -std::cos(after), 0)).norm(), 1e-12);
  EXPECT_LT((run.end.position[second] - Vec3(2 * radius + std::sin(after), -std::cos(after), 0)).norm(), 1e-12);
  EXPECT_NEAR(run.tally.energy_lost, m1 * g_n * (1 - std::cos(angle)) * m2 / (m1 + m2), 1e-12);
}

/// A bullet meets a hanging bob from the side at which the normal, from the bullet to the bob, is n.
Tied bullet_on_bob(const Vec3& n, double e, double before) {
  Tied problem;
  const double radius = 0.125;
  const Entity bob = problem.ball({0, 0, 0}, {0, 0, 0}, 3, radius, e);
  problem.anchored(bob, {0, 2, 0}, 2);
  const Vec3 meets = -2 * radius * n, speed = 6 * n + Vec3(0.5, 0, 0.75), g(0, -g_n, 0);
  problem.ball(meets - before * speed + 0.5 * before * before * g, speed - before * g, 0.5, radius, e);
  problem.options.duration = before;
  return problem;
}

TEST(Strings, ABobThatIsHitFromAboveMovesAcrossItsStringByTheEffectiveMass) {
  // The string's impulse is simultaneous: 1 / m + sin^2 / M in place of 1 / m + 1 / M.
  for (const double e : {0.5, 1.0})
    for (const double angle : {0.1, 0.5, 1.2}) {
      const Vec3 n(std::sin(angle), -std::cos(angle), 0);
      Tied problem = bullet_on_bob(n, e, 0.125);
      problem.options.duration = 0.125 + 0x1p-20;
      const Outcome run = run_exact(problem);
      ASSERT_EQ(run.collisions.size(), 1u) << angle;
      const Collision& hit = run.collisions[0];
      const double approach = 6 + 0.5 * n.x(), sine = n.x();
      const double impulse = (1 + e) * approach / (1 / 0.5 + sine * sine / 3);
      EXPECT_NEAR(hit.approach_speed, approach, 1e-12);
      EXPECT_NEAR(hit.separation_speed, e * approach, 1e-12);
      EXPECT_NEAR(hit.impulse, impulse, 1e-12);
      EXPECT_NEAR(hit.energy_lost, 0.5 * impulse * (1 - e) * approach, 1e-12);
      const double v = impulse * sine / 3, w = v / 2 * 0x1p-20;
      EXPECT_LT((run.end.position[0] - Vec3(2 * std::sin(w), 2 - 2 * std::cos(w), 0)).norm(), 1e-15) << angle;
      EXPECT_NEAR(residual(problem, run), 0, 1e-11) << angle;
    }
}

TEST(Strings, ABobThatIsHitFromBelowLeavesItsStringSlack) {
  for (const double angle : {0.1, 0.5, 1.2}) {
    const Vec3 n(std::sin(angle), std::cos(angle), 0);
    Tied problem = bullet_on_bob(n, 0.5, 0.125);
    problem.options.duration = 0.125 + 0x1p-10;
    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u) << angle;
    const double impulse = 1.5 * (6 + 0.5 * n.x()) / (1 / 0.5 + 1.0 / 3);
    EXPECT_NEAR(run.collisions[0].impulse, impulse, 1e-12);
    EXPECT_LT((run.end.position[0] - (0x1p-10 * impulse / 3 * n + Vec3(0, -0.5 * g_n * 0x1p-20, 0))).norm(), 1e-15);
  }
}

/// Three bobs between two anchors, taut and in balance: A hangs from the left, C from the right, B between them.
Tied hammock() {
  Tied problem;
  problem.ball({-0.5, -1, 0}, {0, 0, 0}, 1, 0.0625, 1);
  problem.ball({0, -1.25, 0}, {0, 0, 0}, 2, 0.0625, 1);
  problem.ball({0.5, -1, 0}, {0, 0, 0}, 1, 0.0625, 1);
  // kg, by g: half of B's weight, and from the slope 1/2 of B's strings their horizontal pull; with A's weight.
  const double half = 1, level = 2 * half, down = half + 1;
  const Vec3 out = Vec3(-level, down, 0);
  for (const auto& [from, to] : {std::pair<Entity, Entity>{0, 1}, {1, 2}})
    problem.between(from, to, (problem.initial.position[from] - problem.initial.position[to]).norm());
  problem.anchored(0, problem.initial.position[0] + 0.5 * out, (0.5 * out).norm());
  problem.anchored(2, problem.initial.position[2] + 0.5 * Vec3(level, down, 0), (0.5 * out).norm());
  return problem;
}

TEST(Strings, AnImpulseRunsThroughAllTautStringsAtOnce) {
  Tied problem = hammock();
  problem.options.duration = 1;
  const auto still = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*still, 1);
  for (Entity i = 0; i < 3; ++i)
    EXPECT_LT((still->state().position[i] - problem.initial.position[i]).norm(), 1e-15) << i;
  EXPECT_LT(still->effort().events, 40u);
  // A bullet from above and the left on A.
  const Vec3 n(0.6, -0.8, 0), g(0, -g_n, 0), speed = 5 * n;
  const Vec3 meets = problem.initial.position[0] - 0.125 * n;
  problem.ball(meets - 0.125 * speed + 0.5 * 0.125 * 0.125 * g, speed - 0.125 * g, 0.5, 0.0625, 1);
  problem.options.duration = 0.125 + 0x1p-20;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  // Unknowns: the changes of A's, B's and C's velocities, the impulses of four strings and that of the bullet, J.
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(14, 14);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(14), solution;
  for (int i = 0; i < 9; ++i) m(i, i) = problem.world.mass[static_cast<size_t>(i / 3)];
  const auto row = [&](int c, Entity body, const Vec3& along) {
    for (int k = 0; k < 3; ++k) {
      m(9 + c, 3 * static_cast<int>(body) + k) += along[k];
      m(3 * static_cast<int>(body) + k, 9 + c) -= along[k];
    }
  };
  for (int c = 0; c < 4; ++c) {
    const String& s = problem.world.strings[static_cast<size_t>(c)];
    const Vec3 x = problem.initial.position[s.body];
    const Vec3 along = ((s.other == no_entity ? s.anchor : problem.initial.position[s.other]) - x).normalized();
    row(c, s.body, along);
    if (s.other != no_entity) row(c, s.other, -along);
  }
  row(4, 0, n);
  m(13, 13) = 1 / 0.5;  // the bullet's own change is -J / m
  right[13] = 2 * 5;
  solution = m.fullPivLu().solve(right);
  for (int c = 0; c < 4; ++c) ASSERT_GT(solution[9 + c], 0) << "string " << c << " has a share";
  EXPECT_NEAR(run.collisions[0].impulse, solution[13], 1e-12);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT((run.end.position[static_cast<size_t>(i)] - problem.initial.position[static_cast<size_t>(i)] -
               0x1p-20 * solution.segment<3>(3 * i))
                  .norm(),
              1e-10)
        << i;
  EXPECT_NEAR(residual(problem, run), 0, 1e-11);
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

/// Seven balls in a row, each on one string or on two in a V. The first ones are lifted.
Tied cradle(double angle, bool vee, int lifted = 1) {
  Tied problem;
  const double radius = 0.0625;
  for (int k = 0; k < 7; ++k) {
    const double x = 2 * radius * k;
    const Vec3 off = k < lifted ? Vec3(-std::sin(angle), -std::cos(angle), 0) : Vec3(0, -1, 0);
    const Entity i = problem.ball(Vec3(x, 0, 0) + off, {0, 0, 0}, 1, radius, 1);
    for (const double z : {-0.75, 0.75}) {
      if (!vee && z < 0) continue;
      const Vec3 anchor(x, 0, vee ? z : 0);
      problem.anchored(i, anchor, (problem.initial.position[i] - anchor).norm());
    }
  }
  return problem;
}

TEST(Strings, TheCradleOfSevenSwingsWithThePeriodOfOnePendulum) {
  for (const bool vee : {false, true}) {
    const double angle = 0.5, whole = period(1, angle);
    Tied problem = cradle(angle, vee);
    problem.options.duration = 10 * whole;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int k = 1; k <= 10; ++k) {
      go_to(*simulator, (k - 0.5) * whole);
      const Vec3 last = problem.initial.position[6] + Vec3(std::sin(angle), 1 - std::cos(angle), 0);
      EXPECT_LT((simulator->state().position[6] - last).norm(), 1e-12) << vee << k;  // measured: 1.8e-13
      go_to(*simulator, k * whole);
      for (Entity i = 0; i < 7; ++i)
        EXPECT_LT((simulator->state().position[i] - problem.initial.position[i]).norm(), 1e-12)
            << vee << " " << k << ": " << i;
    }
    EXPECT_EQ(simulator->tally().body_body, 120u);
    EXPECT_EQ(simulator->tally().collisions(), 120u);
    EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-11);
  }
}

TEST(Strings, AsManyBallsOfACradleRiseAsAreLifted) {
  for (int lifted = 2; lifted <= 6; ++lifted) {
    const double angle = 0.5, whole = period(1, angle);
    Tied problem = cradle(angle, false, lifted);
    problem.options.duration = 4 * whole;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int k = 1; k <= 4; ++k) {
      go_to(*simulator, (k - 0.5) * whole);
      for (Entity i = 0; i < 7; ++i) {
        const bool rises = static_cast<int>(i) >= 7 - lifted;
        const Vec3 at =
            Vec3(0.125 * i, -1, 0) + (rises ? Vec3(std::sin(angle), 1 - std::cos(angle), 0) : Vec3(0, 0, 0));
        EXPECT_LT((simulator->state().position[i] - at).norm(), 1e-11) << lifted << " " << k << ": " << i;
      }
      go_to(*simulator, k * whole);
    }
    EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-10);
  }
}

/// A chain in a plane, from (0, 0) down, by its angles: Lagrange's equations, and Runge and Kutta's method in steps so
/// short that its error is rounding.
class ChainReference {
 public:
  ChainReference(vector<double> mass, vector<double> length, vector<double> angle)
      : mass_(std::move(mass)), length_(std::move(length)), angle_(std::move(angle)), rate_(angle_.size(), 0) {}

  vector<Vec3> after(double time, int steps) {
    const double h = time / steps;
    const size_t n = angle_.size();
    for (int k = 0; k < steps; ++k) {
      vector<double> a[4], r[4];
      const double at[] = {0, 0.5, 0.5, 1};
      for (int s = 0; s < 4; ++s) {
        vector<double> angle = angle_, rate = rate_;
        for (size_t i = 0; s > 0 && i < n; ++i) {
          angle[i] += h * at[s] * r[s - 1][i];
          rate[i] += h * at[s] * a[s - 1][i];
        }
        a[s] = accelerations(angle, rate);
        r[s] = rate;
      }
      for (size_t i = 0; i < n; ++i) {
        angle_[i] += h / 6 * (r[0][i] + 2 * r[1][i] + 2 * r[2][i] + r[3][i]);
        rate_[i] += h / 6 * (a[0][i] + 2 * a[1][i] + 2 * a[2][i] + a[3][i]);
      }
    }
    vector<Vec3> x;
    Vec3 end = Vec3::Zero();
    for (size_t i = 0; i < n; ++i) x.push_back(end += length_[i] * Vec3(std::sin(angle_[i]), -std::cos(angle_[i]), 0));
    return x;
  }

 private:
  vector<double> accelerations(const vector<double>& angle, const vector<double>& rate) const {
    const auto n = static_cast<Eigen::Index>(angle.size());
    Eigen::MatrixXd inertia(n, n);
    Eigen::VectorXd torque(n);
    const auto below = [&](Eigen::Index i) {
      double sum = 0;
      for (auto k = static_cast<size_t>(i); k < mass_.size(); ++k) sum += mass_[k];
      return sum;
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto p = static_cast<size_t>(i);
      torque[i] = -below(i) * g_n * length_[p] * std::sin(angle[p]);
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto q = static_cast<size_t>(j);
        const double both = below(std::max(i, j)) * length_[p] * length_[q];
        inertia(i, j) = both * std::cos(angle[p] - angle[q]);
        torque[i] -= both * std::sin(angle[p] - angle[q]) * rate[q] * rate[q];
      }
    }
    const Eigen::VectorXd a = inertia.ldlt().solve(torque);
    return {a.data(), a.data() + n};
  }

  vector<double> mass_, length_, angle_, rate_;  // kg, m, rad, rad/s
};

TEST(Strings, AChainMovesAsLagrangesEquationsOfItsAnglesSay) {
  for (const bool rod : {false, true})
    for (const int n : {2, 3, 5, 10}) {
      Tied problem;
      vector<double> mass, length, angle;
      Vec3 end = Vec3::Zero();
      for (int k = 0; k < n; ++k) {
        mass.push_back(1 + 0.5 * (k % 3));
        angle.push_back((rod ? 1.2 : 0.4) + 0.05 * (k % 2));
        const Vec3 next = end + (0.5 + 0.125 * (k % 2)) * Vec3(std::sin(angle.back()), -std::cos(angle.back()), 0);
        const Entity i = problem.ball(next, {0, 0, 0}, mass.back(), 0.05);
        length.push_back((next - end).norm());
        String& s = k == 0 ? problem.anchored(i, {0, 0, 0}, length.back()) : problem.between(i, i - 1, length.back());
        s.rod = rod;
        end = next;
      }
      problem.options.duration = 0.6;
      const Outcome run = run_exact(problem);
      EXPECT_TRUE(run.collisions.empty()) << n;
      const vector<Vec3> x = ChainReference(mass, length, angle).after(0.6, 12000);
      for (Entity i = 0; i < x.size(); ++i)
        EXPECT_LT((run.end.position[i] - x[i]).norm(), 1e-11) << rod << " " << n << ": " << i;
      EXPECT_NEAR(residual(problem, run), 0, 1e-9);
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
  WorldRegion region;
  region.position = Vec3(0, 0, 0.4);
  region.normal = Vec3(0, 0, 1);
  region.removes = true;
  problem.world.regions.push_back(region);
  problem.options.duration = 2;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.tally.removed.bodies, 1u);
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
  WorldRegion region;
  region.position = Vec3(0.01, 0, 0);
  region.normal = Vec3(1, 0, 0);
  region.removes = true;
  problem.world.regions.push_back(region);
  problem.options.duration = 3;
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.tally.removed.bodies, 1u);
  EXPECT_LT(run.end.position[lower].y(), -5);
}

/// Pendulums that swing among each other, with balls between them and a floor below.
Tied crowd(bool turned, bool reversed) {
  Tied problem;
  const auto seen = [&](const Vec3& x) { return turned ? Vec3(x.z(), x.y(), -x.x()) : x; };
  for (int order = 0; order < 12; ++order) {
    const int k = reversed ? 11 - order : order;
    const double x = 0.3 * (k % 4), z = 0.35 * (k / 4);
    const Entity i = problem.ball(seen({x + 0.02 * (k % 3), 0.5 + 0.03 * k, z}), seen({0.3 - 0.1 * (k % 5), 0, 0.2}),
                                  1 + 0.25 * (k % 3), 0.08, 0.75);
    problem.anchored(i, seen({x, 1.5, z}), 1.0625).restitution = k % 2 == 0 ? 0.5 : 0;
  }
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.options.duration = 1.5;
  return problem;
}

TEST(Strings, NeitherTheOrderOfPendulumsNorTheDirectionFromWhichTheyAreSeenMatters) {
  const Tied plain = crowd(false, false);
  const Outcome run = run_exact(plain);
  EXPECT_GT(run.collisions.size(), 20u);
  EXPECT_NEAR(residual(plain, run), 0, 1e-9);
  for (const bool turned : {false, true})
    for (const bool reversed : {false, true}) {
      const Outcome other = run_exact(crowd(turned, reversed));
      EXPECT_EQ(other.collisions.size(), run.collisions.size()) << turned << reversed;
      for (Entity i = 0; i < 12; ++i) {
        const Vec3& x = run.end.position[i];
        const Vec3 as_seen = turned ? Vec3(x.z(), x.y(), -x.x()) : x;
        EXPECT_LT((other.end.position[reversed ? 11 - i : i] - as_seen).norm(), 1e-7) << turned << reversed << i;
      }
    }
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

/// Balls in a plane or in space, some of them tied to each other or to anchors.
Tied random_ties(unsigned seed) {
  Random random(seed);
  const auto below = [&](int n) { return static_cast<int>(random(0, n)); };
  Tied problem;
  if (below(5) == 0) problem.world.gravity.setZero();
  if (below(2) == 0) problem.plane({0, 0, 0}, {0, 1, 0});
  const bool flat = below(3) == 0;
  const auto anywhere = [&](double low, double high) {
    return Vec3(random(-1, 1), random(low, high), flat ? 0 : random(-1, 1));
  };
  const int count = 2 + below(7);
  while (static_cast<int>(problem.world.body_count()) < count) {
    const Vec3 x = anywhere(0.2, 2.2);
    const double radius = random(0.05, 0.15);
    bool free = true;
    for (Entity i = 0; i < problem.world.body_count(); ++i)
      free = free && (problem.initial.position[i] - x).norm() > radius + problem.world.radius[i];
    if (free) problem.ball(x, 2 * anywhere(-1, 1), random(0.5, 3), radius, 0.5 * below(3));
  }
  for (int k = 0; k < count; ++k) {
    const auto body = static_cast<Entity>(below(count)), other = static_cast<Entity>(below(count));
    const bool anchored = body == other || below(2) == 0;
    const Vec3 anchor = anywhere(1, 3);
    const double apart =
        (problem.initial.position[body] - (anchored ? anchor : problem.initial.position[other])).norm();
    String& s = anchored ? problem.anchored(body, anchor, apart) : problem.between(body, other, apart);
    s.rod = below(4) == 0;
    if (s.rod) continue;
    s.length *= below(3) == 0 ? 1 : random(1, 1.5);
    s.restitution = below(3) == 0 ? random(0, 1) : 0;
  }
  problem.options.duration = 0.5;
  return problem;
}

// Measured in 700 such scenes: no string was longer by more than 1.4e-12 m.
TEST(Strings, NeitherLengthsNorEnergyDriftAmongBallsTiedAtRandom) {
  double farthest = 0, residue = 0;  // m, J
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Tied problem = random_ties(seed);
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    double fastest = 0;  // m/s
    for (int k = 1; k <= 512; ++k) {
      go_to(*simulator, k / 1024.0);
      for (const Vec3& v : simulator->state().velocity) fastest = std::max(fastest, v.norm());
      const vector<Vec3>& x = simulator->state().position;
      for (const String& s : problem.world.strings) {
        const double over = (x[s.body] - (s.other == no_entity ? s.anchor : x[s.other])).norm() - s.length;
        farthest = std::max(farthest, s.rod ? std::abs(over) : over);
      }
    }
    const Tally& tally = simulator->tally();
    // Also of a body that a jerk reaches through others.
    EXPECT_LE(fastest, tally.fastest.speed * (1 + 1e-12)) << seed;
    residue = std::max(
        residue, std::abs(energy(problem, simulator->state()) - energy(problem, problem.initial) + tally.energy_lost));
    EXPECT_EQ(tally.doubts.contacts, 0u) << seed;
    EXPECT_EQ(tally.stepped_contact, 0) << seed;
  }
  EXPECT_LT(farthest, 2e-12);
  EXPECT_LT(residue, 1e-9);
}

TEST(Strings, AFrameWithMoreRodsThanItNeedsMovesAsARigidBody) {
  // A square with both diagonals, in a plane; a tetrahedron with a fifth point.
  for (const bool flat : {true, false}) {
    Tied problem;
    const vector<Vec3> at = flat ? vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}
                                 : vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const Vec3 turn(0, 0, 2);
    Vec3 center = Vec3::Zero(), drift = Vec3::Zero();
    for (const Vec3& x : at) {
      problem.ball(x, turn.cross(x), 1, 0.05);
      center += x / static_cast<double>(at.size());
      drift += turn.cross(x) / static_cast<double>(at.size());
    }
    for (Entity i = 0; i < at.size(); ++i)
      for (Entity j = 0; j < i; ++j) problem.between(i, j, (at[i] - at[j]).norm()).rod = true;
    problem.options.duration = 2;
    const Outcome run = run_exact(problem);
    EXPECT_EQ(run.tally.doubts.contacts, 0u) << flat;
    for (Entity i = 0; i < at.size(); ++i)
      for (Entity j = 0; j < i; ++j)
        EXPECT_NEAR((run.end.position[i] - run.end.position[j]).norm(), (at[i] - at[j]).norm(), 1e-12) << flat;
    if (!flat) continue;
    const auto seen = [&](const Vec3& d) {
      const double c = std::cos(4.0), s = std::sin(4.0);
      return Vec3(c * d.x() - s * d.y(), s * d.x() + c * d.y(), 0);
    };
    const Vec3 now = center + 2 * drift - Vec3(0, 2 * g_n, 0);
    for (Entity i = 0; i < 4; ++i) EXPECT_LT((run.end.position[i] - now - seen(at[i] - center)).norm(), 1e-11) << i;
  }
}

TEST(Strings, RecordedPiecesOfPathsGiveTheStateOfASwing) {
  Tied problem = pendulum(1.2, 1);
  const Entity free = problem.ball({2, 0, 0}, {0, 0, 0}, 1, 0.1);
  problem.anchored(free, {2, 1, 0}, 1.5);
  problem.options.duration = 1;
  problem.options.record_paths = true;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  vector<PathPiece> last(2);
  for (const PathPiece& piece : simulator->paths()) last[piece.body] = piece;
  for (int k = 1; k <= 50; ++k) {
    const double time = 0.02 * k;
    do {
      simulator->advance_to(time);
      for (const PathPiece& piece : simulator->paths()) last[piece.body] = piece;
    } while (simulator->time() < time);
    for (const PathPiece& piece : last) {
      const double t = (time - piece.start.hi) - piece.start.lo;
      const Vec3 moved = piece.curve ? piece.curve->displacement_at(t) : Vec3(t * (piece.v + (0.5 * t) * piece.a));
      EXPECT_EQ(simulator->state().position[piece.body], Vec3(piece.x + moved)) << time;
    }
  }
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
  EXPECT_NEAR(run.tally.end->time, 3 * std::sqrt(2 / g_n), 0.05);
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
      problem.world.forces.push_back({spring, 0, std::numeric_limits<double>::infinity(), {0}});
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

// Frames of touching balls and rods bear more than they need, but nothing jams: thrown, they turn and lose nothing.
TEST(Rods, BetweenTouchingBallsAreNotJammed) {
  for (const double far : {0.0, 700.0}) {
    Tied problem;
    problem.world.gravity = Vec3(0, -9.81, 0);
    problem.ball({far, 0, 0}, {0, 0, 0}, 1, 0.5);
    problem.ball({far + 1, 0, 0}, {0, 0, 0}, 2, 0.5);
    problem.ball({far + 0.5, std::sqrt(0.75), 0}, {0, 0, 1}, 3, 0.5);
    for (const auto& [a, b] : {std::pair<Entity, Entity>{0, 1}, {1, 2}, {0, 2}}) problem.between(a, b, 1).rod = true;
    problem.options.duration = 4;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    const Outcome run = run_to_end(*simulator, 4);
    const State& end = run.end;
    for (const auto& [a, b] : {std::pair<int, int>{0, 1}, {1, 2}, {0, 2}})
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

// The state of a run half-way has the errors of its path. A run from there holds what was held, with any restitution.
TEST(Strings, HoldFromAStateOfAnotherRun) {
  for (const double at : {0.25, 0.5, 0.75, 1.25}) {
    Tied problem = pendulum(1.2, 1.25);
    problem.options.duration = 3;
    const auto first = make_exact_simulator(problem.world, problem.initial, problem.options);
    go_to(*first, at);
    Tied second = pendulum(1.2, 1.25);
    second.initial = first->state();
    second.initial.time = 0;
    second.world.strings[0].length = std::max(second.world.strings[0].length, second.initial.position[0].norm());
    second.world.strings[0].restitution = 1;
    second.options.duration = 3 - at;
    const Outcome run = run_exact(second);
    EXPECT_TRUE(run.collisions.empty()) << at << ' ' << run.collisions.size();
    go_to(*first, 3);
    EXPECT_LT((run.end.position[0] - first->state().position[0]).norm(), 1e-11);
  }
}

// The same for an elastic ball that slides down a globe.
TEST(Start, OfASlideOverAGlobeHolds) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.ball({0.01, std::sqrt(1.1 * 1.1 - 1e-4), 0}, {0, 0, 0}, 1, 0.1, 1);
  problem.obstacle({0, 0, 0}, Volume::sphere(1));
  problem.options.duration = 1;
  for (const double at : {0.25, 0.5, 0.75}) {
    const auto first = make_exact_simulator(problem.world, problem.initial, problem.options);
    go_to(*first, at);
    Problem second = problem;
    second.initial = first->state();
    second.initial.time = 0;
    second.options.duration = 1 - at;
    const Outcome run = run_exact(second);
    EXPECT_TRUE(run.collisions.empty()) << at << ' ' << run.collisions.size();
    go_to(*first, 1);
    EXPECT_LT((run.end.position[0] - first->state().position[0]).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace carom
