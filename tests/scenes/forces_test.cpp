// Scenes of drag, an attractor and a spring, against their comments.
#include <gtest/gtest.h>

#include "engine/engine.h"
#include "physics/energy.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

TEST(Raindrops, StrikeAtTheClosedFormsTimes) {
  const string file = "raindrops";
  const Played run = play(file);
  EXPECT_EQ(choose_engine(run.scene).engine, Engine::exact);
  const Collision heavy = run.of("heavy").front(), light = run.of("light").front(), steady = run.of("steady").front();
  EXPECT_NEAR(heavy.time, stated(file, "heavy ball strikes at t = "), 1e-14);
  EXPECT_NEAR(heavy.approach_speed, 9.572362817880828, 1e-13);
  EXPECT_NEAR(light.time, stated(file, "light ball strikes at t = "), 1e-14);
  EXPECT_NEAR(light.approach_speed, 4.656527261031764, 1e-13);
  EXPECT_NEAR(steady.time, stated(file, "it strikes at t = "), 5e-14);
  EXPECT_NEAR(steady.approach_speed, stated(file, "of V = "), 1e-13);
}

TEST(Comet, ComesBack) {
  const string file = "comet";
  const Played run = play(file, {stated(file, "half a period, pi 2.5^(3/2) = ")});
  const State& far = run.states[0];
  EXPECT_NEAR(far.position[0].x(), stated(file, "it is at aphelion, x = "), 1e-9);
  EXPECT_NEAR(far.velocity[0].norm(), stated(file, "at a quarter of the speed: "), 1e-9);
  EXPECT_NEAR(run.scene.simulate.duration, stated(file, "at t = "), 1e-14);
  EXPECT_LT((run.position("comet") - Vec3(1, 0, 0)).norm(), stated(file, "y = 0, within "));
  EXPECT_LT((run.velocity("comet") - run.scene.initial.velocity[0]).norm(), 1e-9);
}

TEST(Bumper, BouncesOnEveryHalfSwing) {
  const string file = "bumper";
  const Played run = play(file);
  ASSERT_EQ(run.collisions.size(), 16u);
  const double first = stated(file, "t = pi/10 = "), swing = stated(file, "every pi/5 = ");
  for (size_t n = 0; n < run.collisions.size(); ++n) {
    const double k = static_cast<double>(n);
    EXPECT_NEAR(run.collisions[n].time, first + k * swing, 1e-10);  // measured: 4e-11
    EXPECT_NEAR(run.collisions[n].approach_speed, 5 * pow(0.8, k), 1e-10);
  }
}

TEST(Lattice, FallsOnTheFloorAndLosesNothing) {
  SLOW_WITH_SANITIZERS();
  const string file = "lattice";
  const Played run = play(file);
  EXPECT_EQ(choose_engine(run.scene).engine, Engine::exact);
  EXPECT_EQ(run.scene.world.springs.size(), 252u);
  ASSERT_FALSE(run.collisions.empty());
  EXPECT_NEAR(run.collisions.front().time, stated(file, "at t = sqrt(1.16 / 9.80665) = "), 1e-9);
  EXPECT_NEAR(kinetic_energy(run.scene.world, run.end) + potential_energy(run.scene.world, run.end), run.energy_start,
              1e-9);
}

TEST(BinaryStars, KeepMomentumWhileTheyMerge) {
  SLOW_WITH_SANITIZERS();
  const Played run = play("binary_stars");
  const World& world = run.scene.world;
  EXPECT_GT(run.tally.merges, 50u);
  EXPECT_LT((momentum(world, run.end) - momentum(world, run.scene.initial)).norm(), 1e-13);
  const double energy = kinetic_energy(world, run.end) + potential_energy(world, run.end);
  EXPECT_NEAR(energy + run.tally.energy_lost, run.energy_start, 1e-12);
}

}  // namespace
}  // namespace carom::testing
