// Islands in lasting contact against closed forms and against solutions in special coordinates.
#include <gtest/gtest.h>

#include "numerics/polynomial.h"
#include "physics/force_law.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/island/constrained_motion.h"
#include "std.h"

namespace carom {
namespace {

/// n balls (1 kg, radius 0.5 m) side by side on a floor; a force (N) acts on the first. reversed: named from the end.
Problem pushed_row(int n, double force, bool reversed, double duration) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = duration;
  for (int k = 0; k < n; ++k) problem.ball({reversed ? n - 1.0 - k : k, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.world.forces.push_back(
      {UniformForce{Vec3(force, 0, 0)}, 0, never, {reversed ? static_cast<Entity>(n - 1) : Entity{0}}});
  return problem;
}

TEST(ConstrainedMotion, ARowOfAnyNumberIsPushedAsOneBody) {
  for (const int n : {2, 8, 9, 17, 60, 300, 1000})
    for (const bool reversed : {false, true}) {
      const Problem problem = pushed_row(n, 3, reversed, 1);
      const Outcome run = run_exact(problem);

      const double way = 0.5 * 3 / n;  // m
      for (Entity i = 0; i < problem.world.body_count(); ++i)
        EXPECT_LT((run.end.position[i] - problem.initial.position[i] - Vec3(way, 0, 0)).norm(), 1e-12 * n)
            << n << ": " << i;  // measured: 0

      EXPECT_TRUE(run.collisions.empty()) << n;
      EXPECT_EQ(run.tally.stepped_contact, 0) << n;
      EXPECT_EQ(run.tally.doubts.contacts, 0u) << n;
    }
}

TEST(ConstrainedMotion, AStackOfAnyNumberStandsAndEachBallCarriesThoseAboveIt) {
  for (const int n : {2, 8, 9, 40, 200}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    problem.options.duration = 10;
    for (int k = 0; k < n; ++k) problem.ball({0, 0.5 + k, 0}, {0, 0, 0}, 1, 0.5, 0.5);
    problem.plane({0, 0, 0}, {0, 1, 0});

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (const double t : {0.0, 10.0}) {
      go_to(*simulator, t);
      EXPECT_EQ(simulator->state().position, problem.initial.position) << n;
      const auto contacts = simulator->contacts();
      ASSERT_EQ(contacts.size(), static_cast<size_t>(n));
      for (const ContactForce& c : contacts) {
        const int above = c.b == static_cast<Entity>(n) ? n : n - 1 - static_cast<int>(c.a);
        EXPECT_NEAR(c.force, above * g_n, 1e-13 * n * g_n) << n << ": " << c.a << " on " << c.b;
      }
    }
  }
}

/// A ball of M kg falls between n balls of m kg that it pushes apart over a floor; all of radius r, from rest. The line
/// of centres makes the angle q with the vertical: I(q) q'' + I'(q)/2 q'^2 = 2 M g_n r sin q. The angle at `time`.
double angle_of_roof(double q, double top, double base, int n, double r, double time) {
  const auto curve = [&](double at, double rate) {
    const double s = std::sin(at), c = std::cos(at), length = 2 * r;
    const double inertia = length * length * (top * s * s + n * base * c * c);
    const double slope = 2 * length * length * s * c * (top - n * base);
    return (top * g_n * length * s - 0.5 * slope * rate * rate) / inertia;
  };

  // The method of Runge and Kutta of order 4.
  const int steps = 20000;
  const double h = time / steps;
  double rate = 0;
  for (int k = 0; k < steps; ++k) {
    const double a1 = curve(q, rate), a2 = curve(q + h / 2 * rate, rate + h / 2 * a1);
    const double a3 = curve(q + h / 2 * (rate + h / 2 * a1), rate + h / 2 * a2);
    const double a4 = curve(q + h * (rate + h / 2 * a2), rate + h * a3);
    q += h * rate + h * h / 6 * (a1 + a2 + a3);
    rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return q;
}

/// `copies` of them, 5 m apart.
Problem roofs(int bases, int copies, double angle, double top, double r) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 0.2;

  for (int c = 0; c < copies; ++c) {
    const double z = 5.0 * c;
    for (int b = 0; b < bases; ++b) {
      const double turn = 2 * M_PI * b / bases, out = 2 * r * std::sin(angle);
      problem.ball({out * std::cos(turn), r, z + out * std::sin(turn)}, {0, 0, 0}, 1, r, 0);
    }
    problem.ball({0, r + 2 * r * std::cos(angle), z}, {0, 0, 0}, top, r, 0);
  }

  problem.plane({0, 0, 0}, {0, 1, 0});
  return problem;
}

TEST(ConstrainedMotion, RoofsAndPyramidsComeDownByTheEquationOfTheirOneCoordinate) {
  for (const int bases : {2, 3, 4})
    for (const int copies : {1, 5})
      for (const double top : {0.5, 2.0}) {
        const double r = 0.5, angle = 0.8;
        const Problem problem = roofs(bases, copies, angle, top, r);

        const Outcome run = run_exact(problem);
        const double q = angle_of_roof(angle, top, 1, bases, r, problem.options.duration);
        ASSERT_GT(q, angle + 0.03);

        for (int c = 0; c < copies; ++c) {
          const size_t first = static_cast<size_t>(c * (bases + 1)), last = first + static_cast<size_t>(bases);
          EXPECT_NEAR(run.end.position[last].y(), r + 2 * r * std::cos(q), 5e-12);  // measured: 2e-12
          for (size_t b = first; b < last; ++b) {
            const Vec3 out = run.end.position[b] - Vec3(0, 0, 5.0 * c);
            EXPECT_NEAR(hypot(out.x(), out.z()), 2 * r * std::sin(q), 5e-12);
            EXPECT_NEAR(out.y(), r, 1e-15);
          }
        }

        EXPECT_TRUE(run.collisions.empty());
        EXPECT_EQ(run.tally.stepped_contact, 0);
        EXPECT_LT(run.tally.max_overlap, 1e-11);
        EXPECT_LT(std::abs(residual(problem, run)), 1e-8);  // measured: 2.4e-9
        EXPECT_LT(std::abs(unbooked(problem, run)), 1e-10);
      }
}

TEST(ConstrainedMotion, InOtherUnitsAPyramidHasTheSameBits) {
  const Problem one = roofs(4, 1, 0.8, 2, 0.5);
  const double length = 0x1p10, time = 0x1p-4, mass = 0x1p6;

  Problem other = one;
  other.world.gravity *= length / (time * time);
  other.options.duration *= time;
  for (double& m : other.world.mass) m *= mass;
  for (double& r : other.world.radius) r *= length;
  for (Vec3& x : other.initial.position) x *= length;
  for (Plane& plane : other.world.planes) plane.point *= length;

  const Outcome a = run_exact(one), b = run_exact(other);
  for (size_t i = 0; i < a.end.position.size(); ++i) {
    EXPECT_EQ(length * a.end.position[i], b.end.position[i]);
    EXPECT_EQ(length / time * a.end.velocity[i], b.end.velocity[i]);
  }
}

/// n boxes of edge b (m) in a row on a slope that falls by `angle` (rad) towards x, all at rest on its plane.
Problem boxes_on_a_slope(int n, double b, double angle, double mass) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  const Vec3 down(std::cos(angle), -std::sin(angle), 0), up(std::sin(angle), std::cos(angle), 0);
  problem.plane({0, 0, 0}, up);
  const double support = 0.5 * b * (std::sin(angle) + std::cos(angle));  // m, from the plane to a box's middle
  for (int k = 0; k < n; ++k) {
    const double x = k * b;  // their faces touch: x by x
    const Vec3 at = support * up + x / std::cos(angle) * down;
    problem.body(Volume::box({b, b, b}), at, {0, 0, 0}, mass, 0.5);
  }
  return problem;
}

TEST(ConstrainedMotion, BoxesInARowSlideDownASlopeAsOneAlsoWhenTheUppermostIsPushed) {
  for (const int n : {1, 2, 5, 9, 17, 40})
    for (const double angle : {0.1, 0.3, 0.6})  // tan < 1: their faces touch
      for (const double push : {0.0, 3.0}) {    // N, down the slope, on the uppermost

        Problem problem = boxes_on_a_slope(n, 0.5, angle, 2);
        const Vec3 down(std::cos(angle), -std::sin(angle), 0);
        if (push > 0) problem.world.forces.push_back({UniformForce{push * down}, 0, never, {0}});
        problem.options.duration = 1;
        const Outcome run = run_exact(problem);

        const double way = 0.5 * (g_n * std::sin(angle) + push / (2 * n));  // m
        for (Entity i = 0; i < problem.world.body_count(); ++i)
          EXPECT_LT((run.end.position[i] - problem.initial.position[i] - way * down).norm(), 1e-12 * (1 + n))
              << n << ' ' << angle << ' ' << push << ": " << i;

        EXPECT_TRUE(run.collisions.empty()) << n << ' ' << angle << ' ' << push;
        EXPECT_EQ(run.tally.stepped_contact, 0);
      }
}

// The upper one only sinks: M and m, a = (M + m) g_n sin q / (M + m sin^2 q) along the slope.
TEST(ConstrainedMotion, ABoxOnABoxOnASlopeSinksWhileTheLowerOneSlidesAway) {
  for (const double angle : {0.1, 0.5, 1.0})
    for (const double upper : {0.01, 1.0, 100.0})
      for (const bool round : {false, true}) {
        Problem problem = boxes_on_a_slope(1, 2, angle, 3);
        const Vec3 below = problem.initial.position[0], down(std::cos(angle), -std::sin(angle), 0);
        const Vec3 start = below + Vec3(0.25, 1.25, 0);
        if (round)
          problem.body(Volume::cylinder(0.25, 0.5), start, {0, 0, 0}, upper, 0);
        else
          problem.body(Volume::box({0.5, 0.5, 0.5}), start, {0, 0, 0}, upper, 0);

        const double sine = std::sin(angle), a = (3 + upper) * g_n * sine / (3 + upper * sine * sine);
        const double time = 0.25, way = 0.5 * a * time * time;
        ASSERT_LT(way * std::cos(angle), 1.2);  // m: still under it

        problem.options.duration = time;
        const Outcome run = run_exact(problem);

        EXPECT_LT((run.end.position[0] - below - way * down).norm(), 1e-13) << angle << ' ' << upper;
        EXPECT_LT((run.end.position[1] - start - Vec3(0, -way * sine, 0)).norm(), 1e-13) << angle << ' ' << upper;
        EXPECT_TRUE(run.collisions.empty());
      }
}

}  // namespace
}  // namespace carom
