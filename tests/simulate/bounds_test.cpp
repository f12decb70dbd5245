// A run ends where doubles no longer resolve its bodies.
#include "physics/bounds.h"

#include <gtest/gtest.h>

#include "numerics/whole.h"
#include "physics/force.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/exact.h"
#include "std.h"

namespace carom {
namespace {

/// The error that a simulator's run ends with; empty: none.
template <typename Make>
string error_of(const Make& make, double duration) {
  try {
    const auto simulator = make();
    run_to_end(*simulator, duration);
    return "";
  } catch (const SimulationError& error) {
    return error.named([](Entity body) { return "`ball." + to_string(body) + "`"; }).what();
  }
}

ExactOptions steps_of(double duration, double step) {
  ExactOptions options;
  options.duration = duration;
  options.step = step;
  options.integrator = Integrator::rk4;
  return options;
}

TEST(Bounds, AreTenToTheTwelfthOfTheSmallestSizeOfAnything) {
  Problem problem;
  EXPECT_EQ(bounds_of(problem.world).place, infinity);
  problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.5);
  EXPECT_EQ(bounds_of(problem.world).place, 0.5e12);
  problem.wall({9, 0, 0}, {1, 0, 0}, 0.25, 3);
  EXPECT_EQ(bounds_of(problem.world).place, 0.25e12);
  problem.body(Volume::cylinder(1, 0.125), {0, 9, 0}, {0, 0, 0});
  EXPECT_EQ(bounds_of(problem.world).place, 0.125e12);
  problem.obstacle({0, 0, 9}, Volume::box({1, 0.0625, 1}));
  EXPECT_EQ(bounds_of(problem.world).place, 0.0625e12);
}

TEST(Bounds, HoldNoNumberThatIsNotFinite) {
  const Bounds bounds;
  EXPECT_TRUE(bounds.contain({1e300, 0, 0}, {0, 1e30, 0}));
  EXPECT_FALSE(bounds.contain({std::nan(""), 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(bounds.contain({0, 0, 0}, {0, 0, std::nan("")}));
  EXPECT_FALSE(bounds.contain({0, 0, 0}, {0, 1.1e30, 0}));
}

// 1 m/s^2 and a radius of 1 mm: 1e9 m are reached after sqrt(2e9) = 44721.36 s.
TEST(Bounds, ABodyThatFallsOutOfThemEndsTheRunByNameInEveryEngine) {
  Problem problem;
  problem.world.gravity = {0, -1, 0};
  problem.ball({0, 0, 0}, {0, 0, 0}, 1, 1);
  problem.ball({5, 0, 0}, {0, 0, 0}, 1, 1e-3);
  problem.options.duration = 50'000;

  const auto fails = [&](const auto& make) {
    problem.options.duration = 44'000;
    EXPECT_EQ(error_of(make, 44'000), "");

    problem.options.duration = 50'000;
    const string error = error_of(make, 50'000);
    EXPECT_NE(error.find(" s `ball."), string::npos) << error;
    EXPECT_NE(error.find("more than 1e+12 times the smallest size of the scene"), string::npos) << error;
    EXPECT_GE(std::stod(error.substr(string("at t = ").size())), 44'700) << error;
  };

  fails([&] { return make_exact_simulator(problem.world, problem.initial, problem.options); });
  fails([&] { return make_exact_simulator(problem.world, problem.initial, steps_of(problem.options.duration, 10)); });
  fails([&] { return make_book_simulator(problem.world, problem.initial, {10, false, 0, false}); });
}

TEST(Bounds, SpeedsThatGrowWithoutEndAreReported) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.5, 2);
  problem.room({-1, -1, -1}, {1, 1, 1});
  problem.options.duration = 1e9;
  const string error =
      error_of([&] { return make_exact_simulator(problem.world, problem.initial, problem.options); }, 1e9);
  EXPECT_NE(error.find("`ball.0`'s speed is 1.268e+30 m/s, more than the limit of 1e+30 m/s"), string::npos) << error;
  EXPECT_NE(error.find("restitution above 1 adds energy at every collision"), string::npos) << error;
}

// Outputs change no result: a body that goes out and comes back is treated the same with or without outputs.
TEST(Bounds, ReadingStatesChangesNoVerdict) {
  for (const double speed : {31'000.0, 33'000.0, 60'000.0}) {  // to 0.98e9, 1.04e9 and 2.3e9 m
    Problem problem;
    problem.world.gravity = {0, -1, 0};
    problem.ball({0, 0.5e9, 0}, {0, speed, 0}, 1, 1e-3);
    problem.options.duration = 2 * speed;

    const auto make = [&] { return make_exact_simulator(problem.world, problem.initial, problem.options); };

    // Looked at 600 times on the way.
    string looked;
    try {
      const auto simulator = make();
      for (int k = 1; k <= 600; ++k) {
        go_to(*simulator, problem.options.duration * k / 600);
        simulator->state();
      }
    } catch (const SimulationError& error) {
      looked = error.what();
    }

    EXPECT_EQ(looked.empty(), error_of(make, problem.options.duration).empty()) << looked;
    EXPECT_TRUE(speed > 32'000 || looked.empty()) << looked;
  }
}

// As with an attractor in whose centre a body starts: its acceleration changes infinitely fast.
TEST(Bounds, StepsThatDoNotMoveTheClockEndTheRun) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.world.forces = {{Attractor{{0, 0, 0}, 1, 0}}};
  const double step = default_step(problem.world, problem.initial);
  EXPECT_EQ(step, 0);
  EXPECT_EQ(error_of([&] { return make_exact_simulator(problem.world, problem.initial, steps_of(1, step)); }, 1),
            "at t = 0 s steps of 0 s no longer advance the clock: use a longer simulate.step");
}

TEST(Whole, NoDoubleIsBeyondTheInteger) {
  EXPECT_EQ(whole_below(2.75), 2);
  EXPECT_EQ(whole_below(-2.25), -3);
  EXPECT_EQ(whole_below(1e300), most_whole);
  EXPECT_EQ(whole_below(-infinity), -most_whole);
  EXPECT_EQ(whole_below(std::nan("")), 0);
  EXPECT_EQ(nearest_whole(2.5), 3);
  EXPECT_EQ(nearest_whole(-0.75), -1);
}

}  // namespace
}  // namespace carom
