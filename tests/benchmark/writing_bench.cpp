// Cost of reading and writing much: ten million rows of a trajectory, compared with formatting their numbers alone;
// scenes of a million balls.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "export/tables.h"
#include "physics/world.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A temporary folder.
class Folder {
 public:
  Folder() {
    string name = std::filesystem::temp_directory_path() / "carom_bench_XXXXXX";
    if (mkdtemp(name.data())) path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const string& path() const { return path_; }

 private:
  string path_;
};

constexpr Entity bodies = 1000;

/// Numbers of 16 and 17 digits, as in trajectories.
State motion() {
  State state;
  for (Entity i = 0; i < bodies; ++i) {
    const double x = 1 / (i + 1.7), y = 1 / (i + 2.9), z = 1 / (i + 3.1);
    state.position.emplace_back(x, y, z);
    state.velocity.emplace_back(-y, z / 3, x / 7);
  }
  return state;
}

void digits(benchmark::State& state) {
  const State of = motion();
  char text[number_size];
  for (auto _ : state) {
    for (int64_t instant = 0; instant < state.range(0) / bodies; ++instant)
      for (Entity i = 0; i < bodies; ++i)
        for (const Vec3* v : {&of.position[i], &of.velocity[i]})
          for (int axis = 0; axis < 3; ++axis)
            benchmark::DoNotOptimize(std::to_chars(text, text + number_size, (*v)[axis]).ptr);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(digits)->Arg(10'000'000)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

void trajectory(benchmark::State& state) {
  const State of = motion();
  Scene scene;
  scene.world.mass.assign(bodies, 1);
  scene.roster.bodies = {{"gas", 0, bodies, true, {}}};
  scene.output.trajectory = TrajectoryOutput{0.001, false};

  for (auto _ : state) {
    const Folder folder;
    const Descriptor open_folder(open(folder.path().c_str(), O_RDONLY | O_DIRECTORY));
    TrajectoryTable table({open_folder.get(), folder.path()}, scene);
    for (int64_t instant = 0; instant < state.range(0) / bodies; ++instant)
      table.add(0.001 * static_cast<double>(instant), of, {});
    table.files().front()->complete();

    state.SetLabel(table.files().front()->record().sha256.substr(0, 16));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(trajectory)->Arg(10'000'000)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

void load_million(benchmark::State& state, const string& arrange) {
  const Folder folder;
  const string file = folder.path() + "/million.yaml";
  std::ofstream(file) << "scene: 1\n"
                         "gravity: [0, 0, 0]\n"
                         "groups:\n"
                         "  gas: {count: 1000000, ball: {mass: 1, radius: 0.5}, speed: 1, arrange: "
                      << arrange
                      << ",\n"
                         "        in: {min: [0, 0, 0], max: [150, 150, 150]}}\n"
                         "simulate: {duration: 1}\n";
  for (auto _ : state) benchmark::DoNotOptimize(load_scene(file));
}
BENCHMARK_CAPTURE(load_million, lattice, "lattice")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(load_million, hexagonal, "hexagonal")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(load_million, random, "random")->Unit(benchmark::kSecond);

/// Balls listed in the file one by one.
void load_list(benchmark::State& state) {
  const Folder folder;
  const string file = folder.path() + "/list.yaml";
  {
    std::ofstream text(file);
    text << "scene: 1\ndefaults: {ball: {mass: 1, radius: 0.4}}\nballs:\n";
    for (int64_t i = 0; i < state.range(0); ++i)
      text << fmt::format("  b{}: {{position: [{}, {}, {}], velocity: [0.25, -0.5, 1]}}\n", i, i % 100, i / 100 % 100,
                          i / 10'000);
    text << "simulate: {duration: 1}\n";
  }

  for (auto _ : state) benchmark::DoNotOptimize(load_scene(file));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(load_list)->Arg(100'000)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace carom
