// Slow motion near equilibria on curved contacts and strings, and islands that move fast as a whole, against closed
// forms. A body that starts d from an equilibrium moves by multiples of d: an error that does not depend on d is one of
// the whole motion.
#include <gtest/gtest.h>

#include "geometry/contact_time.h"
#include "physics/force_law.h"
#include "simulate/ties.h"
#include "std.h"

namespace carom {
namespace {

constexpr double pull = 9.75;  // m/s^2

/// Integral of f from 0 to `end` by Simpson's rule. For smooth f, right to rounding.
template <typename F>
double simpson(const F& f, double end) {
  const int parts = 20000;
  const double h = end / parts;
  double sum = f(0.0) + f(end);
  for (int k = 1; k < parts; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(k * h);
  return sum * h / 3;
}

/// The time (s) in which a point at the angle q0 from the top, at rest, comes to q: th'^2 = 2 rate^2 (cos q0 - cos q) /
/// inertia(th). By sin(th/2) = sin(q0/2) cosh u, it is the integral of sqrt(inertia) du / (rate sqrt(1 - sin^2(th/2))).
template <typename Inertia>
double time_from_the_top(double q0, double q, double rate, const Inertia& inertia) {
  const double s0 = std::sin(q0 / 2);
  const auto integrand = [&](double u) {
    const double s = s0 * std::cosh(u);
    return sqrt(inertia(2 * std::asin(s))) / (rate * sqrt(1 - s * s));
  };
  return simpson(integrand, std::acosh(std::sin(q / 2) / s0));
}

double as_one(double) {
  return 1;
}

/// A ball of radius r, d beside the top of a fixed thing round the origin, which it touches at `distance` (m).
Problem beside_the_top(double d, double r, double distance) {
  Problem problem;
  problem.world.gravity = Vec3(0, -pull, 0);
  problem.ball({d, sqrt(distance * distance - d * d), 0}, {0, 0, 0}, 1, r, 0);
  return problem;
}

/// By how much a ball that slides down from the top is early, as a share of the time.
double early(const Problem& problem, double distance, double share_of_time) {
  const Vec3 first = problem.initial.position[0];
  const double q0 = std::atan2(first.x(), first.y()), rate = sqrt(pull / distance);
  // It leaves at cos q = 2/3 cos q0, later than this.
  const double there = share_of_time * time_from_the_top(q0, 0.8, rate, as_one);
  Problem shorter = problem;
  shorter.options.duration = there;
  const Vec3 x = run_exact(shorter).end.position[0];
  EXPECT_NEAR(x.norm(), distance, 1e-9 * distance);
  return time_from_the_top(q0, std::atan2(x.x(), x.y()), rate, as_one) / there - 1;
}

TEST(NearEquilibria, ABallBesideTheTopOfAGlobeLeavesItInTime) {
  // The rounding of the place, 1e-16 m, is a share of 1e-16 / d of the way, and changes the logarithm of the time.
  for (const double scale : {1.0, 10.0, 0.01})
    for (const double d : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      Problem problem = beside_the_top(d * scale, 0.25 * scale, scale);
      problem.obstacle({0, 0, 0}, Volume::sphere(0.75 * scale));
      for (const double share : {0.3, 0.7, 1.0})
        EXPECT_LT(std::abs(early(problem, scale, share)), 1e-11 + 5e-17 / d) << scale << " " << d << " " << share;
    }
}

TEST(NearEquilibria, SoDoesABallBesideAnEdge) {
  for (const double d : {1e-5, 1e-6, 1e-8}) {
    Problem problem = beside_the_top(d, 0.25, 0.25);
    problem.obstacle({-1, -1, 0}, Volume::box({2, 2, 2}));
    EXPECT_LT(std::abs(early(problem, 0.25, 1)), 1e-11 + 5e-17 / d) << d;
  }
}

TEST(NearEquilibria, SoDoesItInStepsOfAMethod) {
  for (const Integrator method : {Integrator::dop853, Integrator::rk4}) {
    Problem problem = beside_the_top(1e-6, 0.25, 1);
    problem.obstacle({0, 0, 0}, Volume::sphere(0.75));
    problem.options.integrator = method;
    problem.options.step = method == Integrator::rk4 ? 0.01 : never;
    problem.options.closed_forms = false;
    EXPECT_LT(std::abs(early(problem, 1, 1)), 2e-11) << static_cast<int>(method);
  }
}

TEST(NearEquilibria, AScenesFiguresOfTheBallOnAGlobe) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.75, 0);
  problem.ball({1e-6, 1, 0}, {0, 0, 0}, 1, 0.25, 0);
  problem.obstacle({0, 0, 0}, Volume::sphere(0.75));
  problem.options.duration = 4.7;
  const Vec3 x = run_exact(problem).end.position[0];
  // It leaves at 4.595827621 s and then falls: by quadrature in 40 digits.
  EXPECT_LT((x - Vec3(0.922414990, 0.415805752, 0)).norm(), 1e-9);
}

TEST(NearEquilibria, AHeavyBallCreepsFromTheTopThroughATreacle) {
  // th'' + k th' = (g / R) th near the top.
  const double k = 1e6, d = 3.5e-7, time = 2e5;
  Problem problem = beside_the_top(d, 0.25, 1);
  problem.obstacle({0, 0, 0}, Volume::sphere(0.75));
  problem.world.forces.push_back({Drag{k, 0, Vec3::Zero()}});
  problem.options.duration = time;
  const double fast = -0.5 * (k + sqrt(k * k + 4 * pull)), slow = -pull / fast;
  const double expected = d * (fast * std::exp(slow * time) - slow * std::exp(fast * time)) / (fast - slow);
  EXPECT_NEAR(run_exact(problem).end.position[0].x() / expected, 1, 3e-9);  // measured: 1.2e-9
}

/// A rod of 1 m from a wall at x = 0 to a floor, at the angle q0 to the vertical, with these masses at its ends (kg).
Problem ladder(double q0, double upper, double lower) {
  const double r = 0.1;
  Problem problem;
  problem.world.gravity = Vec3(0, -pull, 0);
  problem.ball({r, r + std::cos(q0), 0}, {0, 0, 0}, upper, r, 0);
  problem.ball({r + std::sin(q0), r, 0}, {0, 0, 0}, lower, r, 0);
  problem.plane({0, 0, 0}, {1, 0, 0});
  problem.plane({0, 0, 0}, {0, 1, 0});
  const double length = (problem.initial.position[1] - problem.initial.position[0]).norm();
  problem.world.strings.push_back({0, 1, Vec3::Zero(), length});
  problem.world.strings.back().rod = true;
  return problem;
}

TEST(NearEquilibria, ALadderSlidesDownInTime) {
  // th'^2 (m1 sin^2 + m2 cos^2) = 2 m1 (g / L) (cos q0 - cos th).
  for (const auto& [upper, lower] : {pair(1.0, 1.0), pair(1e6, 1.0), pair(1e8, 1.0), pair(1.0, 1e3)})
    for (const double q0 : {1e-5, 1e-6, 1e-7}) {
      Problem problem = ladder(q0, upper, lower);
      const auto inertia = [m1 = upper, m2 = lower](double q) {
        return (m1 * std::sin(q) * std::sin(q) + m2 * std::cos(q) * std::cos(q)) / m1;
      };
      const double first = problem.initial.position[1].x() - 0.1;
      // Later a light end is pulled along, and the heavy one off the wall.
      const double last = 0.3 * sqrt(sqrt(std::min(lower / upper, 1.0)));
      const double whole = time_from_the_top(std::asin(first), last, sqrt(pull), inertia);
      problem.options.duration = whole;
      const State end = run_exact(problem).end;
      const double q = std::atan2(end.position[1].x() - 0.1, end.position[0].y() - 0.1);
      const double there = time_from_the_top(std::asin(first), q, sqrt(pull), inertia);
      EXPECT_LT(std::abs(there / whole - 1), 1e-10 + 2e-16 / q0) << upper << " " << lower << " " << q0;
    }
}

TEST(NearEquilibria, SmallSwingsKeepTheirAmplitudeAndPeriod) {
  struct Swing {
    double length, radius, amplitude;  // m
  };
  // The rounding of 1 m or 67 m is a share of 1e-10, 1e-9 and 2e-12 of these amplitudes.
  for (const Swing& swing : {Swing{1, 0.05, 1.7e-5}, Swing{1, 0.05, 1.7e-6}, Swing{67, 0.1, 4e-3}})
    for (const bool rod : {false, true}) {
      Problem problem;
      problem.world.gravity = Vec3(0, -pull, 0);
      const double angle = swing.amplitude / swing.length;
      problem.ball({swing.amplitude, -swing.length * std::cos(angle), 0}, {0, 0, 0}, 1, swing.radius);
      problem.world.strings.push_back({0, no_entity, Vec3::Zero(), problem.initial.position[0].norm()});
      problem.world.strings.back().rod = rod;

      const double whole = period(swing.length, angle, pull), bound = 1e-16 * swing.length / swing.amplitude + 1e-11;
      problem.options.duration = 10.25 * whole;

      const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
      go_to(*simulator, 10 * whole);
      EXPECT_LT(std::abs(simulator->state().position[0].x() / swing.amplitude - 1), 20 * bound) << swing.amplitude;
      go_to(*simulator, 10.25 * whole);
      EXPECT_LT(std::abs(simulator->state().position[0].x() / swing.amplitude), 50 * bound) << swing.amplitude;
    }
}

TEST(FastFrames, ADumbbellTurnsAsAtRest) {
  // 1.5 rad/s about a centre that moves: rounding of 5e6 m in 5 s is 1e-9 m.
  for (const double speed : {0.0, 1e3, 1e6}) {
    Problem problem;
    problem.ball({0, 0.5, 0}, {speed, 0, 1}, 1, 0.1);
    problem.ball({0, -0.5, 0}, {speed, 0, -0.5}, 2, 0.1);
    problem.world.strings.push_back({0, 1, Vec3::Zero(), 1});
    problem.world.strings.back().rod = true;
    problem.options.duration = 5;

    const State end = run_exact(problem).end;
    const double c = std::cos(7.5), s = std::sin(7.5);
    const double bound = speed == 0 ? 1e-12 : 4e-15 * speed;  // measured: 1e-13, 5e-13, 1.5e-10
    EXPECT_LT((end.position[0] - Vec3(5 * speed, (4 * c - 1) / 6, 2 * s / 3)).norm(), bound) << speed;
    EXPECT_LT((end.position[1] - Vec3(5 * speed, -(2 * c + 1) / 6, -s / 3)).norm(), bound) << speed;
  }
}

TEST(PastAnAttractor, ABallSlidesOnAFloorAsByItsEnergy) {
  // x'^2 / 2 - 1 / sqrt(x^2 + h^2) = E. From x = -1 at 1 m/s: where it is after 2 s, by quadrature in 40 digits.
  struct Passage {
    double depth, place, speed;  // m, m, m/s
  };
  for (const Passage& passage : {Passage{1e-6, 1.60740985446985917, 0.4942041452192467},
                                 Passage{1e-8, 1.60740985507967909, 0.4942041447409032}}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -pull, 0);
    problem.ball({-1, 0, 0}, {1, 0, 0}, 1, 0.1, 0);
    problem.plane({0, -0.1, 0}, {0, 1, 0});
    problem.world.forces.push_back({Attractor{Vec3(0, -passage.depth, 0), 1, 0}});
    problem.options.duration = 2;
    const State end = run_exact(problem).end;
    // Rounding of 1e-16 in the speed at the centre is that of 1e-16 / depth in the energy.
    const double bound = 1e-15 / passage.depth;
    EXPECT_NEAR(end.position[0].x(), passage.place, bound) << passage.depth;
    EXPECT_NEAR(end.velocity[0].x(), passage.speed, bound) << passage.depth;
  }
}

}  // namespace
}  // namespace carom
