// Cost of whole scenes: every file in scenes/benchmark loaded, simulated to its end without outputs, and drawn once.
// A hash of the final state follows the time: equal hashes are equal results, bit for bit.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>

#include "bench/state_hash.h"
#include "export/png.h"
#include "paths.h"
#include "render/renderer.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/exact.h"
#include "std.h"

namespace carom {
namespace {

void load(benchmark::State& state, const string& file) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(load_scene(file));
  }
}

void simulate(benchmark::State& state, const string& file) {
  const Scene scene = load_scene(file);
  ExactOptions options;
  options.duration = scene.simulate.duration;
  options.rest_speed = scene.simulate.rest_speed.value_or(0);
  options.record_collisions = false;
  uint64_t collisions = 0, result = 0;

  for (auto _ : state) {
    const auto simulator = make_exact_simulator(scene.world, scene.initial, options);
    while (simulator->time() < options.duration) {
      simulator->advance_to(options.duration);
    }
    collisions = simulator->tally().collisions();
    result = hash_of(simulator->state());
  }

  const double all = static_cast<double>(collisions);
  state.counters["collisions"] = all;
  state.counters["per_s"] = benchmark::Counter(all, benchmark::Counter::kIsIterationInvariantRate);
  state.SetLabel(fmt::format("hash {:016x}", result));
}

void frame(benchmark::State& state, const string& file) {
  const Scene scene = load_scene(file);
  const FramesOutput frames = scene.output.frames.value_or(FramesOutput{});
  Renderer renderer(scene, frames.size, frames.samples);
  for (auto _ : state) {
    benchmark::DoNotOptimize(encode_png(renderer.draw(scene.initial)));
  }
  state.counters["frames_per_s"] = benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
}

/// Registers each scene before main() runs, so that --benchmark_filter finds them.
const bool registered = [] {
  vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES_DIR "/benchmark")) {
    files.push_back(entry.path());
  }
  ranges::sort(files);

  for (const std::filesystem::path& file : files) {
    const string name = "/" + file.stem().string();
    benchmark::RegisterBenchmark(("load" + name).c_str(), load, file.string())->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("simulate" + name).c_str(), simulate, file.string())->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("frame" + name).c_str(), frame, file.string())
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime();  // that of all of the renderer's threads
  }
  return true;
}();

}  // namespace
}  // namespace carom
