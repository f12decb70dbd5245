// Random scenes of everything at once, by every engine, saved and restored on the way.
#include "simulate/snapshot.h"

#include <random>

#include "engine/engine.h"
#include "fuzz/any_scene.h"
#include "fuzz/memory_file.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::fuzz {
namespace {

TEST(SnapshotOfAnyScene, GoesOnWithTheSameBits) {
  SLOW_WITH_SANITIZERS();
  int run = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const MemoryFile file(make_any_scene(seed).yaml());
    unique_ptr<Scene> scene;
    try {
      scene = make_unique<Scene>(load_scene(file.path()));
      make_simulator(*scene);
    } catch (const runtime_error&) {
      continue;  // refused
    }
    SCOPED_TRACE("seed " + to_string(seed));
    ++run;

    std::mt19937_64 random(seed);
    Recording records{random() % 2 == 0, random() % 2 == 0};
    if (random() % 2 == 0) records.watch = {{Quantity::x, 0, scene->world.body_count()}};
    vector<double> times;
    for (int k = 0; k < 6; ++k)
      times.push_back(scene->simulate.duration * static_cast<double>(random() >> 11) * 0x1p-53);
    ranges::sort(times);
    times.push_back(scene->simulate.duration);
    expect_same_when_restored([&] { return make_simulator(*scene, records); }, times, random());
  }
  EXPECT_GT(run, 150);
}

}  // namespace
}  // namespace carom::fuzz
