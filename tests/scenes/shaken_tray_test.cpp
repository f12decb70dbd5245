// A tray on a sine: what its comment says of its motion, and its work.
#include "physics/energy.h"
#include "physics/world.h"
#include "scenes/play.h"
#include "std.h"

namespace carom::testing {
namespace {

const string file = "shaken_tray";

TEST(ShakenTray, GivesItsBallsTheWorkThatImpactsTake) {
  const Played run = play(file);
  const World& world = run.scene.world;
  const Entity tray = run.number("tray");
  const Swing& swing = *world.swing(tray);
  EXPECT_NEAR(greatest_acceleration(swing) / g_n, stated(file, "Its greatest acceleration is "), 0.005);
  EXPECT_NEAR(greatest_speed(swing), stated(file, "a greatest speed of the tray of "), 0.0005);
  for (Entity e = world.body_count(); e < tray; ++e) EXPECT_EQ(*world.swing(e), swing) << "walls go with it";
  EXPECT_EQ(fixed_velocity(world, tray, {0, 0}).y(), 0);

  const double end = kinetic_energy(world, run.end) + potential_energy(world, run.end);
  EXPECT_NEAR(run.energy_start + run.tally.work - run.tally.energy_lost, end, 1e-11);
  EXPECT_GT(run.tally.work, 10 * run.energy_start);
  for (const Vec3& x : run.end.position) EXPECT_GT(x.y(), -0.02) << "none has fallen out";
}

}  // namespace
}  // namespace carom::testing
