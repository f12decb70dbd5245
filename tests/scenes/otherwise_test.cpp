// The scenes of scenes/ that the exact engine follows, transformed: mirrored, in other units, and with another scene
// a kilometre away. The motion is the same, to the last bit.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "stress/seen_otherwise.h"

namespace carom::testing {
namespace {

using stress::Motion;
using stress::Observed;

Motion motion_of(const string& name, bool whole = slow_too()) {
  const Scene scene = load(name);
  // For long runs of many bodies the beginning is enough, and for many springs the first impacts.
  const double enough = scene.world.body_count() > 150 ? 0.25 : scene.world.springs.size() > 150 ? 0.4 : 3;
  const double most = whole ? infinity : enough;
  return {scene.world, scene.initial, std::min(scene.simulate.duration, most), scene.simulate.rest_speed.value_or(0),
          scene.simulate.contact.merge};
}

/// Scenes of another engine, and of forces whose flights have no closed form, are skipped.
class Otherwise : public ::testing::TestWithParam<string> {
 protected:
  void SetUp() override {
    const Scene scene = load(GetParam());
    if (scene.simulate.engine == Engine::book || force_without_closed_form(scene.world) != nullptr)
      GTEST_SKIP() << "not followed by exact flights";
  }
};

TEST_P(Otherwise, MirroredItMovesMirrored) {
  SLOW_WITH_SANITIZERS();
  const Motion motion = motion_of(GetParam());
  if (!motion.world.pours.empty()) GTEST_SKIP() << "places by the seed have no mirror image";
  const Observed seen = run(motion);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(stress::mirror_difference(seen, run(stress::mirrored(motion, axis)), axis), "") << axis;
}

TEST_P(Otherwise, InOtherUnitsItHasTheSameBits) {
  SLOW_WITH_SANITIZERS();
  const Motion motion = motion_of(GetParam());
  const Observed seen = run(motion);
  for (const stress::Units& units : stress::all_units)
    EXPECT_EQ(stress::unit_difference(seen, run(stress::scaled(motion, units)), units), "")
        << units.length << units.time << units.mass;
}

/// A ball that slides off a globe, and a pair that meets and one that rests on it, in boxes without planes.
Motion neighbour() {
  Motion other;
  World& world = other.world;
  const auto ball = [&](const Vec3& x, const Vec3& v, double radius) {
    world.mass.push_back(1.5);
    world.radius.push_back(radius);
    world.restitution.push_back(0.5);
    other.initial.position.push_back(x);
    other.initial.velocity.push_back(v);
  };

  ball({0.01, 1.5, 0}, Vec3::Zero(), 0.5);
  ball({3, 0.25, 0}, {0.5, 0, 0}, 0.25);
  ball({4, 0.25, 0.125}, {-0.25, 0, 0}, 0.25);
  ball({4, 1.5, 0}, Vec3::Zero(), 0.25);

  world.obstacles.push_back({Vec3::Zero(), Volume::sphere(1), nullopt});
  world.obstacles.push_back({{4, -0.5, 0}, Volume::box({4, 1, 4}), nullopt});
  return other;
}

TEST_P(Otherwise, WithAnotherSceneFarAwayItHasTheSameBits) {
  SLOW_WITH_SANITIZERS();
  // The beginning alone: at their end, funnel and pour_into_bowl have other bits.
  const Motion motion = motion_of(GetParam(), false);
  // These depend on the numbers of bodies, or act on all of them.
  if (!motion.world.pairs.empty() || !motion.world.gravitations.empty() || motion.merge) return;
  const Vec3 away(1024, 512, -2048);
  for (const Plane& plane : motion.world.planes)
    if ((away - plane.point).dot(plane.normal) < 50) return;  // it would be behind this plane

  for (const bool first : {true, false}) {
    if (!first && any_of(motion.world.forces, [](const Force& force) { return !force.on.empty(); })) continue;

    Motion other = neighbour();
    other.world.gravity = motion.world.gravity;
    other.world.combine = motion.world.combine;
    const Motion both = stress::together(motion, other, first);
    const Observed alone = run(motion), seen = run(both);
    ASSERT_EQ(alone.error, "");
    ASSERT_EQ(seen.error, "");

    const size_t from = first ? 0 : other.initial.position.size();
    for (size_t i = 0; i < motion.initial.position.size(); ++i) {
      ASSERT_EQ(alone.end.position[i], seen.end.position[from + i]) << i;
      ASSERT_EQ(alone.end.velocity[i], seen.end.velocity[from + i]) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Otherwise, ::testing::ValuesIn(scene_names()), [](const auto& parameter) {
  string name = parameter.param;
  for (char& c : name)
    if (c == '/') c = '_';
  return name;
});

}  // namespace
}  // namespace carom::testing
