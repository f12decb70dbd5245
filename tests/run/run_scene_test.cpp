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
