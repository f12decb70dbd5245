// Invariants of every file in scenes/.
#include <gtest/gtest.h>

#include "physics/energy.h"
#include "physics/world.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

class EveryScene : public ::testing::TestWithParam<string> {};

TEST_P(EveryScene, OpensWithWhatToExpect) {
  EXPECT_NE(comment_of(GetParam()).find("Expect"), string::npos);
}

TEST_P(EveryScene, HasATitle) {
  EXPECT_FALSE(load(GetParam()).title.empty());
}

TEST_P(EveryScene, RunsToItsEndAndKeepsItsBooks) {
  SLOW_WITH_SANITIZERS("balls_in_a_box", "gas_1000", "brick_wall", "funnel", "pile_at_rest", "binary_stars",
                       "hourglass");
  const Played run = play(GetParam());
  for (size_t i = 0; i < run.end.position.size(); ++i) {
    EXPECT_TRUE(run.end.position[i].allFinite() && run.end.velocity[i].allFinite()) << run.scene.roster.name(i);
  }

  // Energy at the end = at the start - that of removed bodies + that of those that came later + work - losses in
  // impacts - losses of the method of lasting contact. What there was, what there is, and what has passed.
  const World& world = run.scene.world;
  const double before = run.energy_start - run.tally.changes.removed.energy + run.tally.changes.appeared.energy;
  const double after = kinetic_energy(world, run.end) + potential_energy(world, run.end);
  const double passed = std::abs(before) + std::abs(run.tally.work) + std::abs(run.tally.energy_lost);
  if (run.scene.simulate.engine == Engine::book && !world.gravity.isZero(0)) return;  // Euler's steps keep no energy
  EXPECT_NEAR(after, before + run.tally.work - run.tally.energy_lost - run.tally.method_error,
              1e-11 * passed);  // measured: 3e-12 (pi_to_six_digits)

  const bool crowds = run.tally.stepped_contact > 0;
  const double least = crowds ? 1e-4 : 1e-9;  // measured: 8e-6 (pile_at_rest)
  EXPECT_LT(std::abs(run.tally.method_error), least * passed);
  if (run.scene.simulate.engine != Engine::book) {
    const double smallest = *ranges::min_element(world.radius);
    EXPECT_LE(run.tally.max_overlap, (crowds ? 1e-10 : 2e-11) * smallest);  // measured: 8e-11 (balls_in_a_box)
  }
}

TEST_P(EveryScene, ShowsSomething) {
  SLOW_WITH_SANITIZERS("balls_in_a_box", "gas_1000", "brick_wall", "funnel", "pile_at_rest", "binary_stars",
                       "hourglass");
  const Scene scene = load(GetParam());
  // One that frames the motion shows it: seen_test.cpp.
  if (!scene.output.pictures() || !scene.camera) return;
  const Played run = play(GetParam(), {scene.simulate.duration / 2});

  Renderer renderer(run.scene, {192, 108}, 1);
  const Image empty = renderer.draw({0, vector<Vec3>(run.end.position.size(), Vec3(0, -1e6, 0)), run.end.velocity});
  const Image image = renderer.draw(run.states[0]);

  size_t changed = 0;
  for (size_t i = 0; i < image.pixels.size(); i += 3) {
    changed += !std::equal(image.pixels.begin() + i, image.pixels.begin() + i + 3, empty.pixels.begin() + i);
  }
  EXPECT_GE(changed, 12u) << "no ball in sight half way";  // of 20,736 pixels; measured: 18 (pinball)
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, ::testing::ValuesIn(scene_names()), [](const auto& parameter) {
  string name = parameter.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

}  // namespace
}  // namespace carom::testing
