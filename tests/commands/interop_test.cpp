// Files for other programs, read back by independent programs.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

const string solids = SOURCE_DIR "/tests/interop/solids.yaml";

string read_back(const Workplace& here, const string& folder) {
  const Finished done = here.shell("/usr/bin/python3 " SOURCE_DIR "/tests/interop/read_back.py " + folder);
  return done.out + done.err;
}

TEST(Interop, EveryFormatHasTheTrajectoryToTheLastBit) {
  const Workplace here;
  ASSERT_EQ(here.carom({"run", solids, "-q"}).code, 0);
  EXPECT_EQ(read_back(here, "output/solids"), "vtk\nxyz\ngltf\n");
}

TEST(Interop, BodiesThatBecomePartOfOthersVanish) {
  const Workplace here;
  const Finished done = here.carom({"run", SCENES_DIR "/clay.yaml", "-q", "--set",
                                    "output={trajectory: {every: 0.03125}, vtk: {every: 0.03125}}", "--set",
                                    "output.xyz={every: 0.03125}", "--set", "output.gltf={fps: 32}"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(read_back(here, "output/clay"), "vtk\nxyz\ngltf\n");
  // The merged lump's radius, from the scene's comment.
  EXPECT_NE(here.read("output/clay/trajectory.xyz").find(" 0.3301927248894"), string::npos);
}

TEST(Interop, DrawnMeshesAreInTheFiles) {
  const Workplace here;
  const Finished done = here.carom({"run", SCENES_DIR "/ten_pins.yaml", "-q", "--set", "simulate.duration=0.5", "--set",
                                    "output={trajectory: {every: 0.125}}", "--set", "output.vtk={every: 0.125}",
                                    "--set", "output.gltf={fps: 8}"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(read_back(here, "output/ten_pins"), "vtk\ngltf\n");
}

TEST(Interop, TheSameSceneGivesTheSameBytes) {
  const Workplace here;
  ASSERT_EQ(here.carom({"run", solids, "-q", "-o", "a"}).code, 0);
  ASSERT_EQ(here.carom({"run", solids, "-q", "-o", "b"}).code, 0);
  auto a = here.files("a"), b = here.files("b");
  for (auto* files : {&a, &b}) files->erase("manifest.json");
  EXPECT_GT(a.size(), 40U);
  EXPECT_TRUE(a == b);
}

TEST(Interop, OnlyAddsThemWithDefaultSettings) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  ASSERT_EQ(here.carom({"run", "balls.yaml", "--only", "vtk,xyz,gltf", "-q"}).code, 0);
  const auto files = here.files("output/balls");
  for (const char* name : {"animation.glb", "surfaces.vtp", "trajectory.pvd", "trajectory.xyz", "vtk/bodies_00000.vtp"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_FALSE(files.contains("trajectory.csv"));
  const auto manifest = nlohmann::json::parse(here.read("output/balls/manifest.json"));
  EXPECT_EQ(manifest["outputs"]["gltf"]["fps"], 30);
  EXPECT_EQ(manifest["files"].size() + 1, files.size());
  // The run is up to date; a run without these files would remove them, so it needs --force.
  EXPECT_NE(here.carom({"run", "balls.yaml", "--only", "vtk,xyz,gltf"}).out.find("up to date"), string::npos);
  EXPECT_EQ(here.carom({"run", "balls.yaml", "--only", "energy"}).code, 2);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "--only", "energy", "--force", "-q"}).code, 0);
  EXPECT_EQ(here.files("output/balls").size(), 4U);
  EXPECT_FALSE(here.has("output/balls/vtk"));
}

TEST(Interop, AnInterruptedRunLeavesWholeFilesThatTheNextOneTakesAway) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {vtk: {every: 2e-4}, xyz: true, gltf: true}\n"));
  const Finished done = here.interrupted({"run", "balls.yaml", "--set", "simulate.duration=10"},
                                         "output/balls/vtk/bodies_00010.vtp", SIGTERM);
  ASSERT_EQ(done.code, 143) << done.err;
  for (const auto& [name, content] : here.files("output/balls")) {
    EXPECT_TRUE(name == "scene.yaml" || name.starts_with("vtk/bodies_")) << name;
    EXPECT_TRUE(name == "scene.yaml" || content.ends_with("</VTKFile>\n")) << name;
  }
  ASSERT_EQ(here.carom({"run", "balls.yaml", "--set", "simulate.duration=10", "--only", "energy", "-q"}).code, 0);
  EXPECT_FALSE(here.has("output/balls/vtk"));
}

TEST(Interop, TheSunIsNoBodyOfThatName) {
  const Workplace here;
  ASSERT_EQ(here.carom({"run", SCENES_DIR "/comet.yaml", "-q", "--set", "simulate.duration=1", "--set",
                        "output={trajectory: {every: 0.25}}", "--set", "output.gltf={fps: 4}"})
                .code,
            0);
  EXPECT_EQ(read_back(here, "output/comet"), "gltf\n");
}

TEST(Interop, TooManyFilesAndKeysAreRefused) {
  const Workplace here;
  here.write("vtk.yaml", two_balls("output:\n  vtk: {every: 1e-6}\n"));
  const Finished files = here.carom({"check", "vtk.yaml"});
  EXPECT_EQ(files.code, 2);
  EXPECT_NE(files.err.find("files in vtk/; the limit is 100000"), string::npos) << files.err;
  here.write("gltf.yaml", two_balls("output:\n  gltf: {fps: 1e8}\n"));
  const Finished keys = here.carom({"check", "gltf.yaml"});
  EXPECT_EQ(keys.code, 2);
  EXPECT_NE(keys.err.find("keyframes of animation.glb; the limit is 10000000"), string::npos) << keys.err;
  EXPECT_NE(keys.err.find("expected a lower `fps`, a shorter duration or fewer bodies"), string::npos) << keys.err;
}

TEST(Interop, BytesArePredicted) {
  const Workplace here;
  for (const char* output : {"vtk", "xyz", "gltf"}) {
    const auto check = nlohmann::json::parse(here.carom({"check", solids, "--only", output, "--json"}).out);
    ASSERT_EQ(here.carom({"run", solids, "--only", output, "--force", "-q"}).code, 0);
    double bytes = 0;
    for (const auto& [name, content] : here.files("output/solids")) bytes += static_cast<double>(content.size());
    EXPECT_NEAR(check["scenes"][0]["bytes"].get<double>() / bytes, 1, 0.5) << output;
  }
}

}  // namespace
}  // namespace carom::testing
