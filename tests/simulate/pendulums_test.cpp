// Pendulums against closed forms: swings, impacts on bobs, many among each other.
#include <gtest/gtest.h>

#include "numerics/polynomial.h"
#include "simulate/ties.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

TEST(Strings, APendulumReturnsAfterThePeriodOfTheEllipticIntegral) {
  SLOW_WITH_SANITIZERS();
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

TEST(Strings, ALargeSwingGoesSlackAndTautAgainAtTheClosedForms) {
  // From the lowest point at speed v, with 2 g L < v^2 < 5 g L: the string goes slack at the angle a above the
  // horizontal with sin a = (v^2 - 2 g L) / (3 g L). The speed is then w with w^2 = g L sin a, and the parabola meets
  // the circle again after t = 4 w cos a / g.

  Tied problem;
  const double length = 0.8, v2 = 3.5 * g_n * length;
  const Entity bob = problem.ball({0, -length, 0}, {sqrt(v2), 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, length);
  problem.options.duration = 2;

  const double sine = (v2 - 2 * g_n * length) / (3 * g_n * length), cosine = sqrt(1 - sine * sine);
  const double w = sqrt(g_n * length * sine), flight = 4 * w * cosine / g_n;
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
    swing += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * length / sqrt(speed2);
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
  problem.ball({0.01, sqrt(1.1 * 1.1 - 1e-4), 0}, {0, 0, 0}, 1, 0.1, 1);
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
