// Transformed scenes: mirrored, in other units, with their bodies in another order. No reference value is needed, and a
// tolerance with a unit or a preferred direction shows at once.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/exact.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "stress/make_scene.h"
#include "stress/seen_otherwise.h"

namespace carom::stress {
namespace {

enum class Way { exact, euler, verlet, rk4 };

Motion motion_of(RandomScene scene) {
  return {std::move(scene.world), std::move(scene.initial), scene.options.duration, scene.options.rest_speed,
          scene.options.merge};
}

Motion of_seed(uint64_t seed) {
  return motion_of(make_scene(seed));
}

/// Bodies of every volume in a room, under the force of this number: drag, linear and quadratic, a spring with damping,
/// an attractor.
enum Drive { linear_drag, quadratic_drag, spring, attractor, drives };

Motion driven(Drive drive, uint64_t seed) {
  RandomScene scene;
  Maker m(seed, scene);
  World& world = scene.world;
  world.gravity = Vec3(0.25, -2, 0.5);
  m.room(2);
  for (size_t k = 0; k < world.planes.size(); k += 2) world.planes[k].restitution = 0.75;

  for (int i = 0; i < 8; ++i) {
    const double r = m.uniform(0.1, 0.3), mass = m.uniform(0.5, 2), e = m.uniform(0.5, 1);
    const Volume volume = i % 3 == 0   ? Volume::sphere(r)
                          : i % 3 == 1 ? Volume::cylinder(r, 2 * r)
                                       : Volume::box(m.within(Vec3::Constant(0.2), Vec3::Constant(0.6)));
    m.body(Vec3(i % 2 ? 1 : -1, i / 2 % 2 ? 1 : -1, i / 4 ? 1 : -1), m.somewhere(2), volume, mass, e);
  }

  const Vec3 somewhere = m.somewhere(1);
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

  scene.options.duration = 1;
  return motion_of(std::move(scene));
}

Observed run(Motion motion, Way way) {
  ExactOptions options;
  options.max_collisions = 5000;
  if (way != Way::exact) {
    options.integrator = way == Way::euler    ? Integrator::euler
                         : way == Way::verlet ? Integrator::verlet
                                              : Integrator::rk4;
    options.step = motion.duration / 64;
    motion.merge = false;
  }
  return run(motion, options);
}

string mirror_difference(const Motion& motion, Way way, int axis) {
  return mirror_difference(run(motion, way), run(mirrored(motion, axis), way), axis);
}

string unit_difference(const Motion& motion, Way way, const Units& units) {
  return unit_difference(run(motion, way), run(scaled(motion, units), way), units);
}

constexpr array ways{Way::exact, Way::euler, Way::verlet, Way::rk4};

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
  SLOW_WITH_SANITIZERS();
  for (uint64_t seed = 0; seed < seeds(GetParam()); ++seed)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(mirror_difference(of_seed(seed), GetParam(), axis), "") << "seed " << seed << ", axis " << axis;
}

TEST_P(Metamorphic, OtherUnitsGiveTheSameBits) {
  SLOW_WITH_SANITIZERS();
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
  if (a.error != b.error) return infinity;
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
