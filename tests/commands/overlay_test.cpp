// What pictures show besides bodies, by the real program: rendering again, sweeps, and what is refused.
#include <gtest/gtest.h>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

using Files = map<string, string>;
using Words = vector<string>;

const string small_frames =
    "camera: {eye: [0, 0.5, -3], target: [0, 0, 0]}\n"
    "output: {frames: {fps: 4, size: [96, 54], samples: 1}}\n";

Files frames_of(const Workplace& here, const string& folder) {
  Files frames;
  for (const auto& [name, bytes] : here.files(folder))
    if (name.find("frame_") != string::npos) frames[name.substr(name.rfind('/') + 1)] = bytes;
  return frames;
}

TEST(Overlay, RenderedFromFlightsHasTheBytesOfTheRun) {
  const Workplace here;
  here.write("balls.yaml", two_balls(small_frames));
  const Words shown = {"--set", "trails={seconds: 0.3}",      "--set", "shutter=0.5",
                       "--set", "arrows=[velocity]",          "--set", "caption=at {time} s",
                       "--set", "balls.red.color={by: speed}"};
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "a/run"}).code, 0);
  Words render = {"render", "a/run", "-o", "b/run"}, run = {"run", "balls.yaml", "-o", "c/run"};
  render.insert(render.end(), shown.begin(), shown.end());
  run.insert(run.end(), shown.begin(), shown.end());

  const Finished rendered = here.carom(render);
  EXPECT_EQ(rendered.code, 0);
  EXPECT_EQ(rendered.err, "");

  ASSERT_EQ(here.carom(run).code, 0);
  EXPECT_EQ(frames_of(here, "b/run").size(), 5u);
  EXPECT_EQ(frames_of(here, "b/run"), frames_of(here, "c/run"));
  EXPECT_NE(frames_of(here, "a/run"), frames_of(here, "b/run"));
}

TEST(Overlay, ThatShowsCollisionsIsSimulatedAgain) {
  const Workplace here;
  here.write("balls.yaml", two_balls(small_frames));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "run"}).code, 0);
  for (const string& set :
       {string("caption=\"{collisions} so far\""), string("flash=true"), string("balls.red.color={by: collisions}")}) {
    const Finished rendered = here.carom({"render", "run", "--set", set, "-o", "b", "--force", "--progress", "none"});
    EXPECT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(rendered.err, "run: the pictures show collisions, which its flights do not hold: simulating again\n")
        << set;
    ASSERT_EQ(here.carom({"run", "balls.yaml", "--set", set, "-o", "c", "--force"}).code, 0);
    EXPECT_EQ(frames_of(here, "b"), frames_of(here, "c")) << set;
  }
}

TEST(Film, ThatNeedsCollisionsIsSimulatedAgain) {
  const Workplace here;
  here.write("balls.yaml",
             two_balls("camera: {eye: [0, 1, 5], target: [0, 0, 0]}\noutput: {video: {fps: 10, size: [64, 48]}}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "run"}).code, 0);
  for (const string set : {"output.video.slow=auto", "output.video.sound=true"}) {
    const Finished rendered = here.carom({"render", "run", "--set", set, "-o", "b", "--force", "--progress", "none"});
    EXPECT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(rendered.err, "run: the film needs collisions, which its flights do not hold: simulating again\n") << set;
    ASSERT_EQ(here.carom({"run", "balls.yaml", "--set", set, "-o", "c", "--force"}).code, 0);
    EXPECT_EQ(here.read("b/animation.mp4"), here.read("c/animation.mp4")) << set;
  }
}

TEST(Overlay, ThatShowsCollisionsIsInTheRecordOfItsRun) {
  const Workplace here;
  for (const char* more : {"caption: \"{collisions} so far\"\n", "flash: true\n"}) {
    here.write("balls.yaml", two_balls(more + string(small_frames)));
    ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "a/run", "--force"}).code, 0);
    const vector<string> render = {"render", "a/run", "--set",   "camera={eye: [1, 1, 4], target: [1, 0, 0]}",
                                   "-o",     "b/run", "--force", "--progress",
                                   "none"};

    const Finished rendered = here.carom(render);
    EXPECT_EQ(rendered.code, 0);
    EXPECT_EQ(rendered.err, "");

    ASSERT_EQ(here.carom({"run", "balls.yaml", "--set", "camera={eye: [1, 1, 4], target: [1, 0, 0]}", "-o", "c/run",
                          "--force"})
                  .code,
              0);
    EXPECT_EQ(frames_of(here, "b/run"), frames_of(here, "c/run")) << more;
  }
}

TEST(Overlay, OfAStillIsThatOfTheFrameAtItsTime) {
  const Workplace here;
  for (const string& more :
       {string("trails: {seconds: 0.3}\nshutter: 0.5\narrows: [force]\ncaption: \"{time} s in {run}\"\n"),
        string("flash: true\ncaption: \"{collisions}, {time} s\"\n"),
        string("trails: true\nforces: [{drag: {quadratic: 0.1}}]\ncaption: \"{time} s\"\n")}) {
    here.write("balls.yaml", two_balls(more + "camera: {eye: [0, 0.5, -3], target: [0, 0, 0]}\n"
                                              "output: {frames: {fps: 10, size: [96, 54], samples: 1}}\n"));
    ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "run", "--force"}).code, 0);
    const Finished still = here.carom({"render", "run", "--at", "0.5"});
    ASSERT_EQ(still.code, 0) << still.err;
    EXPECT_TRUE(here.read("run/still_0.5s.png") == here.read("run/frames/frame_00005.png")) << more;
  }
}

TEST(Overlay, OfAStillIsDrawnAlsoForASceneWithoutPictures) {
  const Workplace here;
  const string shown = "trails: true\nflash: true\ncamera: {eye: [0, 0.5, -3], target: [0, 0, 0]}\n";
  here.write("none.yaml", two_balls(shown + "output: {flights: true}\n"));
  here.write("frames.yaml", two_balls(shown + "output: {frames: {fps: 2}}\n"));
  ASSERT_EQ(here.carom({"run", "none.yaml"}).code, 0);
  ASSERT_EQ(here.carom({"run", "frames.yaml"}).code, 0);
  ASSERT_EQ(here.carom({"render", "output/none", "--at", "0.5"}).code, 0);
  EXPECT_TRUE(here.read("output/none/still_0.5s.png") == here.read("output/frames/frames/frame_00001.png"));
}

TEST(Overlay, OfASweepHasTheValuesAndTheNameOfEachRun) {
  const Workplace here;
  // The two values are equal, so that their runs would be copies of one another.
  here.write("balls.yaml", two_balls("caption: \"{run}, {balls.red.mass} kg\"\n" + small_frames));
  const Finished sweep = here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1,1.0,2", "-o", "s", "--quiet"});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_NE(here.read("s/runs/r0001/scene.yaml").find("caption: \"{run}, 1 kg\"\n"), string::npos);
  EXPECT_NE(here.read("s/runs/r0003/scene.yaml").find("caption: \"{run}, 2 kg\"\n"), string::npos);
  EXPECT_NE(frames_of(here, "s/runs/r0001"), frames_of(here, "s/runs/r0002"));
  const Finished again = here.carom({"run", "s/runs/r0002/scene.yaml", "-o", "x/r0002"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(frames_of(here, "x/r0002"), frames_of(here, "s/runs/r0002"));
}

TEST(Overlay, OfASweepIsDrawnOnceForEqualRunsWithoutTheirNames) {
  const Workplace here;
  here.write("balls.yaml", two_balls("caption: \"{balls.red.mass} kg\"\n" + small_frames));
  ASSERT_EQ(here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=1,1.0", "-o", "s", "--quiet"}).code, 0);
  EXPECT_EQ(frames_of(here, "s/runs/r0001"), frames_of(here, "s/runs/r0002"));
}

TEST(Overlay, OfATransparentSceneHasNoMp4) {
  const Workplace here;
  here.write("balls.yaml", two_balls("background: none\n" + small_frames));
  const Finished film = here.carom({"run", "balls.yaml", "--only", "video"});
  EXPECT_EQ(film.code, 2);
  EXPECT_NE(film.err.find("an MP4 has no transparency, and `background` is `none`; write frames, a .gif or a .webp, or "
                          "give the background a colour"),
            string::npos)
      << film.err;
}

TEST(Overlay, OfATransparentSceneWithAnMp4IsRefusedOnlyIfTheFilmIsMade) {
  const Workplace here;
  here.write("balls.yaml", two_balls("background: none\noutput: {frames: {fps: 2, size: [64, 36]}, video: true}\n"));
  const string wrong = "an MP4 has no transparency, and `background` is `none`";

  for (const char* command : {"run", "check"}) {
    const Finished whole = here.carom({command, "balls.yaml"});
    EXPECT_EQ(whole.code, 2);
    EXPECT_NE(whole.err.find(wrong), string::npos) << whole.err;
  }

  const Finished film = here.carom({"run", "balls.yaml", "--only", "frames,video"});
  EXPECT_EQ(film.code, 2);
  EXPECT_NE(film.err.find(wrong), string::npos) << film.err;

  const Finished frames = here.carom({"run", "balls.yaml", "--only", "frames", "-o", "out"});
  EXPECT_EQ(frames.code, 0) << frames.err;
  EXPECT_TRUE(here.has("out/frames/frame_00000.png"));

  const Finished again =
      here.carom({"render", "out", "--only", "frames", "--set", "camera={fit: motion}", "-o", "other"});
  EXPECT_EQ(again.code, 0) << again.err;

  const Words sweep = {"sweep", "balls.yaml", "--grid", "balls.red.mass=1,2", "-o", "s", "--quiet", "--only"};
  const auto with = [&](const char* outputs) {
    Words words = sweep;
    words.emplace_back(outputs);
    return here.carom(words);
  };

  EXPECT_EQ(with("frames").code, 0);
  EXPECT_EQ(with("frames,video").code, 2);
}

TEST(Overlay, WithoutItsFontEndsTheRunBeforeItsFolderIsMade) {
  const Workplace here;
  here.write("balls.yaml", two_balls("caption: true\n" + small_frames));
  const Finished run =
      here.shell("HOME=/nowhere XDG_DATA_HOME=/nowhere XDG_DATA_DIRS=/nowhere \"$CAROM\" run balls.yaml -o out");
  EXPECT_EQ(run.code, 2);

  EXPECT_EQ(
      run.err,
      "balls.yaml: error: text in pictures needs the typeface DejaVu Sans, and no folder of fonts has "
      "DejaVuSans.ttf\n"
      "    = install it (on Debian: apt install fonts-dejavu-core), or leave out `caption`, `labels`, `scale_bar`, "
      "`arrows`, `color: {by: ...}`, and `title` and `beside` of `video`\n"
      "carom: 1 error; nothing was run\n");
  EXPECT_FALSE(here.has("out"));
}

}  // namespace
}  // namespace carom::testing
