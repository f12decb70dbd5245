// Transformed scenes: mirrored, in other units, with their bodies in another order. No reference value is needed, and a
// tolerance with a unit or a preferred direction shows at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/exact.h"
#include "simulate/random.h"
#include "std.h"
#include "stress/scene.h"
#include "stress/seen_otherwise.h"

namespace carom::stress {
namespace {

enum class Way { exact, euler, verlet, rk4 };

Motion of_seed(uint64_t seed) {
  RandomScene scene = make_scene(seed);
  return {std::move(scene.world), std::move(scene.initial), scene.options.duration, scene.options.rest_speed,
          scene.options.merge};
}

/// Bodies of every volume in a room, under the force of this number: drag, linear and quadratic, a spring with damping,
/// an attractor.
enum Drive { linear_drag, quadratic_drag, spring, attractor, drives };

Motion driven(Drive drive, uint64_t seed) {
  Random random(seed);
  Motion motion;
  World& world = motion.world;
  world.gravity = Vec3(0.25, -2, 0.5);
  for (int k = 0; k < 3; ++k) {
    world.planes.push_back({Vec3::Constant(-2), Vec3::Unit(k), 0.75});
    world.planes.push_back({Vec3::Constant(2), -Vec3::Unit(k), nullopt});
  }
  for (int i = 0; i < 8; ++i) {
    const double r = random(0.1, 0.3);
    const Volume volume = i % 3 == 0   ? Volume::sphere(r)
                          : i % 3 == 1 ? Volume::cylinder(r, 2 * r)
                                       : Volume::box(Vec3(random(0.2, 0.6), random(0.2, 0.6), random(0.2, 0.6)));
    world.volume.push_back(volume);
    world.radius.push_back(volume.reach());
    world.mass.push_back(random(0.5, 2));
    world.restitution.push_back(random(0.5, 1));
    motion.initial.position.push_back(Vec3(i % 2 ? 1 : -1, i / 2 % 2 ? 1 : -1, i / 4 ? 1 : -1));
    motion.initial.velocity.push_back(Vec3(random(-2, 2), random(-2, 2), random(-2, 2)));
  }
  const Vec3 somewhere(random(-1, 1), random(-1, 1), random(-1, 1));
  switch (drive) {
    case linear_drag:
      world.forces.push_back({Drag{0.5, 0, somewhere}});
      break;
    case quadratic_drag:
      world.forces.push_back({Drag{0, 0.25, somewhere}, 0.25, 0.75});
      break;
    case spring:
      world.forces.push_back({Spring{somewhere, 3, 0.5, 0.125}});
      break;
    case attractor:
    case drives:
      world.forces.push_back({Attractor{somewhere, 2, 0.25}});
      break;
  }
  motion.duration = 1;
  return motion;
}

Observed run(const Motion& motion, Way way) {
  Observed seen;
  try {
    unique_ptr<Simulator> simulator;
    if (way == Way::exact) {
      ExactOptions options;
      options.duration = motion.duration;
      options.rest_speed = motion.rest_speed;
      options.merge = motion.merge;
      options.max_collisions = 5000;
      simulator = make_exact_simulator(motion.world, motion.initial, options);
    } else {
      ExactOptions options;
      options.duration = motion.duration;
      options.rest_speed = motion.rest_speed;
      options.integrator = way == Way::euler    ? Integrator::euler
                           : way == Way::verlet ? Integrator::verlet
                                                : Integrator::rk4;
      options.step = motion.duration / 64;
      options.max_collisions = 5000;
      simulator = make_exact_simulator(motion.world, motion.initial, options);
    }
    do simulator->advance_to(motion.duration);
    while (simulator->time() < motion.duration);
    seen.end = simulator->state();
    seen.collisions = simulator->tally().collisions();
    seen.energy_lost = simulator->tally().energy_lost;
  } catch (const SimulationError& error) {
    seen.error = error.what();
  }
  return seen;
}

string mirror_difference(const Motion& motion, Way way, int axis) {
  const auto flip = [&](Vec3 v) {
    v[axis] = -v[axis];
    return v;
  };
  return difference(run(motion, way), run(mirrored(motion, axis), way), 1, flip, flip);
}

string unit_difference(const Motion& motion, Way way, const Units& units) {
  const double l = std::ldexp(1, -units.length), t = std::ldexp(1, -units.time), m = std::ldexp(1, -units.mass);
  return difference(
      run(motion, way), run(scaled(motion, units), way), m * l * l / (t * t),
      [&](const Vec3& x) { return Vec3(x * l); }, [&](const Vec3& v) { return Vec3(v * (l / t)); });
}

constexpr array ways{Way::exact, Way::euler, Way::verlet, Way::rk4};
constexpr array all_units{Units{20, 0, 0}, Units{0, -12, 0}, Units{0, 0, 30}, Units{-30, 7, -24}};

/// The number of seeds, evenly divided among the families.
uint64_t seeds(Way way) {
  return way == Way::exact ? 13 * 12 : 13 * 6;
}

/// Scenes that an engine supports.
bool follows(Way way, int drive) {
  return way != Way::exact || drive == linear_drag;
}

class Metamorphic : public ::testing::TestWithParam<Way> {};

TEST_P(Metamorphic, AMirroredSceneMovesMirroredToTheBit) {
  for (uint64_t seed = 0; seed < seeds(GetParam()); ++seed)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(mirror_difference(of_seed(seed), GetParam(), axis), "") << "seed " << seed << ", axis " << axis;
}

TEST_P(Metamorphic, OtherUnitsGiveTheSameBits) {
  for (uint64_t seed = 0; seed < seeds(GetParam()); ++seed)
    for (const Units& units : all_units)
      EXPECT_EQ(unit_difference(of_seed(seed), GetParam(), units), "")
          << "seed " << seed << ", units 2^" << units.length << " m, 2^" << units.time << " s, 2^" << units.mass
          << " kg";
}

TEST_P(Metamorphic, ForcesThatVaryAreMirroredToTheBit) {
  for (int drive = 0; drive < drives; ++drive)
    for (int axis = 0; axis < 3 && follows(GetParam(), drive); ++axis)
      EXPECT_EQ(mirror_difference(driven(static_cast<Drive>(drive), 1), GetParam(), axis), "")
          << "force " << drive << ", axis " << axis;
}

TEST_P(Metamorphic, ForcesThatVaryHaveTheSameBitsInOtherUnits) {
  for (int drive = 0; drive < drives; ++drive)
    for (const Units& units : all_units)
      EXPECT_EQ(
          follows(GetParam(), drive) ? unit_difference(driven(static_cast<Drive>(drive), 1), GetParam(), units) : "",
          "")
          << "force " << drive << ", units 2^" << units.length << " m, 2^" << units.time << " s, 2^" << units.mass
          << " kg";
}

string name_of(const ::testing::TestParamInfo<Way>& way) {
  constexpr array names{"exact", "euler", "verlet", "rk4"};
  return names[static_cast<size_t>(way.param)];
}
INSTANTIATE_TEST_SUITE_P(Ways, Metamorphic, ::testing::ValuesIn(ways), name_of);

// Scenes without planes, which reach everywhere, and without forces and pairs that name bodies by number.
TEST(FarAway, AnotherSceneChangesNoBit) {
  int tried = 0;
  for (uint64_t seed = 0; seed < 13 * 12; ++seed) {
    Motion motion = of_seed(seed), other = of_seed(seed + 13 * 100);
    for (Motion* m : {&motion, &other}) {
      m->world.pairs.clear();
      m->world.forces.clear();
      m->world.impulse.clear();
      m->world.planes.clear();
      m->merge = false;
    }
    other.world.gravity = motion.world.gravity;
    other.world.combine = motion.world.combine;
    const bool first = seed % 2 == 0;
    const Motion both = together(motion, other, first);
    const Observed alone = run(motion, Way::exact), seen = run(both, Way::exact);
    if (!alone.error.empty() || !seen.error.empty()) continue;
    ++tried;
    const size_t from = first ? 0 : other.initial.position.size();
    for (size_t i = 0; i < motion.initial.position.size(); ++i) {
      EXPECT_EQ(alone.end.position[i], seen.end.position[from + i]) << "seed " << seed << ", body " << i;
      EXPECT_EQ(alone.end.velocity[i], seen.end.velocity[from + i]) << "seed " << seed << ", body " << i;
    }
  }
  EXPECT_GT(tried, 100);
}

/// The bodies in another order. (`motion` has no pairs and no forces on single bodies, which go by number.)
Motion reordered(const Motion& motion, const vector<Entity>& order) {
  Motion other = motion;
  for (size_t k = 0; k < order.size(); ++k) {
    const Entity i = order[k];
    other.world.mass[k] = motion.world.mass[i];
    other.world.radius[k] = motion.world.radius[i];
    other.world.restitution[k] = motion.world.restitution[i];
    if (!motion.world.volume.empty()) other.world.volume[k] = motion.world.volume[i];
    if (!motion.world.impulse.empty()) other.world.impulse[k] = motion.world.impulse[i];
    other.initial.position[k] = motion.initial.position[i];
    other.initial.velocity[k] = motion.initial.velocity[i];
  }
  return other;
}

/// m: greatest difference of the bodies' final positions. (A graze within rounding may count once or twice.)
double order_difference(const Motion& motion, Way way) {
  vector<Entity> order(motion.world.body_count());
  std::iota(order.rbegin(), order.rend(), Entity{0});  // backwards
  const Observed a = run(motion, way), b = run(reordered(motion, order), way);
  if (a.error != b.error) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (size_t k = 0; k < order.size(); ++k)
    most = std::max(most, (a.end.position[order[k]] - b.end.position[k]).norm());
  return most;
}

// Bodies of one size in lasting contact may settle in another order; a gas and single collisions do not.
TEST_P(Metamorphic, BodiesInAnotherOrderMoveTheSame) {
  for (int drive = 0; drive < drives; ++drive) {
    if (!follows(GetParam(), drive)) continue;
    Motion motion = driven(static_cast<Drive>(drive), 2);
    motion.duration = 0.5;
    EXPECT_LT(order_difference(motion, GetParam()), 1e-12) << "force " << drive;
  }
  for (uint64_t seed = 2; seed < 13 * 20; seed += 13) {  // grazing pairs
    Motion motion = of_seed(seed);
    motion.world.pairs.clear();
    EXPECT_LT(order_difference(motion, GetParam()), 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace carom::stress
