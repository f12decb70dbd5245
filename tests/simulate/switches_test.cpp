// Forces that start and end, and things that start to move, at the very instant of another event. The clock has two
// doubles, and the edge of a window has one: events come before it, at it and after it, all at the same double.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

constexpr double forever = infinity;

/// A ball that bounces until it rests.
Problem bouncing() {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.55, 0}, Vec3::Zero(), 1, 0.1, 0.5);
  problem.options.duration = 1.3;
  return problem;
}

/// Two balls between planes.
Problem shuttling() {
  Problem problem;
  problem.plane({-2, 0, 0}, {1, 0, 0});
  problem.plane({2, 0, 0}, {-1, 0, 0});
  problem.ball({-1, 0, 0}, {2, 0, 0}, 1, 0.1);
  problem.ball({0.5, 0, 0}, Vec3::Zero(), 3, 0.1);
  problem.options.duration = 12;
  return problem;
}

/// A ball that falls into strings, over and over.
Problem on_strings() {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0.1, 0.3, 0}, Vec3::Zero(), 1, 0.1, 0.9);
  problem.world.strings.push_back({0, no_entity, {0, 0, 0}, 0.7});
  problem.world.strings.back().restitution = 0.9;
  problem.options.duration = 3;
  return problem;
}

/// The same ball as first, under a drag that fades its flights.
Problem dragged() {
  Problem problem = bouncing();
  problem.world.forces.push_back({Drag{0.3, 0, Vec3::Zero()}});
  return problem;
}

set<double> instants_of(const Problem& problem) {
  set<double> instants;
  for (const Collision& c : run_exact(problem).all)
    if (c.time > 0) instants.insert(c.time);
  return instants;
}

/// How far from one another bodies are at the end of two runs (m).
double apart(const State& a, const State& b) {
  double most = 0;
  for (size_t i = 0; i < a.position.size(); ++i) most = std::max(most, (a.position[i] - b.position[i]).norm());
  return most;
}

/// Runs to shortly after `time` (s), where a window has its edge, and where it has it just before or after. An impact
/// at the edge belongs to one side of it.
template <typename Edge>
double nearest(Problem problem, double time, const Edge& set_edge) {
  const Problem plain = problem;
  problem.options.duration = time + 0.03;
  const auto end = [&](double at) {
    Problem edged = plain;
    edged.options.duration = problem.options.duration;
    set_edge(edged, at);
    return run_exact(edged).end;
  };
  const State there = end(time);
  return std::min(apart(there, end(time + 1e-10)), apart(there, end(time - 1e-10)));
}

TEST(Switches, OfForcesAtTheInstantOfAnyOtherEventAreTaken) {
  size_t tried = 0;
  for (const Problem& problem : {bouncing(), shuttling(), on_strings(), dragged()})
    for (const double time : instants_of(problem)) {
      const UniformForce across{Vec3(0, 0, 1)};
      EXPECT_LT(nearest(problem, time,
                        [&](Problem& p, double at) {
                          p.world.forces.push_back({across, at, 99});
                        }),
                1e-9)
          << time;

      EXPECT_LT(nearest(problem, time,
                        [&](Problem& p, double at) {
                          p.world.forces.push_back({across, at / 2, at});
                        }),
                1e-8)
          << time;

      tried += 2;
    }

  EXPECT_GT(tried, 80u);
}

TEST(Switches, OfThingsThatMoveAtTheInstantOfAnyOtherEventAreTaken) {
  size_t tried = 0;
  for (const Problem& problem : {bouncing(), shuttling(), dragged()})
    for (const double time : instants_of(problem)) {
      const auto move = [&](Problem& p, double at) {
        p.move(p.world.body_count(), {{at, forever, p.world.planes[0].normal}});
      };
      EXPECT_LT(nearest(problem, time, move), 1e-8) << time;
      ++tried;
    }
  EXPECT_GT(tried, 30u);
}

// Bounces at 0.3, 0.6 and 0.75 s. A force across acts from 0.75 to 1 s: x = a t^2 / 2 at its end, then a straight line.
TEST(Switches, AtAnImpactPushABallByTheClosedForm) {
  Problem problem = bouncing();
  problem.world.forces.push_back({UniformForce{Vec3(1, 0, 0)}, 0.75, 1});
  EXPECT_NEAR(run_exact(problem).end.position[0].x(), 0.5 * 0.0625 + 0.25 * 0.3, 1e-15);
}

// The floor rises at 1 m/s when the bounces end, and strikes the ball, e = 1/2. Relative to it the ball bounces for
// 0.1, 0.05, 0.025 and 0.0125 s, and then leaves it at 1/32 m/s.
TEST(Switches, AtTheEndOfBouncesStrikeTheBall) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.3, 0}, Vec3::Zero(), 1, 0.1, 0.5);
  problem.options.duration = 0.79;
  const double rest = 0.6000000000000001, since = 0.0025;
  for (const double from : {rest, std::nextafter(rest, 0), std::nextafter(rest, 1)}) {
    Problem moved = problem;
    moved.move(1, {{from, 0.8, {0, 1, 0}}});
    EXPECT_NEAR(run_exact(moved).end.position[0].y(), 0.29 + since / 32 - 5 * since * since, 1e-15) << from;
  }
}

// A ball on a floor, one on a globe below a heavier one, a bob on a string: contacts of closed forms and of constrained
// motion. A force that starts counts at its instant, and one that ends does not, also at the run's end.
TEST(Switches, OnBodiesInContactShowTheForcesFromThatInstantOn) {
  for (const double duration : {1.0, 2.0})
    for (const bool starts : {true, false}) {
      Problem problem;
      problem.world.gravity = Vec3(0, -10, 0);
      problem.plane({0, 0, 0}, {0, 1, 0});
      problem.obstacle({4, 1, 0}, Volume::sphere(1));

      problem.ball({0, 0.5, 0}, Vec3::Zero(), 1, 0.5, 0);
      problem.ball({4, 2.5, 0}, Vec3::Zero(), 1, 0.5, 0);
      problem.ball({4, 3.5, 0}, Vec3::Zero(), 2, 0.5, 0);
      problem.ball({8, 2, 0}, Vec3::Zero(), 1, 0.5, 0);
      problem.world.strings.push_back({3, no_entity, {8, 4, 0}, 2});

      const UniformForce down{Vec3(0, -4, 0)};
      problem.world.forces.push_back({down, starts ? 1.0 : 0.0, starts ? forever : 1.0});
      problem.options.duration = duration;

      const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
      go_to(*simulator, 1);

      const double each = starts ? 4 : 0;
      EXPECT_NEAR(force_between(*simulator, 0, 4), 10 + each, 1e-13) << duration << starts;
      EXPECT_NEAR(force_between(*simulator, 1, 5), 30 + 2 * each, 1e-13) << duration << starts;
      EXPECT_NEAR(force_between(*simulator, 1, 2), 20 + each, 1e-13) << duration << starts;
      EXPECT_NEAR(force_between(*simulator, 3, 6), 10 + each, 1e-13) << duration << starts;
    }
}

}  // namespace
}  // namespace carom
