// What the outputs of a scene need of the machine is checked before anything is simulated or changed.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

const string pictures = "output: {trajectory: {every: 0.05}, frames: {fps: 10, size: [32, 18]}}\n";
const string film_and_charts = "output: {video: {fps: 10, size: [32, 18], samples: 1}, plots: true}\n";

/// A tetrahedron in the texture wood.png, which is not there. `more`: further top-level lines.
void put_crate(const Workplace& here, const string& more = pictures) {
  here.write("m/crate.obj",
             "mtllib crate.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nusemtl a\n"
             "f 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 1/1 4/1 3/1\nf 2/1 3/1 4/1\n");
  here.write("m/crate.mtl", "newmtl a\nmap_Kd wood.png\n");
  here.write("crate.yaml",
             "scene: 1\nbodies:\n  crate: {mass: 1, mesh: m/crate.obj, fit: box, position: [0, 0, 0]}\n"
             "simulate: {duration: 0.1}\n" +
                 more);
}

/// The error of the crate, with this fault and remedy.
string error_of_crate(const string& fault, const string& remedy) {
  return "crate.yaml:3:26: error: cannot read the mesh m/crate.obj: " + fault +
         "\n"
         "   3 |   crate: {mass: 1, mesh: m/crate.obj, fit: box, position: [0, 0, 0]}\n"
         "     |                          ^~~~~~~~~~~\n"
         "     = " +
         remedy + ", or give the body a `color`\n";
}

const string no_texture = error_of_crate("its texture wood.png is not there", "put it beside the mesh");
const string no_programs =
    "balls.yaml: error: a video needs ffmpeg, which is not on the PATH\n"
    "    = install it (on Debian: apt install ffmpeg), or leave the video out\n"
    "balls.yaml: error: the plots need gnuplot, which is not on the PATH\n"
    "    = install it (on Debian: apt install gnuplot-nox)\n";

/// A PNG file.
string small_png(const Workplace& here) {
  here.write("small.yaml", two_balls("output: {frames: {fps: 1, size: [32, 18], samples: 1}}\n"));
  here.carom({"run", "small.yaml", "-o", "small", "-q"});
  return here.read("small/frames/frame_00000.png");
}

/// Runs carom with no other program.
Finished alone(const Workplace& here, const string& words) {
  return here.shell("PATH=/nowhere; exec \"$CAROM\" " + words);
}

// A file of its name that is no library is found before the library of the system.
TEST(Requirements, OsmesaIsNeededByPicturesOfMeshesAlone) {
  const Workplace here;
  here.write("lib/libOSMesa.so.8", "no library\n");
  here.write("balls.yaml", two_balls(pictures));
  string meshes = two_balls(pictures);
  meshes.replace(meshes.find("radius:"), 0, "mesh: " SCENES_DIR "/meshes/duck.obj, ");
  here.write("ducks.yaml", meshes);
  const auto without = [&](const string& words) { return here.shell("LD_LIBRARY_PATH=lib \"$CAROM\" " + words); };

  const Finished run = without("run ducks.yaml -o ducks");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err.rfind("ducks.yaml: error: meshes in pictures need OSMesa, which cannot be loaded: ", 0), 0u)
      << run.err;
  const string remedy =
      "install it (on Debian: apt install libosmesa6; for carom's archive: unpack that of meshes in the same place), "
      "or leave out each `mesh` or the pictures";
  EXPECT_NE(run.err.find("\n    = " + remedy + "\n"), string::npos) << run.err;
  EXPECT_FALSE(here.has("ducks"));
  EXPECT_EQ(without("run balls.yaml -o balls -q").code, 0);
  EXPECT_EQ(without("run ducks.yaml -o ducks -q --only trajectory").code, 0);
}

TEST(Requirements, AMissingTextureIsFoundByCheckAndBeforeTheRun) {
  const Workplace here;
  put_crate(here);
  const Finished check = here.carom({"check", "crate.yaml"});
  EXPECT_EQ(check.code, 2);
  EXPECT_EQ(check.err, no_texture + "carom: 1 error\n");
  const Finished run = here.carom({"run", "crate.yaml"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, no_texture + "carom: 1 error; nothing was run\n");
  EXPECT_FALSE(here.has("output"));
}

TEST(Requirements, AFileWhoseNameDiffersInCaseIsNamed) {
  const Workplace here;
  put_crate(here);
  const string remedy = "write its name as on the disk";
  here.write("m/Wood.PNG", "");
  EXPECT_EQ(here.carom({"check", "crate.yaml"}).err,
            error_of_crate("its texture wood.png is not there, but Wood.PNG is", remedy) + "carom: 1 error\n");
  std::filesystem::rename(here.path("m/crate.mtl"), here.path("m/Crate.mtl"));
  EXPECT_EQ(here.carom({"check", "crate.yaml"}).err,
            error_of_crate("its material file crate.mtl is not there, but Crate.mtl is", remedy) + "carom: 1 error\n");
  std::filesystem::remove(here.path("m/Crate.mtl"));
  EXPECT_EQ(here.carom({"check", "crate.yaml"}).err,
            error_of_crate("its material file crate.mtl is not there", "put it beside the mesh") + "carom: 1 error\n");
}

TEST(Requirements, ADamagedTextureIsFoundBeforeTheRun) {
  const Workplace here;
  put_crate(here);
  const string png = small_png(here);
  here.write("m/wood.png", png.substr(0, png.size() - 20));
  EXPECT_EQ(here.carom({"run", "crate.yaml"}).err,
            error_of_crate("its texture wood.png is damaged", "save it again") + "carom: 1 error; nothing was run\n");
  EXPECT_FALSE(here.has("output"));
  here.write("m/wood.png", png);
  EXPECT_EQ(here.carom({"run", "crate.yaml"}).code, 0);
}

TEST(Requirements, AreThoseOfTheRequestedOutputsAlone) {
  const Workplace here;
  put_crate(here);
  EXPECT_EQ(here.carom({"run", "crate.yaml", "--only", "trajectory", "-o", "table"}).code, 0);
  EXPECT_EQ(here.carom({"check", "crate.yaml", "--only", "vtk,xyz,plots"}).code, 0);
  EXPECT_EQ(here.carom({"check", "crate.yaml", "--only", "gltf"}).code, 2);
  EXPECT_EQ(here.carom({"run", "crate.yaml", "--set", "bodies.crate.color=red", "-o", "red"}).code, 0);
  here.write("balls.yaml", two_balls(film_and_charts));
  EXPECT_EQ(alone(here, "run balls.yaml --only frames,trajectory -o frames").code, 0);
}

TEST(Requirements, AreNotThoseOfARunThatIsUpToDate) {
  const Workplace here;
  here.write("balls.yaml", two_balls(film_and_charts));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q"}).code, 0);
  EXPECT_EQ(alone(here, "run balls.yaml").out, "balls: Two balls\n  up to date  output/balls\n");
  EXPECT_EQ(alone(here, "check balls.yaml -q").code, 0);
  EXPECT_EQ(alone(here, "check balls.yaml -q --force").code, 2);
}

TEST(Requirements, EveryMissingProgramIsFoundByCheckAndBeforeTheFirstRun) {
  const Workplace here;
  here.write("balls.yaml", two_balls(film_and_charts));
  here.write("first.yaml", two_balls());
  EXPECT_EQ(alone(here, "check balls.yaml").err, no_programs + "carom: 2 errors\n");
  const Finished run = alone(here, "run first.yaml balls.yaml");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, no_programs + "carom: 2 errors in 1 of 2 scenes; nothing was run\n");
  EXPECT_FALSE(here.has("output"));
  const Json document = Json::parse(alone(here, "check balls.yaml --json").out);
  EXPECT_EQ(document.at("scenes").at(0).at("errors").at(0).at("remedy"),
            "install it (on Debian: apt install ffmpeg), or leave the video out");
}

TEST(Requirements, OfASweepAreFoundBeforeItsFirstRunEvenIfInvalidRunsAreLeftOut) {
  const Workplace here;
  here.write("balls.yaml", two_balls(film_and_charts));
  const Finished sweep = alone(here, "sweep balls.yaml --grid balls.red.mass=1,2 -o out");
  EXPECT_EQ(sweep.code, 2);
  EXPECT_EQ(sweep.err, "r0001:\n" + no_programs + "carom: 2 errors: nothing was run\n");
  put_crate(here);
  const Finished left_out = here.carom({"sweep", "crate.yaml", "--grid", "bodies.crate.mass=1,2", "--skip-invalid"});
  EXPECT_EQ(left_out.code, 2);
  EXPECT_EQ(left_out.err, "r0001:\n" + no_texture + "carom: 1 error: nothing was run\n");
  EXPECT_FALSE(here.has("out"));
  EXPECT_FALSE(here.has("output"));
  EXPECT_EQ(alone(here, "sweep balls.yaml --grid balls.red.mass=1,2 -o out --only trajectory").code, 0);
}

TEST(Requirements, OfNewPicturesOfARunLeaveItAsItIs) {
  const Workplace here;
  put_crate(here, "output: {trajectory: {every: 0.05}}\n");
  ASSERT_EQ(here.carom({"run", "crate.yaml", "-o", "run", "-q"}).code, 0);
  const auto before = here.files("run");

  for (const char* words : {"render run --only frames", "render run --at 0.05", "render run --only gltf -o other"}) {
    const Finished render = here.shell(string("exec \"$CAROM\" ") + words);
    EXPECT_EQ(render.code, 2) << words;
    EXPECT_NE(render.err.find(": its texture wood.png is not there\n"), string::npos) << render.err;
  }

  const Finished film = alone(here, "render run --only video --set bodies.crate.color=red");
  EXPECT_EQ(film.err,
            "run/scene.yaml: error: a video needs ffmpeg, which is not on the PATH\n"
            "    = install it (on Debian: apt install ffmpeg), or leave the video out\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_EQ(here.files("run"), before);
}

TEST(Requirements, OfNewPicturesAreNotThoseOfChartsThatStay) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {frames: {fps: 5, size: [32, 18]}, plots: true}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "run", "-q"}).code, 0);
  const string chart = here.read("run/plots/energy.svg");
  EXPECT_EQ(alone(here, "render run --set output.frames.fps=2").code, 0);
  EXPECT_EQ(here.read("run/plots/energy.svg"), chart);
}

}  // namespace
}  // namespace carom::testing
