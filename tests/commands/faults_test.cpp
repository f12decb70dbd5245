// The program under failures of its environment: its messages, its end, and the same command resuming.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

const char* const film = "output: {video: {fps: 10, size: [32, 18], samples: 1}}\n";
const char* const sweep =
    "sweep: 1\n"
    "base: balls.yaml\n"
    "grid: {balls.red.mass: [5, 10]}\n";

/// A program of this name in bin/, a shell script.
void put_program(const Workplace& here, const string& name, const string& script) {
  here.write("bin/" + name, "#!/bin/sh\n" + script + "\n");
  chmod(here.path("bin/" + name).c_str(), 0755);
}

TEST(FileSizeLimit, IsAnErrorThatNamesTheFile) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {trajectory: {every: 0.0001}}\n"));
  const Finished run = here.shell("ulimit -f 8; exec \"$CAROM\" run balls.yaml -o out --progress none");
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "carom: balls.yaml: the run failed: cannot write out/trajectory.csv: File too large\n");
  EXPECT_FALSE(here.has("out"));
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "out"}).code, 0);
}

class HangingProgram : public ::testing::TestWithParam<int> {};

TEST_P(HangingProgram, FfmpegIsLeftAtTheFirstSignal) {
  for (const char* script : {"exec sleep 1000", "cat > /dev/null; exec sleep 1000"}) {
    const Workplace here;
    here.write("balls.yaml", two_balls(film));
    put_program(here, "ffmpeg", "echo $$ > \"" + here.path("started") + "\"; " + script);
    const string path = std::getenv("PATH");
    setenv("PATH", (here.path("bin") + ":" + path).c_str(), 1);
    const auto start = std::chrono::steady_clock::now();
    const Finished run =
        here.interrupted({"run", "balls.yaml", "-o", "out", "--progress", "none"}, "started", GetParam());
    setenv("PATH", path.c_str(), 1);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    EXPECT_EQ(run.code, 128 + GetParam());
    EXPECT_EQ(run.err, "carom: balls.yaml: interrupted; the same command runs what is missing\n");
    EXPECT_LT(seconds, 60);  // a film's time limit is ten minutes
    EXPECT_FALSE(here.has("out"));
  }
}

INSTANTIATE_TEST_SUITE_P(Signals, HangingProgram, ::testing::Values(SIGINT, SIGTERM));

// One polygon of many corners takes longer to read than the test allows.
TEST(HangingMesh, IsLeftAtTheFirstSignal) {
  const Workplace here;
  string mesh, face = "f";
  for (int k = 0; k < 32'000; ++k) {
    const double angle = 0.00019634954 * k, radius = k % 2 == 0 ? 1 : 0.9;  // a star
    mesh += "v " + to_string(radius * std::cos(angle)) + " " + to_string(radius * std::sin(angle)) + " 0\n";
    face += " " + to_string(k + 1);
  }
  here.write("star.obj", mesh + face + "\n");

  here.write("star.yaml",
             "scene: 1\nbodies: {a: {mass: 1, mesh: star.obj, fit: sphere, position: [0, 0, 0]}}\n"
             "simulate: {duration: 1}\n");

  const auto start = std::chrono::steady_clock::now();
  const Finished check = here.shell("timeout --foreground --preserve-status -s INT 1 \"$CAROM\" check star.yaml");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(check.code, 130) << check.out << check.err;
  EXPECT_EQ(check.err, "carom: interrupted\n");
  EXPECT_LT(seconds, 5);
}

TEST(Workbook, ThatHasNoRoomIsAnErrorAndLeavesNothing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "-o", "a"});
  here.carom({"run", "balls.yaml", "-o", "b", "--set", "balls.red.mass=5"});
  ASSERT_EQ(here.carom({"compare", "a", "b", "-o", "whole"}).code, 0);
  // Blocks of 512 bytes: too few for a part of the workbook, and for the parts together.
  const size_t blocks = (here.read("whole/comparison.xlsx").size() - 1) / 512;

  for (const size_t limit : {size_t{4}, blocks}) {
    const Finished compare =
        here.shell("ulimit -f " + to_string(limit) + "; exec \"$CAROM\" compare a b -o out --progress none");
    EXPECT_EQ(compare.code, 1);
    EXPECT_NE(compare.err.find("carom: cannot write out/comparison.xlsx: File too large\n"), string::npos)
        << compare.err;
    EXPECT_FALSE(here.has("out"));
  }

  // Without the limit.
  EXPECT_EQ(here.carom({"compare", "a", "b", "-o", "out"}).code, 0);
}

TEST(Sweep, ThatHadNoRoomForItsBaseGoesOn) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("sweep.yaml", sweep);
  ASSERT_EQ(here.carom({"sweep", "sweep.yaml", "-o", "whole"}).code, 0);
  here.write("out/sweep.yaml", here.read("whole/sweep.yaml"));
  EXPECT_EQ(here.carom({"sweep", "sweep.yaml", "-o", "out"}).code, 0);
  EXPECT_EQ(here.read("out/summary.csv"), here.read("whole/summary.csv"));
  // The folder of another sweep is refused.
  here.write("other/sweep.yaml", here.read("whole/sweep.yaml") + "# more\n");
  EXPECT_EQ(here.carom({"sweep", "sweep.yaml", "-o", "other"}).code, 2);
}

/// PATH with bin/ of a workplace in front, while this object lives.
class OwnPrograms {
 public:
  explicit OwnPrograms(const Workplace& here) : path_(std::getenv("PATH")) {
    setenv("PATH", (here.path("bin") + ":" + path_).c_str(), 1);
  }
  ~OwnPrograms() { setenv("PATH", path_.c_str(), 1); }
  OwnPrograms(const OwnPrograms&) = delete;
  OwnPrograms& operator=(const OwnPrograms&) = delete;

 private:
  string path_;
};

// The disk of a test is not full. An ffmpeg that reports one stands for it.
const char* const full_disk = "echo started >> \"$LOG\"; echo 'cannot write: No space left on device' >&2; exit 1";

const string remedy = "  make room, then the same command runs what is missing, or write elsewhere with -o\n";

TEST(FullDisk, EndsASweepAtItsFirstErrorWithOneRemedy) {
  for (const char* jobs : {"1", "2"}) {
    const Workplace here;
    here.write("balls.yaml", two_balls(film));
    here.write("sweep.yaml", "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.mass: {from: 1, to: 12, count: 12}}\n");
    put_program(here, "ffmpeg", full_disk);
    setenv("LOG", here.path("log").c_str(), 1);
    const Finished run = [&] {
      const OwnPrograms programs(here);
      return here.carom({"sweep", "sweep.yaml", "-o", "out", "-j", jobs, "--progress", "none"});
    }();

    EXPECT_EQ(run.code, 1);
    EXPECT_TRUE(run.err.starts_with("carom: cannot make the film out/runs/r00")) << run.err;
    EXPECT_TRUE(run.err.ends_with(": cannot write: No space left on device\n" + remedy +
                                  "carom: sweep.yaml: 0 runs made, 12 not run\n"))
        << run.err;
    EXPECT_EQ(ranges::count(run.err, '\n'), 3) << run.err;
    EXPECT_LE(here.read("log").size(), string("started\n").size() * std::stoul(jobs));
    EXPECT_EQ(here.carom({"sweep", "sweep.yaml", "-o", "out"}).code, 0);
  }
}

TEST(FullDisk, CountsTheRunsOfASweepThatAreMadeAndNotRun) {
  const Workplace here;
  here.write("balls.yaml", two_balls(film));
  here.write("sweep.yaml", "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.mass: [1, 2, 3, 4, 5]}\n");
  here.carom({"sweep", "sweep.yaml", "-o", "out", "-q"});
  for (const char* run : {"r0002", "r0004", "r0005"}) fs::remove_all(here.path(string("out/runs/") + run));
  // The first film has room.
  put_program(here, "ffmpeg",
              "[ -e \"$LOG\" ] || { echo > \"$LOG\"; PATH=${PATH#*:}; exec ffmpeg \"$@\"; }\n" + string(full_disk));
  setenv("LOG", here.path("log").c_str(), 1);
  const OwnPrograms programs(here);

  const Finished run = here.carom({"sweep", "sweep.yaml", "-o", "out", "-j", "1", "--json", "--progress", "none"});
  EXPECT_TRUE(run.err.starts_with("carom: cannot make the film out/runs/r0004/animation.mp4: ")) << run.err;
  EXPECT_TRUE(run.err.ends_with(": cannot write: No space left on device\n" + remedy +
                                "carom: sweep.yaml: 1 run made, 2 not run\n"))
      << run.err;

  const auto document = nlohmann::json::parse(run.out);
  EXPECT_EQ(document.at("status"), "failed");
  EXPECT_EQ(document.at("made"), 1);
  EXPECT_EQ(document.at("not_run"), 2);
}

TEST(FullDisk, EndsARunOfSeveralScenesWithOneError) {
  for (const char* jobs : {"1", "2"}) {
    const Workplace here;
    for (const char* name : {"a.yaml", "b.yaml", "c.yaml", "d.yaml"}) here.write(name, two_balls(film));
    put_program(here, "ffmpeg", full_disk);
    setenv("LOG", here.path("log").c_str(), 1);
    const OwnPrograms programs(here);

    const Finished run =
        here.carom({"run", "a.yaml", "b.yaml", "c.yaml", "d.yaml", "-o", "out", "-j", jobs, "--progress", "none"});
    EXPECT_EQ(run.code, 1);
    EXPECT_TRUE(run.err.ends_with(": cannot write: No space left on device\n" + remedy)) << run.err;
    EXPECT_EQ(ranges::count(run.err, '\n'), 2) << run.err;
    EXPECT_TRUE(run.out.starts_with("4 scenes: 1 failed, 3 not run, in ")) << run.out;
    EXPECT_LE(here.read("log").size(), string("started\n").size() * std::stoul(jobs));
  }
}

TEST(Film, WhatItsProgramLeavesBehindIsRemoved) {
  const struct {
    const char *name, *script;
  } programs[] = {{"ffmpeg", "mkdir -p animation.mp4/inner; touch animation.mp4/inner/x; exit 1"},
                  {"ffmpeg", "mkdir sub; touch sub/x; ln -s /etc sub/link; cat > /dev/null"},
                  {"ffprobe", "mkdir -p a/b/c; exit 1"}};

  for (const auto& [name, script] : programs) {
    const Workplace here;
    here.write("balls.yaml", two_balls(film));
    put_program(here, name, script);
    {
      const OwnPrograms own(here);
      EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "out", "--progress", "none"}).code, 1) << script;
    }
    EXPECT_FALSE(here.has("out")) << script;
    EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "out"}).code, 0) << script;
  }
}

TEST(Film, AFolderInItsPlaceIsNamedBeforeAnythingIsSimulated) {
  const Workplace here;
  here.write("balls.yaml", two_balls(film));
  fs::create_directories(here.path("out/animation.mp4/x"));
  const Finished run = here.carom({"run", "balls.yaml", "-o", "out", "--force", "--progress", "none"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err,
            "carom: balls.yaml: the run failed: cannot write out/animation.mp4: a folder of that name stands there; "
            "remove it\n");
  EXPECT_FALSE(here.has("out/scene.yaml"));
  fs::remove_all(here.path("out/animation.mp4"));
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "out"}).code, 0);
}

TEST(Folders, ThatCannotBeReadAreNotMissing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  fs::create_symlink("loop", here.path("loop"));
  const Finished run = here.carom({"run", "balls.yaml", "-o", "loop/out"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "carom: cannot look at loop/out: Too many levels of symbolic links\n");
}

}  // namespace
}  // namespace carom::testing
