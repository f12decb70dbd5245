// A run again from its record of paths: the same states at any instant, bit for bit.
#include "study/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "render/mesh.h"
#include "scene/load.h"
#include "scene/unsupported.h"
#include "study/engine.h"
#include "study/state_hash.h"

namespace carom {
namespace {

std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES_DIR))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().stem().string());
  files.push_back("benchmark/gas_1000");
  std::sort(files.begin(), files.end());
  return files;
}

Scene load(const std::string& name) {
  LoadOptions options;
  options.mesh_points = [](const std::string& path) { return read_mesh_points(path); };
  return load_scene(SCENES_DIR "/" + name + ".yaml", options);
}

void carry_to(Simulator& simulator, double time) {
  while (simulator.time() < time) simulator.advance_to(time);
}

/// All pieces of a run, and its tally at the end.
struct Record {
  std::vector<PathPiece> pieces;
  Tally tally;
};

Record record(const Scene& scene) {
  Record all;
  const auto simulator = make_simulator(scene, false, {}, true);
  const auto take = [&] { all.pieces.insert(all.pieces.end(), simulator->paths().begin(), simulator->paths().end()); };
  take();
  while (simulator->time() < scene.simulate.duration) {
    simulator->advance_to(scene.simulate.duration);
    take();
  }
  simulator->state();
  all.tally = simulator->tally();
  return all;
}

NextPiece from(const std::vector<PathPiece>& pieces) {
  return [&pieces, next = std::size_t{0}](PathPiece& piece) mutable {
    if (next == pieces.size()) return false;
    piece = pieces[next++];
    return true;
  };
}

bool same_bits(const State& a, const State& b) {
  const auto same = [](const Volume& v, const Volume& w) { return v.shape == w.shape && v.half == w.half; };
  return hash_of(a) == hash_of(b) && a.time == b.time && a.mass == b.mass && a.radius == b.radius &&
         a.part_of == b.part_of && a.volume.size() == b.volume.size() &&
         std::equal(a.volume.begin(), a.volume.end(), b.volume.begin(), same);
}

class EverySceneAgain : public ::testing::TestWithParam<std::string> {};

TEST_P(EverySceneAgain, HasTheSimulatorsStateAtAnyInstant) {
  const Scene scene = load(GetParam());
  const double duration = scene.simulate.duration;
  if (!goes_along_parabolas(scene.world, scene.simulate)) {
    EXPECT_TRUE(record(scene).pieces.empty());
    return;
  }
  const Record run = record(scene);
  std::mt19937_64 random(1);
  std::vector<double> instants = {0, duration};
  for (int k = 0; k < 500; ++k) instants.push_back(duration * static_cast<double>(random() >> 11) * 0x1p-53);
  for (int k = 0; k < 500; ++k) {  // where something happens, just before and just after
    const double t = run.pieces[random() % run.pieces.size()].from;
    for (const double at : {std::nextafter(t, 0), t, std::nextafter(t, 2 * duration)})
      if (at <= duration) instants.push_back(at);
  }
  std::sort(instants.begin(), instants.end());
  const auto simulator = make_simulator(scene, false);  // records nothing: nor does recording change anything
  Replay replay(scene.world, from(run.pieces), run.tally);
  for (const double t : instants) {
    carry_to(*simulator, t);
    carry_to(replay, t);
    ASSERT_TRUE(same_bits(replay.state(), simulator->state())) << t;
  }
  EXPECT_EQ(hash_of(replay.state(), replay.tally()), hash_of(simulator->state(), simulator->tally()));
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneAgain, ::testing::ValuesIn(scene_files()), [](const auto& parameter) {
  std::string name = parameter.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

}  // namespace
}  // namespace carom
