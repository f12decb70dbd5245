// Every scene, and random ones, saved and restored on the way.
#include "simulate/snapshot.h"

#include <random>

#include "engine/engine.h"
#include "run/run_testing.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "stress/scene.h"

namespace carom {
namespace {

/// Ascending, at random (s), and the end.
vector<double> some_times(std::mt19937_64& random, double duration, int count) {
  vector<double> times;
  for (int k = 0; k < count; ++k) times.push_back(duration * static_cast<double>(random() >> 11) * 0x1p-53);
  ranges::sort(times);
  times.push_back(duration);
  return times;
}

vector<WatchedQuantity> watch_all(Entity bodies) {
  return {{Quantity::y, 0, bodies}, {Quantity::speed, 0, bodies}};
}

class EverySceneRestored : public ::testing::TestWithParam<string> {};

TEST_P(EverySceneRestored, GoesOnWithTheSameBits) {
  SLOW_WITH_SANITIZERS("balls_in_a_box", "brick_wall", "funnel", "pile_at_rest", "piston", "binary_stars", "hourglass",
                       "lattice", "pour_into_bowl");
  const Scene scene = scene_in_short(GetParam());
  std::mt19937_64 random(1);
  const vector<double> times = some_times(random, scene.simulate.duration, 8);
  for (const bool records : {false, true}) {
    SCOPED_TRACE(records ? "with records" : "without records");
    const auto watch = records ? watch_all(scene.world.body_count()) : vector<WatchedQuantity>();
    expect_same_when_restored([&] { return make_simulator(scene, {records, records, watch}); }, times, random());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneRestored, ::testing::ValuesIn(scene_names()));

class RandomSceneRestored : public ::testing::TestWithParam<size_t> {};

TEST_P(RandomSceneRestored, GoesOnWithTheSameBits) {
  SLOW_WITH_SANITIZERS("gas", "heaps");
  const size_t families = stress::family_names().size();
  for (uint64_t k = 0; k < 24; ++k) {
    stress::RandomScene scene = stress::make_scene(GetParam() + families * k);
    if (k % 3 == 2) scene = stress::with_motions(scene);
    SCOPED_TRACE("seed " + to_string(scene.seed));

    std::mt19937_64 random(scene.seed);
    scene.options.record_paths = random() % 2 == 0;
    scene.options.record_collisions = random() % 4 != 0;
    scene.options.stop_at_rest = random() % 4 == 0;
    if (random() % 2 == 0) scene.options.watch = watch_all(scene.world.body_count());
    expect_same_when_restored([&] { return make_exact_simulator(scene.world, scene.initial, scene.options); },
                              some_times(random, scene.options.duration, 6), random());
  }
}

INSTANTIATE_TEST_SUITE_P(Families, RandomSceneRestored, ::testing::Range(size_t{0}, stress::family_names().size()),
                         [](const auto& family) { return string(stress::family_names()[family.param]); });

}  // namespace
}  // namespace carom
