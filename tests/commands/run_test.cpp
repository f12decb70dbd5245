// carom run, by the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "scene/scene.h"
#include "std.h"
#include "version.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

const string small_pictures = "output: {frames: {fps: 4, size: [64, 36], samples: 1}}\n";

TEST(Run, WritesTheRequestedTablesAndPrintsTheirFolder) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run = here.carom({"run", "balls.yaml"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.err, "");

  const size_t residual = run.out.find(", residual "), next = run.out.find("\n  overlap");  // rounding, not quoted
  ASSERT_LT(residual, next) << run.out;
  const string until_time = run.out.substr(0, residual) + run.out.substr(next, run.out.find("  time ") - next);
  // They touch when their centres are 0.22 m apart: after 1.78 m at 4 m/s. Of 40 J, 1 - 0.9^2 is lost.
  EXPECT_EQ(until_time,
            "balls: Two balls\n"
            "  engine      exact (auto: every path of this scene has a closed form)\n"
            "  collisions  1 (1 body-body, 0 body-fixed), at 0.445 s\n"
            "  contact     0 of 2 bodies in lasting contact at the end\n"
            "  energy      7.6 J lost, 40 J -> 32.4 J\n"
            "  overlap     none\n"
            "  wrote       output/balls: collisions.csv, energy.csv, manifest.json, scene.yaml, summary.csv and\n"
            "              trajectory.csv\n");

  for (const string name :
       {"summary.csv", "trajectory.csv", "collisions.csv", "energy.csv", "manifest.json", "scene.yaml"}) {
    EXPECT_TRUE(here.has("output/balls/" + name)) << name;
  }
  EXPECT_EQ(here.files("output/balls").size(), 6u);
}

TEST(Run, SecondRunIsUpToDateAndTouchesNothing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml"});
  const auto before = here.files("output");
  const Finished again = here.carom({"run", "balls.yaml"});
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.err, "");
  EXPECT_EQ(again.out,
            "balls: Two balls\n"
            "  up to date  output/balls\n");
  EXPECT_EQ(here.files("output"), before);
}

TEST(Run, ForceRunsAgainWithTheSameBytes) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml"});
  auto before = here.files("output/balls");
  const Finished again = here.carom({"run", "balls.yaml", "--force"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("  wrote       output/balls: "), string::npos) << again.out;
  auto after = here.files("output/balls");
  before.erase("manifest.json");  // it has wall times
  after.erase("manifest.json");
  EXPECT_EQ(after, before);
}

TEST(Run, FolderOfAnotherRunIsRefusedWithoutForce) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml"});
  const auto before = here.files("output");

  const Finished other = here.carom({"run", "balls.yaml", "--set", "balls.red.mass=11"});
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.out, "");
  EXPECT_EQ(other.err,
            "balls.yaml: the folder output/balls holds another run, or files that no run wrote\n"
            "  write elsewhere with -o, or overwrite it with --force\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_EQ(here.files("output"), before);

  EXPECT_EQ(here.carom({"run", "balls.yaml", "--set", "balls.red.mass=11", "--force"}).code, 0);
  EXPECT_NE(here.read("output/balls/scene.yaml").find("red: {mass: 11,"), string::npos);
}

TEST(Run, FilesThatNoRunWroteAreNeverOverwrittenUnasked) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("notes/mine.txt", "do not lose this");
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "notes"}).code, 2);
  EXPECT_EQ(here.files("notes").size(), 1u);
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "notes", "--force"}).code, 0);
  EXPECT_EQ(here.read("notes/mine.txt"), "do not lose this");
}

TEST(Run, FileInPlaceOfTheFolderIsRefused) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run = here.carom({"run", "balls.yaml", "-o", "balls.yaml", "--force"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, "balls.yaml: balls.yaml is not a folder\ncarom: 1 error; nothing was run\n");
  EXPECT_EQ(here.read("balls.yaml"), two_balls());
}

TEST(Run, AllScenesAreCheckedBeforeTheFirstIsRun) {
  const Workplace here;
  here.write("right.yaml", two_balls());
  here.write("wrong.yaml", two_balls("outptu: {}\n"));
  const Finished run = here.carom({"run", "right.yaml", "wrong.yaml", "missing.yaml"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("wrong.yaml:8:1: error: ")) << run.err;
  EXPECT_NE(run.err.find("output"), string::npos) << run.err;
  EXPECT_NE(run.err.find("missing.yaml: error: "), string::npos) << run.err;
  EXPECT_TRUE(run.err.ends_with("carom: 2 errors in 2 of 3 scenes; nothing was run\n")) << run.err;
  EXPECT_FALSE(here.has("output"));
}

TEST(Run, SeveralScenesGetAFolderEachAndATotal) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("b.yaml", two_balls());
  here.carom({"run", "a.yaml", "-o", "all/a"});
  const Finished run = here.carom({"run", "a.yaml", "b.yaml", "-o", "all"});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("a: Two balls\n  up to date  all/a\nb: Two balls\n  engine "), string::npos) << run.out;
  EXPECT_NE(run.out.find("\n2 scenes: 1 done, 1 up to date, in "), string::npos) << run.out;
  EXPECT_TRUE(here.has("all/a/manifest.json") && here.has("all/b/manifest.json"));
}

TEST(Run, ResolvedSceneRunsToTheSameBytes) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "--set", "balls.red.mass=11", "-o", "first"});
  EXPECT_EQ(here.carom({"run", "first/scene.yaml", "-o", "second"}).code, 0);
  auto first = here.files("first"), second = here.files("second");
  first.erase("manifest.json");
  second.erase("manifest.json");
  EXPECT_EQ(first.size(), 5u);
  EXPECT_EQ(first, second);
}

TEST(Run, MoreOutputTimesDoNotChangeACollision) {
  const Workplace here;
  const string gas =
      "scene: 1\n"
      "groups:\n"
      "  gas: {count: 30, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 0], max: [2, 2, 2]}, arrange: random, speed: "
      "1}\n"
      "room: {min: [0, 0, 0], max: [2, 2, 2]}\n"
      "simulate: {duration: 5}\n";

  here.write("few.yaml", gas + "output: {collisions: true}\n");
  here.write("many.yaml", gas + "output: {collisions: true, trajectory: {every: 0.001}, energy: {every: 0.0007}}\n");
  const Finished run = here.carom({"run", "few.yaml", "many.yaml"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_GT(here.read("output/few/collisions.csv").size(), 10'000u);
  EXPECT_EQ(here.read("output/few/collisions.csv"), here.read("output/many/collisions.csv"));
}

TEST(Run, OnlyRestrictsAndAddsOutputs) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  EXPECT_EQ(here.carom({"run", "balls.yaml", "--only", "energy"}).code, 0);
  EXPECT_EQ(here.files("output/balls").size(), 4u);
  EXPECT_TRUE(here.has("output/balls/energy.csv"));

  // The same scene's other outputs would remove these: only with --force, and the folder then holds only the others.
  const Finished others = here.carom({"run", "balls.yaml", "--only", "collisions,trajectory"});
  EXPECT_EQ(others.code, 2);
  EXPECT_EQ(others.err,
            "balls.yaml: the folder output/balls holds more outputs of this scene, which this run would remove\n"
            "  write elsewhere with -o, or overwrite it with --force\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_TRUE(here.has("output/balls/energy.csv"));
  EXPECT_EQ(here.carom({"run", "balls.yaml", "--only", "collisions,trajectory", "--force"}).code, 0);
  EXPECT_EQ(here.files("output/balls").size(), 5u);
  EXPECT_FALSE(here.has("output/balls/energy.csv"));

  // A run that writes these and more needs no --force. A whole run is up to date for any part of it.
  EXPECT_EQ(here.carom({"run", "balls.yaml"}).code, 0);
  EXPECT_EQ(here.carom({"run", "balls.yaml", "--only", "energy"}).out,
            "balls: Two balls\n  up to date  output/balls\n");

  // An output that the scene lacks has default settings.
  here.write("none.yaml", two_balls("output: {collisions: true}\n"));
  EXPECT_EQ(here.carom({"run", "none.yaml", "--only", "trajectory"}).code, 0);

  const string trajectory = here.read("output/none/trajectory.csv");
  EXPECT_EQ(ranges::count(trajectory, '\n'),
            1 + 31 * 2);  // every 1/30 s over 1 s, ends included
  EXPECT_FALSE(here.has("output/none/collisions.csv"));
}

/// The sizes of all pictures of a run, as ffprobe prints them, each once.
string sizes(const Workplace& here, const string& pattern) {
  return here
      .shell("for p in " + pattern +
             "; do ffprobe -v error -show_entries stream=width,height -of csv=p=0 $p; done | sort -u")
      .out;
}

TEST(Run, PicturesThatTheSceneLacksLookLikeTheFilmWhateverElseIsSet) {
  const Workplace here;
  here.write("film.yaml", two_balls("output: {video: {fps: 20, size: [64, 64], samples: 1}}\n"));
  const auto frames = [&](const string& folder) { return here.files(folder + "/frames").size(); };
  ASSERT_EQ(here.carom({"run", "film.yaml", "--only", "frames", "-o", "plain"}).code, 0);
  EXPECT_EQ(frames("plain"), 21u);
  EXPECT_EQ(sizes(here, "plain/frames/*"), "64,64\n");

  // From a later time.
  ASSERT_EQ(here.carom({"run", "film.yaml", "--only", "frames", "-o", "late", "--set", "output.frames.from=0.5"}).code,
            0);
  EXPECT_EQ(frames("late"), 11u);
  EXPECT_EQ(sizes(here, "late/frames/*"), "64,64\n");
  EXPECT_EQ(here.read("late/frames/frame_00015.png"), here.read("plain/frames/frame_00015.png"));

  ASSERT_EQ(here.carom({"run", "film.yaml", "--only", "sheet", "-o", "sheet"}).code, 0);
  // Four columns and three rows of 470 pixels each, and gaps of 8.
  EXPECT_EQ(sizes(here, "sheet/sheet.png"), "1920,1442\n") << "square pictures, as those of the film";

  // In the shape of the film.
  const Finished flat =
      here.carom({"run", "film.yaml", "--only", "sheet", "-o", "flat", "--set", "output.video.size=[64, 32]"});
  EXPECT_EQ(flat.code, 0);
  EXPECT_EQ(flat.err.find("changes nothing"), string::npos) << flat.err;
  EXPECT_EQ(sizes(here, "flat/sheet.png"), "1920,737\n");
}

TEST(Run, JobsChangeNoResult) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "one"}).code, 0);
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "four", "-j", "4"}).code, 0);
  auto one = here.files("one"), four = here.files("four");
  one.erase("manifest.json");
  four.erase("manifest.json");
  EXPECT_EQ(one, four);
  EXPECT_EQ(
      here.carom({"run", "balls.yaml", "--jobs", "0"}).err,
      "carom run: --jobs takes a whole number from 1 to 4096, not `0`\n  carom run --help shows how it is used\n");
}

TEST(Run, ScenesAtOnceAreReportedInTheirOrderAndHaveTheSameBytes) {
  const Workplace here;
  string busy = two_balls("room: {min: [-1.2, -1, -1], max: [1.2, 1, 1]}\n");
  busy.replace(busy.find("duration: 1}"), 12, "duration: 9, max_collisions: 1}");
  here.write("slow.yaml",
             two_balls("output: {frames: {fps: 100, size: [64, 36], samples: 1}, energy: {every: 0.1}}\n"));
  here.write("fails.yaml", busy);
  here.write("quick.yaml", two_balls());
  here.write("there.yaml", two_balls());

  const auto run = [&](const string& jobs) {
    here.carom({"run", "there.yaml", "-o", jobs + "/there"});
    const Finished all =
        here.carom({"run", "slow.yaml", "fails.yaml", "quick.yaml", "there.yaml", "-j", jobs, "-o", jobs, "--json"});
    EXPECT_EQ(all.code, 1);
    EXPECT_TRUE(all.err.starts_with("carom: fails.yaml: the run failed: more than simulate.max_collisions = 1"))
        << all.err;

    Json scenes = Json::parse(all.out)["scenes"];
    for (Json& scene : scenes) {
      scene.erase("time");
      scene.erase("folder");
    }
    return scenes;
  };

  const Json one = run("1"), three = run("3");
  EXPECT_EQ(one, three);
  ASSERT_EQ(one.size(), 4u);
  EXPECT_EQ(one[0]["status"], "done");
  EXPECT_EQ(one[1]["status"], "failed");
  EXPECT_EQ(one[3]["status"], "up to date");

  // With the same files.
  map<string, string> files[2] = {here.files("1"), here.files("3")};
  for (auto& some : files) std::erase_if(some, [](const auto& file) { return file.first.ends_with("manifest.json"); });
  EXPECT_GT(files[0].size(), 110u);
  EXPECT_EQ(files[0], files[1]);

  const Finished text = here.carom({"run", "quick.yaml", "slow.yaml", "there.yaml", "-j", "2", "-o", "2"});
  const size_t quick = text.out.find("quick: "), slow = text.out.find("slow: "), last = text.out.find("there: ");
  EXPECT_LT(quick, slow);
  EXPECT_LT(slow, last);
  EXPECT_NE(text.out.find("3 scenes: 3 done, in "), string::npos) << text.out;
}

/// A tetrahedron about a radius of a metre, as STL.
const string tetrahedron =
    "solid t\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex -1 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex -1 0 -1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex -1 0 1\nvertex -1 0 -1\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 1 0\nvertex -1 0 1\nvertex -1 0 -1\nendloop\nendfacet\n"
    "endsolid t\n";

TEST(Run, OfASceneWithAMeshCanBeRepeatedFromItsFolderAlone) {
  const Workplace here;
  here.write("scenes/meshes/t.stl", tetrahedron);
  here.write("scenes/fall.yaml",
             "scene: 1\n"
             "bodies: {t: {mass: 1, mesh: meshes/t.stl, fit: box, position: [0, 2, 0]}}\n"
             "simulate: {duration: 0.1}\n");

  EXPECT_EQ(here.carom({"run", "scenes/fall.yaml", "-o", "deep/er/first"}).err, "");
  EXPECT_EQ(here.read("deep/er/first/t.stl"), tetrahedron);
  EXPECT_EQ(here.shell("mv deep/er/first moved && rm -r scenes deep && $CAROM run moved/scene.yaml -o again").err, "");

  // All but the manifests is the same.
  auto first = here.files("moved"), again = here.files("again");
  first.erase("manifest.json");
  again.erase("manifest.json");
  EXPECT_EQ(first.size(), 6u);
  EXPECT_EQ(first, again);
}

TEST(Run, ScenesWithATornMeshAreWrong) {
  const Workplace here;
  here.write("t.stl", "no triangles here");
  here.write("fall.yaml",
             "scene: 1\n"
             "bodies: {t: {mass: 1, mesh: t.stl, fit: box, position: [0, 2, 0]}}\n"
             "simulate: {duration: 0.1}\n");

  const Finished run = here.carom({"run", "fall.yaml"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(
      run.err,
      "fall.yaml:2:29: error: the mesh `t.stl` cannot be used: cannot read the mesh t.stl: line 1: `no` is no word "
      "of an STL file\n"
      "   2 | bodies: {t: {mass: 1, mesh: t.stl, fit: box, position: [0, 2, 0]}}\n"
      "     |                             ^~~~~\n"
      "     = export it again\n"
      "carom: 1 error; nothing was run\n");
}

TEST(Run, OnlyIsHeldToTheBudgetByWhatItLeaves) {
  const Workplace here;
  here.write("long.yaml", two_balls("output: {frames: {fps: 1000000, size: [64, 36]}, collisions: true}\n"));
  EXPECT_EQ(here.carom({"check", "long.yaml"}).code, 2);
  EXPECT_EQ(here.carom({"run", "long.yaml", "--only", "collisions"}).code, 0);

  here.write("short.yaml", two_balls("output: {collisions: true}\n"));
  const Finished run = here.carom({"run", "short.yaml", "--set", "simulate.duration=100000", "--only", "frames"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(
      run.err,
      "short.yaml: --only requests 3,000,001 pictures, more than the 100,000 that a run may draw without --force\n"
      "carom: 1 error; nothing was run\n");
}

TEST(Run, SetAndSeedChangeTheScene) {
  const Workplace here;
  const string gas =
      "scene: 1\n"
      "groups:\n"
      "  gas: {count: 5, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 0], max: [2, 2, 2]}, arrange: random, speed: "
      "1}\n"
      "simulate: {duration: 1}\n";

  here.write("gas.yaml", gas);
  EXPECT_EQ(here.carom({"run", "gas.yaml", "-o", "zero"}).code, 0);
  EXPECT_EQ(here.carom({"run", "gas.yaml", "-o", "seven", "--seed", "7"}).code, 0);
  EXPECT_EQ(here.carom({"run", "gas.yaml", "-o", "set", "--set", "seed=7"}).code, 0);
  EXPECT_NE(here.read("zero/trajectory.csv"), here.read("seven/trajectory.csv"));
  EXPECT_EQ(here.read("seven/trajectory.csv"), here.read("set/trajectory.csv"));
  EXPECT_EQ(here.carom({"run", "gas.yaml", "-o", "bad", "--set", "groups.gas.cuont=6"}).code, 2);
  EXPECT_FALSE(here.has("bad"));
}

TEST(Run, ASettingThatChangesNothingOfWhatIsWrittenIsSaid) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {energy: true, frames: {fps: 2, size: [64, 36]}, video: true}\n"));
  const auto errors = [&](const string& only, const string& setting, bool quiet = false) {
    vector<string> line = {"run", "balls.yaml", "--only", only, "--set", setting, "--force"};
    if (quiet) line.emplace_back("-q");
    const Finished run = here.carom(line);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  };

  EXPECT_EQ(errors("video", "output.frames.from=0.5"),
            "carom: balls.yaml: --set output.frames.from=0.5 changes nothing: the output `frames` is not written\n");
  EXPECT_EQ(errors("video", "output.frames.from=0.5", true), "");
  // The video takes the rate of frames.
  EXPECT_EQ(errors("video", "output.frames.fps=4"), "");
  EXPECT_EQ(errors("frames", "output.frames.from=0.5"), "");
  EXPECT_EQ(errors("energy", "background=black"),
            "carom: balls.yaml: --set background=black changes nothing: no output is drawn\n");
  EXPECT_EQ(errors("energy", "balls.red.color=blue"),
            "carom: balls.yaml: --set balls.red.color=blue changes nothing: no output is drawn\n");
  EXPECT_EQ(errors("energy", "balls.red.restitution=0.5"), "");
  EXPECT_EQ(errors("frames", "balls.red.color=blue"), "");

  const string mesh = SCENES_DIR "/meshes/duck.obj";
  for (const string& drawn :
       {string("trails={seconds: 0.5}"), string("caption=true"), string("flash=true"), string("arrows=[velocity]"),
        string("shutter=0.5"), string("balls.red.color={by: speed}"), string("camera={fit: motion}"),
        string("lights={ambient: dimgray}"), "balls.red.mesh=" + mesh}) {
    EXPECT_EQ(errors("energy", drawn), "carom: balls.yaml: --set " + drawn + " changes nothing: no output is drawn\n");
    EXPECT_EQ(errors("frames", drawn), "");
  }
}

TEST(Run, ASettingOfAMeshThatIsTheBodysVolumeChangesTheMotion) {
  const Workplace here;
  here.write("duck.yaml",
             "scene: 1\n"
             "bodies: {duck: {mass: 1, mesh: " SCENES_DIR
             "/meshes/duck.obj, fit: box, position: [0, 1, 0]}}\n"
             "planes: {visible: {point: [0, -9, 0], normal: [0, 1, 0]}}\n"
             "simulate: {duration: 0.1}\noutput: {energy: true}\n");

  const auto errors = [&](const string& setting) {
    const Finished run = here.carom({"run", "duck.yaml", "--force", "--set", setting});
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  };

  EXPECT_EQ(errors("bodies.duck.mesh=" SCENES_DIR "/meshes/pin.obj"), "");
  // A thing with the name of a key is no key.
  EXPECT_EQ(errors("planes.visible.restitution=0.5"), "");
  EXPECT_EQ(errors("planes.visible.visible=false"),
            "carom: duck.yaml: --set planes.visible.visible=false changes nothing: no output is drawn\n");
}

TEST(Run, JsonIsOneDocumentWithTheSummarysFields) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("b.yaml", two_balls());
  here.carom({"run", "b.yaml"});

  const Finished run = here.carom({"run", "a.yaml", "b.yaml", "--json"});
  EXPECT_EQ(run.code, 0);
  const Json document = Json::parse(run.out);
  EXPECT_EQ(document.at("carom"), program_version);

  const Json& a = document.at("scenes").at(0);
  EXPECT_EQ(a.at("status"), "done");
  EXPECT_EQ(a.at("scene"), "a.yaml");
  EXPECT_EQ(a.at("folder"), "output/a");
  EXPECT_EQ(a.at("files"),
            (Json{"collisions.csv", "energy.csv", "manifest.json", "scene.yaml", "summary.csv", "trajectory.csv"}));
  EXPECT_EQ(a.at("summary").at("collisions"), 1);
  EXPECT_EQ(a.at("summary").at("title"), "Two balls");
  EXPECT_NEAR(a.at("summary").at("energy_lost_J").get<double>(), 7.6, 1e-14);
  EXPECT_GE(a.at("time").at("wall_s").get<double>(), 0);

  // Every column of summary.csv but the run's number, which a run by itself does not have.
  const string summary = here.read("output/a/summary.csv");
  string columns = "run";
  const auto ordered = nlohmann::ordered_json::parse(run.out).at("scenes").at(0).at("summary");
  for (const auto& item : ordered.items()) columns += "," + item.key();
  EXPECT_EQ(columns, summary.substr(0, summary.find('\n')));
  EXPECT_EQ(document.at("scenes").at(1).at("status"), "up to date");
  EXPECT_FALSE(document.at("scenes").at(1).contains("summary"));
}

TEST(Run, JsonOfWrongScenesIsADocumentToo) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Finished run = here.carom({"run", "a.yaml", "missing.yaml", "--json", "--color", "always"});
  EXPECT_EQ(run.code, 2);
  const Json scenes = Json::parse(run.out).at("scenes");
  EXPECT_EQ(scenes.at(0).at("status"), "not run");
  EXPECT_EQ(scenes.at(1).at("status"), "wrong");
  EXPECT_EQ(scenes.at(1).at("errors").at(0).at("file"), "missing.yaml");
  EXPECT_EQ(run.out.find("\\u001b"), string::npos);
}

TEST(Run, NoCollisionLeavesTheTimesNullAndTheCellsEmpty) {
  const Workplace here;
  here.write("apart.yaml", two_balls());
  const Finished run = here.carom({"run", "apart.yaml", "--set", "simulate.duration=0.1", "--json"});
  const Json summary = Json::parse(run.out).at("scenes").at(0).at("summary");
  EXPECT_EQ(summary.at("first_collision_s"), nullptr);
  EXPECT_EQ(summary.at("collisions"), 0);
  EXPECT_NE(here.read("output/apart/summary.csv").find(",exact,done,0.1,2,0,0,0,,,"), string::npos);
}

TEST(Run, ImpulsesBelongToTheStartAndAreNoDrift) {
  const Workplace here;
  here.write("push.yaml",
             "scene: 1\ngravity: [0, 0, 0]\n"
             "balls: {one: {mass: 2, radius: 0.1, position: [0, 0, 0], velocity: [1, 0, 0], impulse: [4, 0, 0]}}\n"
             "simulate: {duration: 1}\n");
  const Json summary = Json::parse(here.carom({"run", "push.yaml", "--json"}).out).at("scenes").at(0).at("summary");
  EXPECT_EQ(summary.at("energy_start_J"), 9);  // 2 kg at 3 m/s
  EXPECT_EQ(summary.at("energy_end_J"), 9);
  EXPECT_EQ(summary.at("work_J"), 0);
  EXPECT_EQ(summary.at("energy_residual_J"), 0);
  EXPECT_EQ(summary.at("momentum_drift_kg_m_per_s"), 0);
}

TEST(Run, QuietPrintsNothing) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("b.yaml", two_balls());
  const Finished run = here.carom({"run", "a.yaml", "b.yaml", "-q"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out + run.err, "");
}

TEST(Run, LimitOnCollisionsEndsTheRunWithAnErrorAndNoFiles) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Finished run =
      here.carom({"run", "a.yaml", "--set", "balls.blue.velocity.x=-1", "--set", "simulate.max_collisions=1", "--set",
                  "room={min: [-2, -2, -2], max: [2, 2, 2]}", "--set", "simulate.duration=100"});
  EXPECT_EQ(run.code, 1) << run.out << run.err;
  EXPECT_TRUE(run.err.starts_with("carom: a.yaml: the run failed: ")) << run.err;
  EXPECT_TRUE(here.files("output").empty());
  EXPECT_FALSE(here.has("output/a"));
}

TEST(Run, FailedRunDoesNotStopTheNext) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("b.yaml", two_balls());
  here.write("taken/a/manifest.json/x", "");  // a folder in the place of a file
  const Finished run = here.carom({"run", "a.yaml", "b.yaml", "-o", "taken", "--force"});
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.out.find("2 scenes: 1 done, 1 failed, in "), string::npos) << run.out;
  EXPECT_TRUE(here.has("taken/b/manifest.json"));
}

// OSMesa is loaded for the first mesh of a picture. Its library and its context cost memory.
TEST(Run, NoMeshInAPictureNoOpenGl) {
  const Workplace here;
  here.write("balls.yaml", two_balls(small_pictures));
  string meshes = two_balls(small_pictures);
  meshes.replace(meshes.find("radius:"), 0, "mesh: " SCENES_DIR "/meshes/duck.obj, ");
  here.write("seen.yaml", meshes);
  const auto peak = [&](const string& scene) {
    const Finished run = here.carom({"run", scene, "--json"});
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out).at("scenes").at(0).at("time").at("peak_memory_bytes").get<double>();
  };
  const double without = peak("balls.yaml"), with = peak("seen.yaml");
  EXPECT_GT(with, without + 10e6) << without << " bytes without meshes, " << with << " with";
}

TEST(Run, PicturesAreNumberedAndCounted) {
  const Workplace here;
  here.write("seen.yaml", two_balls(small_pictures));
  const Finished run = here.carom({"run", "seen.yaml", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json scene = Json::parse(run.out).at("scenes").at(0);
  EXPECT_EQ(scene.at("summary").at("frames"), 5);  // 0, 1/4 ... 1 s
  EXPECT_EQ(scene.at("files").at(0), "flights.bin");
  EXPECT_EQ(scene.at("files").at(1), "frames/frame_00000.png");
  EXPECT_TRUE(here.has("output/seen/frames/frame_00004.png"));
  EXPECT_FALSE(here.has("output/seen/trajectory.csv"));
}

}  // namespace
}  // namespace carom::testing
