// A run advances one simulator once, whatever it writes and draws.
#include "run/run_scene.h"

#include <gtest/gtest.h>

#include "run/run_testing.h"
#include "scene/output_kinds.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// Small and few pictures in place of those of the scene.
void make_small(Output& output) {
  const PictureOutput small{1, {32, 18}, 1, 0, {}};
  if (output.frames) static_cast<PictureOutput&>(*output.frames) = small;
  if (output.sheet) output.sheet = SheetOutput{2, 1, Size{96, 48}, 0, {}};
  if (output.gltf) output.gltf = GltfOutput{1};
  if (output.trajectory) output.trajectory->every = 1;
  if (output.vtk) output.vtk->every = 1;
  if (output.xyz) output.xyz->every = 1;
}

/// How many simulators a run of the scene with these outputs makes.
int simulators_of(Scene scene, const vector<string>& outputs) {
  const RunPlace place;
  scene.output = restricted(scene.requested, outputs);
  make_small(scene.output);
  make_small(scene.requested);

  int made = 0;
  RunSettings settings;
  settings.durability = Durability::deferred;
  settings.simulator = [&made](const Scene& of, Recording recording, const StepChoice& steps) {
    ++made;
    return make_simulator(of, std::move(recording), steps);
  };

  run_scene({&scene, place / "run"}, choose_engine(scene), settings, {[] {}, [](const RunProgress&) {}});
  return made;
}

class EverySceneRun : public ::testing::TestWithParam<string> {};

TEST_P(EverySceneRun, SimulatesOnceByAnyCamera) {
  SLOW_WITH_SANITIZERS("funnel", "binary_stars", "hourglass", "lattice");
  Scene scene = scene_in_short(GetParam());
  const vector<string> outputs = {"energy", "frames", "sheet", "vtk", "gltf"};
  EXPECT_EQ(simulators_of(scene, outputs), 1);
  scene.camera.reset();
  EXPECT_EQ(simulators_of(scene, outputs), 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneRun, ::testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

const string ball =
    "scene: 1\nballs: {b: {mass: 1, radius: 0.1, position: [0, 1, 0], restitution: 0.5}}\n"
    "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";

/// The lines of a file in the folder of a run.
vector<string> lines_of(const string& folder, const string& file) {
  std::ifstream in(folder + "/" + file);
  vector<string> lines;
  for (string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Run, HasStatesBeforeAndForcesAfterWhatHappensAtTime0) {
  const RunPlace place;
  Scene scene = place.scene(
      "scene: 1\ngravity: [0, -10, 0]\nrestitution: 0\ndefaults: {body: {mass: 1, box: [1, 1, 1]}}\n"
      "bodies: {low: {position: [0, 0.5, 0]}, high: {position: [0, 1.5, 0]},\n"
      "  left: {position: [4, 0.5, 0], velocity: [1, 0, 0], restitution: 1}, right: {position: [5, 0.5, 0], "
      "restitution: 1}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 0.5}\n"
      "output: {trajectory: {every: 0.5}, contacts: {every: 0.5}, collisions: true, frames: {fps: 2, size: [32, "
      "18]}}\n");

  const auto run_of = [&](const string& name, const vector<string>& outputs) {
    scene.output = restricted(scene.requested, outputs);
    const string folder = place / name;
    run_scene({&scene, folder}, choose_engine(scene), {.durability = Durability::deferred},
              {[] {}, [](const RunProgress&) {}});
    return folder;
  };

  const string with = run_of("with", {"trajectory", "contacts", "collisions", "frames"});
  vector<string> first;
  for (const string& line : lines_of(with, "contacts.csv"))
    if (line.starts_with("0,")) first.push_back(line);
  EXPECT_EQ(first, (vector<string>{"0,low,high,10", "0,low,floor,20", "0,left,floor,10", "0,right,floor,10"}));

  // The pair's impact has one row, and everything else is as it is without forces.
  EXPECT_EQ(lines_of(with, "collisions.csv").size(), 2u);
  const string without = run_of("without", {"trajectory", "collisions", "frames"});
  for (const string file : {"trajectory.csv", "collisions.csv", "frames/frame_00000.png"}) {
    EXPECT_FALSE(lines_of(with, file).empty()) << file;
    EXPECT_EQ(lines_of(with, file), lines_of(without, file)) << file;
  }
}

TEST(Run, SimulatesOnceWithEveryCombinationOfOutputs) {
  const RunPlace place;
  const vector<string> kinds = {"trajectory", "collisions", "frames", "sheet", "xyz", "gltf", "flights"};

  for (const string& more :
       {string("simulate: {duration: 1}\n"), string("simulate: {duration: 2, stop: [{collisions: 3}]}\n"),
        string("simulate: {duration: 1}\ncamera: {eye: [0, 1, 5], target: [0, 1, 0]}\n"),
        string("simulate: {duration: 1}\nshutter: 0.5\ntrails: true\nflash: true\n")}) {
    const Scene scene = place.scene(ball + more + "output: {sheet: true}\n");

    for (unsigned set = 0; set < 1u << kinds.size(); ++set) {
      vector<string> outputs;
      for (size_t k = 0; k < kinds.size(); ++k)
        if (set >> k & 1u) outputs.push_back(kinds[k]);
      EXPECT_EQ(simulators_of(scene, outputs), 1) << more << set;
    }
  }
}

}  // namespace
}  // namespace carom
