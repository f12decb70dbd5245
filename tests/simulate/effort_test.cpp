// Unneeded work is not done: counts of pair and surface tests, events and regions.
#include <gtest/gtest.h>

#include "physics/force_law.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

class Counted {
 public:
  explicit Counted(const Problem& problem)
      : problem_(problem), simulator_(make_exact_simulator(problem_.world, problem_.initial, problem_.options)) {}
  /// Work done up to that time (s).
  Effort at(double time) {
    while (simulator_->time() < time) simulator_->advance_to(time);
    return simulator_->effort();
  }
  uint64_t collisions() const { return simulator_->tally().collisions(); }

 private:
  Problem problem_;
  unique_ptr<Simulator> simulator_;
};

const Vec3 falling(0, -10, 0);

TEST(Effort, OneBallTestsNoPair) {
  Problem p;
  p.world.gravity = falling;
  p.room(Vec3(-2, -2, -2), Vec3(2, 2, 2));
  p.ball(Vec3(0, 0, 0), Vec3(1, 2, 2.9));
  p.options.duration = 100;
  Counted counted(p);
  const Effort effort = counted.at(100);
  EXPECT_GT(counted.collisions(), 200U);
  EXPECT_EQ(effort.pair_tests, 0U);
  // Each impact is one event. The ball leaves few regions, though it moves all the time.
  EXPECT_LE(effort.regions, 10U);
  EXPECT_EQ(effort.events - effort.regions, counted.collisions());
}

TEST(Effort, AStepOfABallsOwnIsPredictedOnce) {
  Problem p;
  p.ball(Vec3(1, 0, 0), Vec3::Zero());
  p.plane(Vec3(0, -0.6, 0), Vec3(0, 1, 0));
  p.world.forces = {{Spring{Vec3::Zero(), 1, 0.5, 0}}};
  p.options.integrator = Integrator::verlet;
  p.options.step = 0.01;
  p.options.duration = 1;
  Counted counted(p);
  const Effort effort = counted.at(1);
  EXPECT_LE(effort.surface_tests, 101 + effort.regions);  // at the start, and after each of 100 steps
}

// 30 x 30 balls, `pitch` apart, dropped onto a plane from heights that differ from one to the next.
Problem columns(double pitch, double restitution) {
  Problem p;
  p.world.gravity = falling;
  p.plane(Vec3(0, 0, 0), Vec3(0, 1, 0));
  p.options.duration = 20;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j)
      p.ball(Vec3(pitch * i, 1.5 + 0.2 * ((3 * i + j) % 7), pitch * j), Vec3::Zero(), 1, 0.5, restitution);
  return p;
}

TEST(Effort, BallsThatOnlyMeetPlanesTestNoPair) {
  Counted counted(columns(8, 1));
  const Effort effort = counted.at(20);
  EXPECT_GT(counted.collisions(), 15'000U);
  EXPECT_EQ(effort.pair_tests, 0U);
  // Each ball falls and rises within one region, once that is as wide as the path.
  EXPECT_LE(effort.regions, 4U * 900);
  EXPECT_LE(effort.surface_tests, counted.collisions() + 5U * 900);
}

// 1,000 balls that diverge without end.
TEST(Effort, DivergingBallsAreTestedOnceAndThenAsTheirDistancesDouble) {
  Problem p;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x = 1.2 * Vec3(i % 10 - 4.5, i / 10 % 10 - 4.5, i / 100 - 4.5);
    p.ball(x, x);
  }
  p.options.duration = 1e6;
  Counted counted(p);
  // The 18 nearest of each, each pair once.
  EXPECT_LE(counted.at(0).pair_tests, 9U * 1000);
  EXPECT_EQ(counted.at(0).events, 0U);
  // The distances grow 20-fold, then 50,000-fold. Each doubling makes a few regions of each ball.
  const Effort sooner = counted.at(20), later = counted.at(1e6 - 1);
  EXPECT_LE(sooner.regions, 4U * 5 * 1000);
  EXPECT_LE(later.regions - sooner.regions, 4U * 16 * 1000);
  EXPECT_LE(later.pair_tests, 9U * later.regions);
  EXPECT_EQ(counted.collisions(), 0U);
}

TEST(Effort, WhatLiesBeyondTheDurationIsNotScheduled) {
  Problem p;
  p.world.gravity = falling;
  p.plane(Vec3(0, 0, 0), Vec3(0, 1, 0));
  p.ball(Vec3(0, 5.5, 0), Vec3::Zero());  // lands at 1 s
  p.ball(Vec3(3, 5.5, 0), Vec3(-1, 0, 0));

  p.options.duration = 0.999;
  Counted shorter(p);
  EXPECT_EQ(shorter.at(0.999).next, infinity);
  EXPECT_EQ(shorter.collisions(), 0U);

  p.options.duration = 1.001;
  Counted longer(p);
  EXPECT_LE(longer.at(0).next, 1.001);
  EXPECT_EQ(longer.at(1.001).next, infinity);
  EXPECT_EQ(longer.collisions(), 2U);

  // A gas always has pending events, and none at its end.
  Problem gas;

  gas.room(Vec3(0, 0, 0), Vec3(12, 12, 12));
  Random random(3);
  for (int i = 0; i < 216; ++i)
    gas.ball(Vec3(1 + 2 * (i % 6), 1 + 2 * (i / 6 % 6), 1 + 2 * (i / 36)),
             Vec3(random(-1, 1), random(-1, 1), random(-1, 1)));

  gas.options.duration = 5;
  Counted counted(gas);
  EXPECT_LE(counted.at(4).next, 5);
  EXPECT_EQ(counted.at(5).next, infinity);
}

TEST(Effort, RestingBodiesCostNothing) {
  Problem p = columns(1.5, 0.5);
  // And a stack of two, which rests as a contact group.
  p.ball(Vec3(-5, 0.5, 0), Vec3::Zero(), 1, 0.5, 0);
  p.ball(Vec3(-5, 1.5, 0), Vec3::Zero(), 1, 0.5, 0);
  p.options.duration = 1e9;
  Counted counted(p);
  const Effort rested = counted.at(100), later = counted.at(1e9);
  EXPECT_EQ(rested.next, infinity);
  EXPECT_EQ(later.events, rested.events);
  EXPECT_EQ(later.pair_tests, rested.pair_tests);
  EXPECT_EQ(later.surface_tests, rested.surface_tests);
}

TEST(Effort, IsolatedBodiesCostNothing) {
  Problem p;
  p.options.duration = 1e9;
  p.ball(Vec3(0, 0, 0), Vec3(1, 2, 3));
  p.ball(Vec3(0, 5, 0), Vec3(-1, 2, 3));
  p.ball(Vec3(0, 10, 0), Vec3::Zero());
  // A region doubles every second time that it is left: 2^30 diameters are 60 regions.
  const Effort effort = Counted(p).at(1e9);
  EXPECT_LE(effort.events, 2U * 60);
  EXPECT_EQ(effort.pair_tests, 0U);
}

// Ten balls in a box of walls, and outside of it a lattice of others that stand still.
Effort ten_among(int all) {
  Problem p;
  p.options.duration = 100;
  // The walls.
  for (int k = 0; k < 3; ++k)
    for (const int side : {-1, 1})
      p.wall(5 * side * Vec3::Unit(k), -side * Vec3::Unit(k), 10, 10, Vec3::Unit((k + 1) % 3));

  // Those within, and those without.
  Random random(1);
  for (int i = 0; i < 10; ++i)
    p.ball(Vec3(-4 + 2 * (i % 4), -3 + 3 * (i / 4), 0), Vec3(random(-2, 2), random(-2, 2), random(-2, 2)));
  for (int i = 10; i < all; ++i) p.ball(Vec3(20 + 1.5 * (i % 20), 1.5 * (i / 20 % 20), 1.5 * (i / 400)), Vec3::Zero());

  Counted counted(p);
  const Effort effort = counted.at(100);
  EXPECT_GT(counted.collisions(), 400U);
  return effort;
}

TEST(Effort, TenThousandBallsOfWhichTenMoveCostWhatTenCost) {
  const Effort ten = ten_among(10), many = ten_among(10'000);
  EXPECT_EQ(many.events, ten.events);
  EXPECT_EQ(many.pair_tests, ten.pair_tests);
  EXPECT_EQ(many.surface_tests, ten.surface_tests);
}

}  // namespace
}  // namespace carom
