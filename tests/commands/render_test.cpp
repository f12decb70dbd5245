// carom render, by the real program: other pictures of a run, without simulating again.
#include <gtest/gtest.h>
#include <png.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/program.h"
#include "paths.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

using Files = map<string, string>;
using Words = vector<string>;

const string frames = "output: {collisions: true, frames: {fps: 4, size: [64, 36], samples: 1}}\n";
const string near_camera = "camera: {eye: [0, 0.5, -3], target: [0, 0, 0]}\n";

/// carom run of a scene of scenes/, small and few pictures, into the folder `to`.
void run_scene_of_ours(const Workplace& here, const string& scene, const string& to, const Words& more = {}) {
  Words words = {"run",     SCENES_DIR "/" + scene + ".yaml",
                 "-o",      to,
                 "--only",  "frames,flights,energy",
                 "--set",   "output.frames={fps: 5, size: [48, 32], samples: 1}",
                 "--quiet", "--progress",
                 "none"};
  words.insert(words.end(), more.begin(), more.end());
  const Finished run = here.carom(words);
  ASSERT_EQ(run.code, 0) << run.err;
}

// Scenes with rest, merging, rolling, edges of walls, meshes, timed forces, constrained islands and time stepping.
class Rendered : public ::testing::TestWithParam<const char*> {};

TEST_P(Rendered, WithAnotherRateIsWhatARunWithThatRateWrites) {
  const Workplace here;
  run_scene_of_ours(here, GetParam(), "run");
  const Finished render =
      here.carom({"render", "run", "--set", "output.frames.fps=7", "--only", "frames", "-o", "render", "--quiet"});
  ASSERT_EQ(render.code, 0) << render.err;
  EXPECT_EQ(render.err, "");

  // A run of the same scene has the same files.
  const Words run = {"run", "run/scene.yaml", "--set", "output.frames.fps=7", "--only", "frames,flights", "-o"};
  Words to = run;
  to.push_back("fresh");
  ASSERT_EQ(here.carom(to).code, 0);
  EXPECT_EQ(without_manifest(here.files("render")), without_manifest(here.files("fresh")));

  to.back() = "render";
  EXPECT_NE(here.carom(to).out.find("up to date"), string::npos);
}

TEST_P(Rendered, WithoutAChangeHasTheBytesOfTheRun) {
  const Workplace here;
  run_scene_of_ours(here, GetParam(), "run");
  ASSERT_EQ(here.carom({"render", "run", "--only", "frames", "-o", "render"}).code, 0);
  Files run = here.files("run");
  run.erase("energy.csv");
  EXPECT_EQ(without_manifest(here.files("render")), without_manifest(run));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Rendered,
                         ::testing::Values("bouncing_ball", "clay", "rolling_off", "wall_fly_over", "ten_pins", "gust",
                                           "pyramid", "two_bowling_balls_e11", "gas_in_a_room", "slack_pendulum"),
                         [](const auto& scene) { return string(scene.param); });

TEST(Render, InPlaceReplacesThePicturesAndKeepsTheTables) {
  const Workplace here;
  here.write("balls.yaml",
             two_balls(near_camera + "output: {collisions: true, energy: {every: 0.5}, vtk: true, gltf: true, "
                                     "frames: {fps: 4, size: [64, 36], samples: 1}}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Words set = {"--set", "camera.eye.y=2",   "--set", "output.frames.fps=3",
                     "--set", "title=From above", "--set", "balls.red.color=gold"};
  Words render = {"render", "run"};
  render.insert(render.end(), set.begin(), set.end());

  const Finished done = here.carom(render);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("run: From above\n"), string::npos);
  EXPECT_NE(done.out.find("  wrote       run: animation.glb, manifest.json, scene.yaml, summary.csv, surfaces.vtp,\n"
                          "              trajectory.pvd, 4 pictures in frames/ and 31 instants in vtk/\n"),
            string::npos)
      << done.out << "not collisions.csv, energy.csv and flights.bin, which stay";

  // A run with these settings has the same.
  Words fresh = {"run", "balls.yaml", "-o", "fresh"};
  fresh.insert(fresh.end(), set.begin(), set.end());
  here.carom(fresh);
  EXPECT_EQ(without_manifest(here.files("run")), without_manifest(here.files("fresh")));
  EXPECT_FALSE(here.has("run/frames/frame_00004.png"));
  EXPECT_NE(here.carom({"run", "run/scene.yaml", "-o", "run"}).out.find("up to date"), string::npos);
  EXPECT_NE(here.carom({"render", "run"}).out.find("up to date"), string::npos);

  // All except measurements and the order of the files.
  const auto facts = [&](const string& folder) {
    auto json = nlohmann::json::parse(here.read(folder + "/manifest.json"));
    json.erase("wall_times_s");
    json.erase("peak_memory_bytes");
    std::sort(json["files"].begin(), json["files"].end(),
              [](const auto& a, const auto& b) { return a["name"] < b["name"]; });
    return json.dump();
  };

  EXPECT_EQ(facts("run"), facts("fresh"));
}

TEST(Render, DrawsWhatTheRunDidNotRequest) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {energy: {every: 0.5}, flights: true}\n" + near_camera));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Finished none = here.carom({"render", "run"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.err,
            "run: its scene has no pictures\n  add them with --only frames, video or sheet\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_EQ(here.carom({"render", "run", "--only", "sheet"}).code, 0);
  EXPECT_TRUE(here.has("run/sheet.png") && here.has("run/energy.csv") && here.has("run/flights.bin"));
}

TEST(Render, AFilmOfAnotherFormatReplacesTheFilm) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + "output: {energy: true, video: {fps: 10, size: [64, 36]}}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  ASSERT_TRUE(here.has("run/animation.mp4"));
  for (const string file : {"film.gif", "film.webp"}) {
    const Finished render = here.carom({"render", "run", "--set", "output.video.file=" + file});
    EXPECT_EQ(render.code, 0) << render.err;
    EXPECT_TRUE(here.has("run/" + file) && here.has("run/energy.csv"));
    EXPECT_FALSE(here.has("run/animation.mp4"));
  }
  EXPECT_FALSE(here.has("run/film.gif"));
}

TEST(Render, SlowMotionIsDrawnFromTheRecordedPaths) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + "output: {video: {fps: 10, size: [64, 36]}}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const auto packets = [&](const string& film) {
    return here.shell("ffprobe -v error -count_packets -show_entries stream=nb_read_packets -of csv=p=0 " + film).out;
  };
  EXPECT_EQ(packets("run/animation.mp4"), "11\n");
  const Finished render = here.carom({"render", "run", "--set", "output.video.speed=0.125", "-o", "slow"});
  EXPECT_EQ(render.code, 0) << render.err;
  EXPECT_EQ(packets("slow/animation.mp4"), "81\n");
}

TEST(Render, ASettingThatChangesNothingIsSaid) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + "output: {frames: {fps: 2, size: [64, 36]}, video: true}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const vector<string> words = {"render", "run", "--only", "video", "-o", "other", "--set"};

  const auto errors = [&](const string& setting) {
    vector<string> line = words;
    line.push_back(setting);
    line.push_back("--force");
    const Finished render = here.carom(line);
    EXPECT_EQ(render.code, 0) << render.err;
    return render.err;
  };

  EXPECT_EQ(errors("output.frames.from=0.5"),
            "carom: run: --set output.frames.from=0.5 changes nothing: the output `frames` is not written\n");
  EXPECT_EQ(errors("output.frames.fps=4"),
            "carom: run: --set output.frames.fps=4 changes nothing: the output `frames` is not written\n")
      << "scene.yaml of a run gives each output its own settings";
  EXPECT_EQ(errors("output.video.from=0.5"), "");
  EXPECT_EQ(errors("camera.eye.y=2"), "");
}

TEST(Render, RefusesAnotherMotionAndNamesTheCommandThatSimulatesIt) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + frames));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Files before = here.files("run");
  const Finished render =
      here.carom({"render", "run", "--set", "camera.eye.y=2", "--set", "balls.red.velocity=[3, 0, 0]"});
  EXPECT_EQ(render.code, 2);
  EXPECT_EQ(render.err,
            "run: --set balls.red.velocity=[3, 0, 0] changes the motion, which needs a new simulation\n"
            "  carom run run/scene.yaml --set camera.eye.y=2 --set 'balls.red.velocity=[3, 0, 0]' -o OTHER runs it\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_EQ(here.files("run"), before);
}

TEST(Render, RefusesOtherTables) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + "output: {energy: {every: 0.5}, frames: {size: [64, 36]}}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  EXPECT_EQ(here.carom({"render", "run", "--only", "energy"}).code, 2);
  const Finished render = here.carom({"render", "run", "--set", "output.energy.every=0.1"});
  EXPECT_EQ(render.code, 2);
  EXPECT_EQ(render.err,
            "run: --set changes one of energy, which render leaves as they are\n  carom run writes them\n"
            "carom: 1 error; nothing was run\n");
}

TEST(Render, RefusesChartsAndNamesTheCommandThatDrawsThem) {
  const Workplace here;
  here.write("balls.yaml",
             two_balls(near_camera + "output: {energy: {every: 0.5}, frames: {fps: 2, size: [64, 36]}}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Files before = here.files("run");
  const Finished render = here.carom({"render", "run", "--set", "output.plots=true"});
  EXPECT_EQ(render.code, 2);
  EXPECT_EQ(render.err,
            "run: --set output.plots=true: render makes no plots\n  carom plot run makes them\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_EQ(here.files("run"), before);
  EXPECT_NE(here.carom({"render", "run", "--only", "plots"}).err.find(": carom plot makes plots\n"), string::npos);
}

TEST(Render, RefusesWhatIsNoWholeRun) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + frames));
  here.carom({"run", "balls.yaml", "-o", "run"});

  const auto refusal = [&](const string& folder) {
    const Finished render = here.carom({"render", folder, "--set", "camera.eye.y=2"});
    EXPECT_EQ(render.code, 2);
    return render.err.substr(0, render.err.find('\n'));
  };

  EXPECT_EQ(refusal("nowhere"), "nowhere: there is no such folder");
  EXPECT_EQ(refusal("balls.yaml"), "balls.yaml: it is not a folder");
  EXPECT_EQ(refusal("."), ".: it holds no whole run: there is no manifest.json");

  // Flights that are cut or damaged.
  const string flights = here.read("run/flights.bin"), manifest = here.read("run/manifest.json");
  const string changed = "run: flights.bin is missing or has changed";
  here.write("run/flights.bin", flights.substr(0, flights.size() - 1));
  EXPECT_EQ(refusal("run"), changed);

  string damaged = flights;
  damaged[100] = static_cast<char>(damaged[100] ^ 1);
  here.write("run/flights.bin", damaged);
  EXPECT_EQ(refusal("run"), changed);

  // A manifest that is cut, and another scene.
  here.write("run/flights.bin", flights);
  here.write("run/manifest.json", manifest.substr(0, 99));
  EXPECT_EQ(refusal("run"), "run: its manifest.json is damaged, or not written by carom");

  here.write("run/manifest.json", manifest);
  const string scene = here.read("run/scene.yaml");
  here.write("run/scene.yaml", scene + "# changed\nbackground: black\n");
  EXPECT_EQ(refusal("run"), "run: its scene.yaml is not the one that was run");

  here.write("run/scene.yaml", scene);
  here.shell("rm -r run/frames");  // pictures may be missing
  EXPECT_EQ(here.carom({"render", "run"}).code, 0);
  EXPECT_TRUE(here.has("run/frames/frame_00004.png"));
}

TEST(Render, SimulatesAgainWhereNoFlightsAreStored) {
  const Workplace here;
  for (const string engine : {"exact", "stepped", "book"}) {
    here.write("balls.yaml", two_balls(near_camera + frames));
    ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", engine, "--set", "simulate.engine=" + engine, "--set",
                          "output.flights=false"})
                  .code,
              0);

    EXPECT_FALSE(here.has(engine + "/flights.bin"));
    const Finished render = here.carom({"render", engine, "--set", "output.frames.fps=3", "-o", "again " + engine});
    EXPECT_EQ(render.code, 0) << render.err;
    EXPECT_EQ(render.err, engine + ": no flights are stored: simulating again\n");

    ASSERT_EQ(here.carom({"run", engine + "/scene.yaml", "-o", "fresh " + engine, "--only", "frames", "--set",
                          "output.frames.fps=3"})
                  .code,
              0);
    EXPECT_EQ(without_manifest(here.files("again " + engine)), without_manifest(here.files("fresh " + engine)));
  }
}

TEST(Render, RefusesFlightsOfWhatIsNoParabola) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {flights: true}\n"));
  EXPECT_EQ(here.carom({"run", "balls.yaml"}).code, 0);
  const Finished run = here.carom({"run", "balls.yaml", "--set", "simulate.engine=stepped"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("`flights` need parabolas from impact to impact"), string::npos) << run.err;
  here.write("balls.yaml", two_balls());
  const Finished only = here.carom({"run", "balls.yaml", "--set", "simulate.engine=book", "--only", "flights"});
  EXPECT_EQ(only.code, 2);
  EXPECT_EQ(only.err,
            "balls.yaml: flights need parabolas from impact to impact, and this scene has other paths: leave them out\n"
            "carom: 1 error; nothing was run\n");
}

TEST(Render, OfACameraThatFramesTheMotionHasTheBytesOfARun) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {frames: {fps: 4, size: [64, 36]}, video: {fps: 8, size: [32, 18]}}\n"));
  here.carom({"run", "balls.yaml", "-o", "run", "--only", "frames,flights"});
  ASSERT_EQ(
      here.carom({"render", "run", "--only", "frames", "--set", "camera={fit: motion, fov: 20}", "-o", "render"}).code,
      0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "--set", "camera={fit: motion, fov: 20}", "-o", "fresh"}).code, 0);

  for (int i = 0; i <= 4; ++i) {
    const string frame = "/frames/frame_0000" + to_string(i) + ".png";
    EXPECT_EQ(here.read("render" + frame), here.read("fresh" + frame));
    EXPECT_FALSE(here.read("render" + frame).empty());
    EXPECT_NE(here.read("render" + frame), here.read("run" + frame));
  }
}

/// The pixels of a PNG file.
vector<uint8_t> pixels_of(const string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, file.data(), file.size()));
  image.format = PNG_FORMAT_RGB;
  vector<uint8_t> pixels(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
  return pixels;
}

TEST(Still, IsTheFrameOfItsTime) {
  const Workplace here;
  here.write("balls.yaml", two_balls(frames));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Finished still = here.carom({"render", "run", "--at", "0.75"});
  EXPECT_EQ(still.code, 0);
  EXPECT_EQ(still.out, "run/still_0.75s.png\n");
  EXPECT_EQ(still.err, "");
  EXPECT_EQ(pixels_of(here.read("run/still_0.75s.png")), pixels_of(here.read("run/frames/frame_00003.png")));
  EXPECT_NE(here.carom({"run", "run/scene.yaml", "-o", "run"}).out.find("up to date"), string::npos);
  EXPECT_EQ(here.carom({"render", "run", "--at", "0"}).out, "run/still_0s.png\n");
  EXPECT_EQ(here.carom({"render", "run", "--at", "1"}).out, "run/still_1s.png\n");
}

TEST(Still, TakesCameraSizeAndFolder) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + frames));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Files before = here.files("run");

  const Words still = {
      "render", "run",      "--at", "0.3", "--set", "camera={follow: red}", "--set", "output.frames.size=[40, 20]",
      "-o",     "a/new one"};
  EXPECT_EQ(here.carom(still).out, "a/new one/still_0.3s.png\n");
  EXPECT_EQ(here.files("run"), before);
  EXPECT_EQ(pixels_of(here.read("a/new one/still_0.3s.png")).size(), 3u * 40 * 20);

  Words json = still;
  json.push_back("--json");
  const auto entry = nlohmann::json::parse(here.carom(json).out).at("scenes").at(0);
  EXPECT_EQ(entry.at("status"), "done");
  EXPECT_EQ(entry.at("files"), nlohmann::json({"still_0.3s.png"}));
}

TEST(Still, OfSeveralRunsAndWithoutFlightsIsDrawnToo) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {energy: {every: 0.5}}\n"));
  here.carom({"run", "balls.yaml", "-o", "a/one"});
  here.carom({"run", "balls.yaml", "-o", "a/two", "--set", "simulate.engine=stepped"});
  const Finished still = here.carom({"render", "a/one", "a/two", "--at", "0.5", "-o", "b"});
  EXPECT_EQ(still.code, 0);
  EXPECT_EQ(still.out.substr(0, still.out.find("2 scenes")), "b/one/still_0.5s.png\nb/two/still_0.5s.png\n");
  EXPECT_EQ(still.err,
            "a/one: no flights are stored: simulating again\na/two: no flights are stored: simulating again\n");
  EXPECT_EQ(pixels_of(here.read("b/one/still_0.5s.png")).size(), 3u * 1280 * 720);
}

TEST(Still, OutsideTheRunOrBesideOtherOutputsIsRefused) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + frames));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Finished after = here.carom({"render", "run", "--at", "1.5"});
  EXPECT_EQ(after.code, 2);
  EXPECT_EQ(after.err,
            "run: --at 1.5 is after its end\n  name a time from 0 to 1 s\ncarom: 1 error; nothing was run\n");

  for (const char* time : {"-1", "x", "inf", ""})
    EXPECT_EQ(here.carom({"render", "run", "--at", time}).code, 2) << time;
  EXPECT_EQ(here.carom({"render", "run", "--at", "0.5", "--only", "frames"}).code, 2);

  const Finished motion = here.carom({"render", "run", "--at", "0.5", "--set", "balls.red.mass=3"});
  EXPECT_EQ(motion.code, 2);
  EXPECT_NE(motion.err.find("changes the motion"), string::npos);
}

TEST(Render, OfSeveralRunsPutsEachIntoAFolderOfItsOwn) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + frames));
  here.carom({"run", "balls.yaml", "-o", "a/one"});
  here.carom({"run", "balls.yaml", "-o", "a/two", "--set", "balls.red.mass=3"});
  EXPECT_EQ(here.carom({"render", "a/one/", "a/two", "--only", "sheet", "-o", "b"}).code, 0);
  EXPECT_TRUE(here.has("b/one/sheet.png") && here.has("b/two/sheet.png"));
  EXPECT_FALSE(here.has("b/one/frames"));
  const Finished same = here.carom({"render", "a/one", "./a/one", "--set", "camera.eye.y=1"});
  EXPECT_EQ(same.code, 2);
}

TEST(Render, ThatIsInterruptedLeavesTheRunWhole) {
  const Workplace here;
  here.write("balls.yaml", two_balls(near_camera + frames));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Files before = here.files("run");

  for (const int signal : {SIGTERM, SIGKILL}) {
    const Finished render = here.interrupted({"render", "run", "--set", "output.frames.fps=90000", "--quiet"},
                                             "run/.frames.part/frame_00003.png", signal);
    EXPECT_EQ(render.code, signal == SIGTERM ? 143 : 1000 + SIGKILL) << render.err;
    Files after = here.files("run");
    std::erase_if(after, [](const auto& file) { return file.first.find(".part") != string::npos; });
    EXPECT_EQ(after, before);
    EXPECT_NE(here.carom({"run", "run/scene.yaml", "-o", "run"}).out.find("up to date"), string::npos);
  }

  // The next command clears up.
  EXPECT_EQ(here.carom({"render", "run", "--set", "output.frames.fps=3"}).code, 0);
  EXPECT_FALSE(here.has("run/.frames.part"));
}

// The record as another program reads it: 50 lines of Python.
TEST(Flights, AreReadByAnotherProgramToTheLastBit) {
  const Workplace here;
  for (const string scene : {"two_bowling_balls", "clay", "rolling_off", "gust", "slack_pendulum", "pockets"}) {
    const Finished run = here.carom({"run", SCENES_DIR "/" + scene + ".yaml", "-o", scene, "--only",
                                     "trajectory,flights", "--set", "output.trajectory.every=0.37"});
    ASSERT_EQ(run.code, 0) << run.err;

    std::istringstream table(here.read(scene + "/trajectory.csv"));
    map<string, size_t> number;  // of each body, all of which are there at time 0
    vector<double> message;      // six numbers a body
    string line, time;
    std::getline(table, line);

    while (std::getline(table, line)) {
      vector<string> cells;
      std::istringstream split(line);
      for (string cell; std::getline(split, cell, ',');) cells.push_back(cell);

      if (cells[0] != time) {
        time = cells[0];
        std::istringstream out(
            here.shell("/usr/bin/python3 " SOURCE_DIR "/tests/export/read_flights.py " + scene + "/flights.bin " + time)
                .out);
        message.clear();
        for (string word; out >> word;) message.push_back(std::stod(word));
      }

      const size_t body = number.emplace(cells[1], number.size()).first->second;
      ASSERT_LE(6 * body + 6, message.size()) << scene << ", " << line;
      for (size_t k = 0; k < 6; ++k) EXPECT_EQ(message[6 * body + k], std::stod(cells[2 + k])) << scene << ", " << line;
    }
  }
}

}  // namespace
}  // namespace carom::testing
