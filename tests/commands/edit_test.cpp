// The daily loop: a scene is edited and run again, by hand or by --watch.
#include <gtest/gtest.h>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

/// Two balls with so many pictures.
string balls_with_frames(int frames) {
  return two_balls("output: {energy: true, frames: {fps: " + to_string(frames - 1) + ", size: [32, 18]}}\n");
}

TEST(EditedScene, ReplacesItsRunWithoutForceAndLeavesNoStaleFile) {
  const Workplace here;
  here.write("balls.yaml", balls_with_frames(9));
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-q"}).code, 0);
  EXPECT_TRUE(here.has("output/balls/frames/frame_00008.png"));
  here.write("balls.yaml", balls_with_frames(3));
  const Finished check = here.carom({"check", "balls.yaml"});
  EXPECT_NE(check.out.find("holds a run of the scene as it was, will be replaced"), string::npos) << check.out;
  const Finished again = here.carom({"run", "balls.yaml", "-q"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(here.has("output/balls/frames/frame_00003.png"));
  here.carom({"run", "balls.yaml", "-q", "-o", "fresh"});
  EXPECT_EQ(without_manifest(here.files("output/balls")), without_manifest(here.files("fresh")));
}

TEST(EditedScene, StillReplacesItsRunWhenBothWereMoved) {
  const Workplace here;
  here.write("old/scenes/balls.yaml", two_balls());
  EXPECT_EQ(here.shell("cd old && \"$CAROM\" run scenes/balls.yaml -q && cd .. && mv old new").code, 0);
  here.write("new/scenes/balls.yaml", two_balls("seed: 1\n" + tables));
  const Finished moved = here.carom({"run", "new/scenes/balls.yaml", "-o", "new/output/balls", "-q"});
  EXPECT_EQ(moved.code, 0) << moved.err;
}

TEST(EditedScene, DoesNotReplaceTheRunOfAnotherSceneOrOfOtherSettings) {
  const Workplace here;
  here.write("a/balls.yaml", two_balls());
  here.write("b/balls.yaml", two_balls("seed: 1\n" + tables));
  here.carom({"run", "a/balls.yaml", "-q"});
  const auto before = here.files("output");
  EXPECT_EQ(here.carom({"run", "b/balls.yaml", "-q"}).code, 2);
  EXPECT_EQ(here.carom({"run", "a/balls.yaml", "--seed", "1", "-q"}).code, 2);
  EXPECT_EQ(here.carom({"run", "a/balls.yaml", "--set", "balls.red.mass=2", "-q"}).code, 2);
  EXPECT_EQ(here.carom({"run", "a/balls.yaml", "--only", "energy", "-q"}).code, 0) << "up to date";
  EXPECT_EQ(here.carom({"run", "a/balls.yaml", "--only", "sheet", "-q"}).code, 2) << "it would remove tables";
  EXPECT_EQ(here.files("output"), before);
}

TEST(EditedScene, LeavesTouchedAndForeignFilesAlone) {
  const auto refused = [](const string& change, const string& why) {
    const Workplace here;
    here.write("balls.yaml", balls_with_frames(3));
    here.carom({"run", "balls.yaml", "-q"});
    here.shell(change);
    here.write("balls.yaml", balls_with_frames(4));
    const auto before = here.files("output");

    const Finished run = here.carom({"run", "balls.yaml", "-q"});
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(run.err, "balls.yaml: the folder output/balls holds " + why +
                           "\n  write elsewhere with -o, or overwrite it with --force\n"
                           "carom: 1 error; nothing was run\n");
    EXPECT_EQ(here.files("output"), before);
  };

  refused("echo mine > output/balls/notes.txt", "notes.txt, which the run there did not write");
  refused("echo mine > output/balls/frames/a.png", "frames/a.png, which the run there did not write");
  refused("mkdir output/balls/older", "older, which the run there did not write");
  refused("echo >> output/balls/energy.csv", "a run of this scene with a changed file, energy.csv");
  refused("rm output/balls/frames/frame_00001.png", "a run of this scene that lacks a file, frames/frame_00001.png");
  refused("sed -i /path/d output/balls/manifest.json", "another run, or files that no run wrote");
  refused("rm output/balls/manifest.json", "another run, or files that no run wrote");
}

TEST(UneditedScene, LeavesTouchedFilesAlone) {
  const auto refused = [](const string& change, const string& why, const string& only = "") {
    const Workplace here;
    here.write("balls.yaml", balls_with_frames(3));
    vector<string> first = {"run", "balls.yaml", "-q"};
    if (!only.empty()) first.insert(first.end(), {"--only", only});
    here.carom(first);
    here.shell(change);
    const auto before = here.files("output");

    const Finished run = here.carom({"run", "balls.yaml", "-q"});
    EXPECT_EQ(run.code, 2) << change;
    EXPECT_EQ(run.err, "balls.yaml: the folder output/balls holds " + why +
                           "\n  write elsewhere with -o, or overwrite it with --force\n"
                           "carom: 1 error; nothing was run\n");
    EXPECT_EQ(here.files("output"), before) << change;
    // Long lines are wrapped.
    EXPECT_NE(here.carom({"check", "balls.yaml"}).out.find("holds " + why.substr(0, why.find_first_of(" ,"))),
              string::npos);
    EXPECT_EQ(here.carom({"run", "balls.yaml", "-q", "--force"}).code, 0) << change;
    EXPECT_EQ(here.carom({"run", "balls.yaml"}).out, "balls: Two balls\n  up to date  output/balls\n");
  };

  refused("echo '# mine' >> output/balls/energy.csv", "a run of this scene with a changed file, energy.csv");
  refused("echo >> output/balls/frames/frame_00001.png; rm output/balls/summary.csv",
          "a run of this scene with a changed file, frames/frame_00001.png");
  // More outputs than before do not overwrite a file that the run there did not write.
  refused("mkdir output/balls/frames; echo mine > output/balls/frames/frame_00001.png",
          "frames/frame_00001.png, which the run there did not write", "energy");
}

TEST(UneditedScene, BringsBackLostFilesBesideForeignOnes) {
  const Workplace here;
  here.write("balls.yaml", balls_with_frames(3));
  here.carom({"run", "balls.yaml", "-q"});
  const auto before = without_manifest(here.files("output/balls"));
  here.shell("rm output/balls/energy.csv output/balls/frames/frame_00001.png; echo mine > output/balls/notes.txt");
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-q"}).code, 0);
  EXPECT_EQ(here.read("output/balls/notes.txt"), "mine\n");
  here.shell("rm output/balls/notes.txt");
  EXPECT_EQ(without_manifest(here.files("output/balls")), before);
}

TEST(UneditedScene, PicturesThatWereChangedAreDrawnAgainOnlyByForce) {
  const Workplace here;
  here.write("balls.yaml", balls_with_frames(3));
  here.carom({"run", "balls.yaml", "-o", "run", "-q"});
  const string picture = here.read("run/frames/frame_00001.png");
  here.shell("echo mine >> run/frames/frame_00001.png");

  for (const vector<string>& words : {vector<string>{"render", "run", "-q"},
                                      vector<string>{"render", "run", "-q", "--set", "output.frames.samples=1"}}) {
    const Finished again = here.carom(words);
    EXPECT_EQ(again.code, 2) << again.err;
    EXPECT_NE(again.err.find("holds a run of this scene with a changed file, frames/frame_00001.png"), string::npos)
        << again.err;
    EXPECT_EQ(here.read("run/frames/frame_00001.png"), picture + "mine\n");
  }

  EXPECT_EQ(here.carom({"render", "run", "-q", "--force"}).code, 0);
  EXPECT_EQ(here.read("run/frames/frame_00001.png"), picture);

  here.shell("rm run/frames/frame_00001.png");
  EXPECT_EQ(here.carom({"render", "run", "-q"}).code, 0);
  EXPECT_EQ(here.read("run/frames/frame_00001.png"), picture);
}

TEST(UneditedSweep, LeavesTouchedFilesAlone) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const vector<string> words = {"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "sweep", "-q"};
  vector<string> forced = words;
  forced.emplace_back("--force");
  ASSERT_EQ(here.carom(words).code, 0);

  const pair<string, string> all[] = {
      {"sweep/summary.csv", "carom: balls.yaml: the folder sweep holds a comparison with a changed file, summary.csv"},
      {"sweep/comparison.xlsx",
       "carom: balls.yaml: the folder sweep holds a comparison with a changed file, comparison.xlsx"},
      {"sweep/runs/r0002/energy.csv",
       "carom: balls.yaml: the folder sweep/runs/r0002 holds a run of this scene with a changed file, energy.csv"}};

  for (const auto& [file, error] : all) {
    here.shell("echo mine >> " + file);
    const auto before = here.files("sweep");
    const Finished again = here.carom(words);
    EXPECT_EQ(again.code, 2) << file;
    EXPECT_EQ(again.err, error + "\n  write elsewhere with -o, or overwrite it with --force\n");
    EXPECT_EQ(here.files("sweep"), before) << file;
    EXPECT_EQ(here.carom(forced).code, 0) << file;
    here.shell("rm " + file);
    EXPECT_EQ(here.carom(words).code, 0) << "what is missing is done: " << file;
    EXPECT_TRUE(here.has(file));
  }

  // Gathering leaves it alone, too.
  here.shell("echo mine >> sweep/summary.csv");
  const Finished gathered = here.carom({"gather", "sweep", "-q"});
  EXPECT_EQ(gathered.code, 2);
  EXPECT_EQ(gathered.err,
            "carom: the folder sweep holds a comparison with a changed file, summary.csv: remove it or rename it; "
            "nothing was gathered\n");
}

TEST(UneditedSweep, IsLeftAloneInACopyToo) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "sweep", "-q"});
  // The runs are newer than the copy's manifest.
  here.shell("mkdir copy; cp sweep/*.* copy; cp -r sweep/runs copy; echo mine >> copy/runs/r0002/energy.csv");
  const auto before = here.files("copy");
  const string held = "copy/runs/r0002 holds a run of this scene with a changed file, energy.csv";

  const Finished again = here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "copy", "-q"});
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find(held), string::npos) << again.err;

  const Finished gathered = here.carom({"gather", "copy", "sweep", "-q"});
  EXPECT_EQ(gathered.code, 2);
  EXPECT_EQ(gathered.err, "carom: the folder " + held + ": remove it or rename it; nothing was gathered\n");
  EXPECT_EQ(here.files("copy"), before);
}

TEST(UneditedSweep, RepeatsAChangedRunBeforeItsEnd) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const vector<string> words = {"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "sweep", "-q"};
  ASSERT_EQ(here.carom(words).code, 0);
  const string energy = here.read("sweep/runs/r0002/energy.csv");
  here.shell("rm sweep/manifest.json; truncate -s 10 sweep/runs/r0002/energy.csv");
  EXPECT_EQ(here.carom(words).code, 0);
  EXPECT_EQ(here.read("sweep/runs/r0002/energy.csv"), energy);
}

TEST(UneditedComparison, LeavesTouchedFilesAlone) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "-o", "a", "-q"});
  here.carom({"run", "balls.yaml", "-o", "b", "-q", "--set", "balls.red.mass=2"});
  const vector<string> words = {"compare", "a", "b", "-o", "both", "-q"};
  ASSERT_EQ(here.carom(words).code, 0);
  const string table = here.read("both/summary.csv");
  here.shell("echo mine >> both/summary.csv");

  const Finished again = here.carom(words);
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.err,
            "carom: the folder both holds a comparison with a changed file, summary.csv\n"
            "  write elsewhere with -o, or overwrite it with --force\n");
  EXPECT_EQ(here.read("both/summary.csv"), table + "mine\n");

  here.shell("rm both/summary.csv");
  EXPECT_EQ(here.carom(words).code, 0);
  EXPECT_EQ(here.read("both/summary.csv"), table);
}

TEST(EditedScene, DoesNotReplaceARunOfASweep) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "sweep", "-q"});
  for (const string folder : {"sweep", "sweep/runs/r0001"})
    EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", folder, "-q"}).code, 2) << folder;
}

/// Starts a watch of a.yaml and b.yaml, does these steps, and ends it. `await FILE TEXT` waits until FILE has TEXT.
Finished watched(const Workplace& here, const string& steps) {
  return here.shell(
      "await() { n=0; until grep -qs -- \"$2\" \"$1\"; do sleep 0.02; n=$((n + 1)); [ $n -lt 500 ] || exit 9; done; }\n"
      "\"$CAROM\" run --watch a.yaml b.yaml --progress none >out 2>err & p=$!\n" +
      steps + "\nkill -TERM $p; wait $p; code=$?; cat out; cat err >&2; exit $code");
}

TEST(Watch, RunsAtEachSaveHoweverItIsDone) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("b.yaml", two_balls());

  const Finished run = watched(
      here,
      "await err waiting\n"
      "sed 's/duration: 1/duration: 0.25/' a.yaml > .tmp; mv .tmp a.yaml; await output/a/summary.csv exact,done,0.25,\n"
      "sed 's/duration: 0.25/duration: 0.5/' a.yaml > .tmp; cat .tmp > a.yaml; await output/a/summary.csv done,0.5,");
  EXPECT_EQ(run.code, 143) << run.err;
  EXPECT_NE(run.err.find("carom: waiting for changes of a.yaml and b.yaml; Ctrl-C ends\n"), string::npos);
  EXPECT_TRUE(run.err.ends_with("carom: interrupted\n")) << run.err;
  // b.yaml was not saved.
  EXPECT_EQ(run.out.find("\nb: "), run.out.rfind("\nb: ")) << run.out;
}

TEST(Watch, ShowsErrorsAndGoesOn) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("b.yaml", two_balls());
  const Finished run =
      watched(here,
              "await err waiting\n"
              "cp a.yaml good; echo 'camra: 1' >> a.yaml; await err 'not run'\n"
              "sed 's/duration: 1/duration: 0.25/' good > a.yaml; await output/a/summary.csv done,0.25,");
  EXPECT_EQ(run.code, 143) << run.err;
  EXPECT_NE(run.err.find("did you mean `camera`?\ncarom: a.yaml: 1 error; not run\n"), string::npos) << run.err;
}

TEST(Watch, FollowsMeshesAndTheirMaterials) {
  const Workplace here;
  here.write("m/pin.obj",
             "mtllib pin.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  here.write("m/pin.mtl", "newmtl a\nKd 1 0 0\n");
  here.write("a.yaml",
             "scene: 1\nbodies: {pin: {mass: 1, mesh: m/pin.obj, fit: sphere, position: [0, 0, 0]}}\n"
             "simulate: {duration: 0.1}\noutput: {frames: {fps: 10, size: [32, 18]}}\n");
  here.write("b.yaml", two_balls());

  // The files of a run are absent for a moment while it is replaced, and cmp then gives 2.
  const Finished run =
      watched(here,
              "differs() { n=0; until cmp -s \"$1\" \"$2\"; [ $? -eq 1 ]; do n=$((n + 1)); [ $n -lt 500 ] || exit 9; "
              "sleep 0.02; done; }\n"
              "await err waiting; cp -r output/a before\n"
              "echo 'newmtl a\nKd 0 1 0' > m/new; mv m/new m/pin.mtl\n"
              "differs output/a/manifest.json before/manifest.json; cp -r output/a green\n"
              "sed -i 's/v 1 0 0/v 2 0 0/' m/pin.obj\n"
              "differs output/a/manifest.json green/manifest.json");

  EXPECT_EQ(run.code, 143) << run.err << run.out;
  const string frame = "/frames/frame_00000.png";
  EXPECT_FALSE(here.read("green" + frame).empty());
  EXPECT_NE(here.read("before" + frame), here.read("green" + frame));
  EXPECT_NE(here.read("output/a" + frame), here.read("green" + frame));
}

TEST(Watch, FollowsTheTableOfAGroupAlsoAfterAnError) {
  const Workplace here;
  here.write("heap.csv", "x_m,y_m,z_m\n0,0,0\n");
  here.write("a.yaml",
             "scene: 1\ngroups: {g: {table: heap.csv, ball: {mass: 1, radius: 0.1}}}\nsimulate: {duration: 0.1}\n");
  here.write("b.yaml", two_balls());

  const Finished run = watched(here,
                               "await err waiting\n"
                               "printf 'x_m,y_m,z_m\\n0,0,z\\n' > new; mv new heap.csv; await err '1 error; not run'\n"
                               "printf 'x_m,y_m,z_m\\n0,7,0\\n' > new; mv new heap.csv\n"
                               "await output/a/trajectory.csv 0,g.0,0,7,0");
  EXPECT_EQ(run.code, 143) << run.err << run.out;
  EXPECT_NE(run.err.find("heap.csv:2:5: error: `z` is not a number in the column `z_m`\n"), string::npos) << run.err;
}

TEST(Run, OfATableIsUpToDateUntilItsNumbersChangeAndSaysHowFarItPushed) {
  const Workplace here;
  here.write("a.yaml",
             "scene: 1\ngroups: {g: {table: heap.csv, overlap: push, ball: {mass: 1, radius: 1}}}\n"
             "simulate: {duration: 0.1}\n");
  here.write("heap.csv", "x_m,y_m,z_m,note\n0,0,0,a\n1.9998,0,0,b\n");
  const Finished first = here.carom({"run", "a.yaml"});
  EXPECT_NE(first.err.find("carom: a.yaml: overlap: push moved 2 balls of g, the furthest by 0.000101 m: g."),
            string::npos)
      << first.err;

  // Another note changes no number.
  here.write("heap.csv", "x_m,y_m,z_m,note\n0,0,0,c\n1.9998,0,0,b\n");
  EXPECT_NE(here.carom({"run", "a.yaml"}).out.find("up to date"), string::npos);
  here.write("heap.csv", "x_m,y_m,z_m\n0,0,0\n3,0,0\n");
  EXPECT_EQ(here.carom({"run", "a.yaml"}).out.find("up to date"), string::npos);
  EXPECT_NE(here.read("output/a/trajectory.csv").find("0,g.1,3,0,0"), string::npos);

  // The folder's scene runs without the table.
  EXPECT_EQ(here.carom({"run", "output/a/scene.yaml", "-o", "again"}).code, 0);
  EXPECT_EQ(here.read("again/trajectory.csv"), here.read("output/a/trajectory.csv"));
}

TEST(Watch, OfARunThatIsDoneShowsATextureThatGoesMissing) {
  const Workplace here;
  here.write("pin.obj",
             "mtllib pin.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  here.write("pin.mtl", "newmtl a\nKd 1 0 0\n");
  here.write("a.yaml",
             "scene: 1\nbodies: {pin: {mass: 1, mesh: pin.obj, fit: sphere, position: [0, 0, 0]}}\n"
             "simulate: {duration: 0.1}\noutput: {frames: {fps: 10, size: [32, 18]}}\n");
  here.write("b.yaml", two_balls());

  const Finished run = watched(here,
                               "await err waiting; cp -r output/a before\n"
                               "echo 'newmtl a\nmap_Kd none.png' > new; mv new pin.mtl; await err '1 error; not run'");
  EXPECT_EQ(run.code, 143) << run.err << run.out;
  EXPECT_NE(run.err.find("a.yaml:2:31: error: cannot read the mesh pin.obj: its texture none.png is not there\n"),
            string::npos)
      << run.err;
  EXPECT_EQ(here.files("output/a"), here.files("before"));
}

TEST(Watch, HasNoJsonDocument) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Finished run = here.carom({"run", "--watch", "a.yaml", "--json"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("leave out --json"), string::npos) << run.err;
}

TEST(Progress, OfScenesThatRunAtOnceBeginsBeforeOneEnds) {
  const Workplace here;
  string text = two_balls("output: {frames: {fps: 1, size: [64, 36], samples: 1}}\n");
  text.replace(text.find("duration: 1}"), 12, "duration: 99990}");
  for (const char* name : {"a.yaml", "b.yaml"}) here.write(name, text);
  const Finished run = here.shell(
      "\"$CAROM\" run a.yaml b.yaml -j 2 --progress lines 2>err & p=$!\n"
      "n=0; until grep -qs 'run: [0-9]* %, 0 of 2 scenes' err || [ $n -gt 500 ]; do n=$((n+1)); sleep 0.02; done\n"
      "kill -TERM $p; wait $p; cat err >&2");
  EXPECT_NE(run.err.find(" %, 0 of 2 scenes"), string::npos) << run.err;
}

}  // namespace
}  // namespace carom::testing
