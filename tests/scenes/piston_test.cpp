// A gas that a moving plane compresses: its adiabat, with the pressure and the viscosity of hard spheres.
#include <gtest/gtest.h>

#include <numbers>

#include "paths.h"
#include "physics/energy.h"
#include "physics/world.h"
#include "scene/load.h"
#include "scenes/play.h"
#include "simulate/exact.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

const string file = "piston";
constexpr double count = 200, radius = 0.02, u = 0.05, duration = 20, length = 2;

/// E_end / E_start of the mean gas: dE = p A u dt, with p of an ideal gas, of hard spheres, and with their viscosity.
double compression(bool dense, bool viscous) {
  constexpr int steps = 20000;
  const double dt = duration / steps, area = (1 - 2 * radius) * (1 - 2 * radius), d = 2 * radius;
  const auto power = [&](double time, double energy) {
    const double whole = length - u * time, room = whole - d, kt = 2 * energy / (3 * count);
    const double eta = count * 4 / 3 * std::numbers::pi * radius * radius * radius / whole;
    const double z = dense ? (1 + eta + eta * eta - eta * eta * eta) / pow(1 - eta, 3) : 1;
    const double mu = viscous ? 1.016 * 5 / (16 * d * d) * sqrt(kt / std::numbers::pi) : 0;
    return (count * kt * z / (room * area) + 4 * mu * u / (3 * room)) * area * u;
  };

  double energy = 300;
  for (int k = 0; k < steps; ++k) energy += dt * power(dt * (k + 0.5), energy + 0.5 * dt * power(dt * k, energy));
  return energy / 300;
}

TEST(Piston, TheCommentHasTheNumbersOfTheAdiabat) {
  EXPECT_NEAR(pow(1.96 / 0.96, 2.0 / 3), stated(file, "T V^(2/3) stays constant, a factor of "), 1e-6);
  EXPECT_NEAR(compression(false, false), stated(file, "T V^(2/3) stays constant, a factor of "), 1e-6);
  EXPECT_NEAR(compression(true, false), stated(file, "(J. Chem. Phys. 51 (1969) 635) "), 1e-6);
  EXPECT_NEAR(compression(true, true), stated(file, "along its axis first: "), 1e-6);
}

TEST(Piston, ItsWorkIsTheGrowthOfTheEnergy) {
  const Played run = play(file);
  const double end = kinetic_energy(run.scene.world, run.end);
  EXPECT_NEAR(run.energy_start, stated(file, "energy: "), 1e-6);
  EXPECT_NEAR(run.tally.work, stated(file, "at the start, "), 1e-6);
  EXPECT_NEAR(end, stated(file, "J of work, "), 1e-6);
  EXPECT_NEAR(end, run.energy_start + run.tally.work, 1e-11);  // measured: 2e-13
  EXPECT_EQ(run.tally.energy_lost, 0);
  double work = 0;
  for (const Collision& c : run.of("piston")) work += 2 * run.scene.world.mass[c.a] * u * c.approach_speed;
  EXPECT_NEAR(run.tally.work, work, 1e-10) << "2 m u w at each impact of approach speed w";
}

TEST(Piston, HeatsTheGasByTheAdiabat) {
  SLOW_WITH_SANITIZERS();
  constexpr int seeds = 12;
  double sum = 0, squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    LoadOptions options;
    options.set = {"seed=" + to_string(seed)};
    const Scene scene = load_scene(SCENES_DIR "/piston.yaml", options);
    const auto simulator = make_exact_simulator(scene.world, scene.initial, {.duration = duration});

    const double start = kinetic_energy(scene.world, simulator->state());
    while (simulator->time() < duration) simulator->advance_to(duration);
    const double factor = kinetic_energy(scene.world, simulator->state()) / start;
    sum += factor, squares += factor * factor;
  }

  const double mean = sum / seeds, error = sqrt((squares / seeds - mean * mean) / (seeds - 1));
  EXPECT_NEAR(mean, stated(file, "over the seeds 1 to 12: "), 1e-6);
  EXPECT_LT(error, 0.01);
  EXPECT_NEAR(mean, compression(true, true), 3 * error);
}

}  // namespace
}  // namespace carom::testing
