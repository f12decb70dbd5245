// Interrupted runs go on by the same command.
#include <gtest/gtest.h>

#include <csignal>
#include <random>

#include "commands/program.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

using namespace carom::testing;

/// 600 balls that fall, collide and come to lie, in about a second.
const string pile =
    "scene: 1\ngravity: [0, -9.81, 0]\nrestitution: 0.3\nroom: {min: [0, 0, 0], max: [2.4, 6, 2.4]}\n"
    "groups: {b: {count: 600, in: {min: [0, 0, 0], max: [2.4, 6, 2.4]}, ball: {mass: 1, radius: 0.1}}}\n"
    "simulate: {duration: 4}\n"
    "output: {trajectory: {every: 0.05}, collisions: true, energy: {every: 0.05}, contacts: {every: 0.1}, "
    "flights: true, frames: {fps: 2, size: [64, 36]}}\n";

TEST(ResumedRun, KilledAtTwentyRandomInstantsHasTheBytesOfOneThatWasNot) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  here.write("pile.yaml", pile);
  ASSERT_EQ(here.carom({"run", "pile.yaml", "-o", "whole"}).code, 0);

  const vector<string> command = {"run", "pile.yaml", "-o", "killed", "--checkpoint", "0.05"};
  std::mt19937_64 random(7);
  int went_on = 0;

  for (int kill = 0; kill < 20; ++kill) {
    const std::chrono::milliseconds time(80 + random() % 80);
    const Finished run = here.interrupted_after(command, time, SIGKILL);
    if (run.err.find("goes on") != string::npos) ++went_on;
    if (run.code == 0) break;
  }
  EXPECT_GT(went_on, 0);

  const Finished last = here.carom(command);
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(without_manifest(here.files("killed")), without_manifest(here.files("whole")));
}

const vector<string> run_pile = {"run", "pile.yaml", "-o", "run", "--checkpoint", "0.1"};

/// The pile, stopped once it is kept.
Finished stop_pile(const Workplace& here) {
  here.write("pile.yaml", pile);
  return here.interrupted(run_pile, "run/.checkpoint.part", SIGTERM);
}

TEST(ResumedRun, SaysWhereItWasInterruptedAndWhereItGoesOn) {
  const Workplace here;
  const Finished stopped = stop_pile(here);
  EXPECT_EQ(stopped.code, 143);
  EXPECT_NE(stopped.err.find("of its motion; the same command goes on there"), string::npos) << stopped.err;
  EXPECT_NE(here.carom({"check", "pile.yaml", "-o", "run"}).out.find("the same command goes on there"), string::npos);
  const Finished done = here.carom(run_pile);
  EXPECT_EQ(done.code, 0);
  EXPECT_NE(done.err.find("carom: pile.yaml: goes on at "), string::npos) << done.err;
  EXPECT_FALSE(here.has("run/.checkpoint.part"));
}

TEST(ResumedRun, IsReplacedWhenItsSceneFileIsEdited) {
  const Workplace here;
  ASSERT_EQ(stop_pile(here).code, 143);
  here.write("other.yaml", pile + "title: Other\n");
  const Finished other = here.carom({"run", "other.yaml", "-o", "run"});
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("--force"), string::npos) << other.err;

  here.write("pile.yaml", pile + "title: Edited\n");
  const Finished edited = here.carom(run_pile);
  EXPECT_EQ(edited.code, 0) << edited.err;
  EXPECT_NE(edited.err.find("begins anew"), string::npos) << edited.err;
  EXPECT_FALSE(here.has("run/.checkpoint.part"));
}

TEST(ResumedRun, KeepsWhatItHasWhereFilesCannotBeOpened) {
  NOT_WITH_SANITIZERS();
  const Workplace here;
  ASSERT_EQ(stop_pile(here).code, 143);
  for (int files = 5; files < 12; ++files)
    here.shell("ulimit -n " + to_string(files) + "; \"$CAROM\" run pile.yaml -o run");
  const Finished done = here.carom(run_pile);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("goes on at "), string::npos) << done.err;
}

TEST(ResumedRun, IsTakenUpByASweep) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  here.write("pile.yaml", pile);
  const vector<string> sweep = {"sweep", "pile.yaml", "--grid", "restitution=0.1,0.3", "--only", "energy"};

  const auto into = [&](const string& folder) {
    vector<string> words = sweep;
    words.insert(words.end(), {"-j", "1", "-o", folder, "--checkpoint", "0.1"});
    return words;
  };

  ASSERT_EQ(here.carom(into("whole")).code, 0);
  const Finished stopped = here.interrupted(into("stopped"), "stopped/runs/r0001/.checkpoint.part", SIGTERM);
  EXPECT_EQ(stopped.code, 143) << stopped.err;
  EXPECT_TRUE(here.has("stopped/runs/r0001/.checkpoint.part"));
  EXPECT_EQ(here.carom(into("stopped")).code, 0);

  for (const string run : {"r0001", "r0002"})
    EXPECT_EQ(here.read("stopped/runs/" + run + "/energy.csv"), here.read("whole/runs/" + run + "/energy.csv"));
}

TEST(ResumedRun, IsKeptNeverWithZero) {
  const Workplace here;
  here.write("pile.yaml", pile);
  const vector<string> command = {"run", "pile.yaml", "-o", "run", "--checkpoint", "0"};
  EXPECT_EQ(here.interrupted_after(command, std::chrono::milliseconds(150), SIGTERM).code, 143);
  EXPECT_FALSE(here.has("run/.checkpoint.part"));
}

}  // namespace
}  // namespace carom
