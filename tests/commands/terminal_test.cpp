// Streams, colour, progress and signals, by the real program.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "commands/program.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

// Long enough to be interrupted anywhere: 100,000 small pictures.
string long_scene() {
  string text =
      two_balls("output: {frames: {fps: 1, size: [64, 36], samples: 1}, trajectory: {every: 1}, video: true}\n");
  return text.replace(text.find("duration: 1}"), 12, "duration: 99990}");
}

bool colored(const string& text) {
  return text.find("\x1b[") != string::npos;
}

TEST(Terminal, NoColourAndNoBarWhereThereIsNoTerminal) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Finished run = here.carom({"run", "a.yaml", "missing.yaml", "--progress", "bar"});
  EXPECT_FALSE(colored(run.out + run.err));
  const Finished right = here.carom({"run", "a.yaml", "--progress", "bar"});
  EXPECT_FALSE(colored(right.out + right.err));
}

/// With a pseudo-terminal, by script(1).
class OnATerminal : public ::testing::Test {
 protected:
  void SetUp() override {
    if (here.shell("script -qec true /dev/null").code != 0)
      GTEST_SKIP() << "this system has no pseudo-terminal (/dev/ptmx), or no script(1)";
  }
  const Workplace here;
};

TEST_F(OnATerminal, ColourIsUsedUnlessNoColor) {
  here.write("a.yaml", two_balls());
  const auto on_terminal = [&](const string& command) {
    return here.shell("TERM=xterm script -qec '" + command + "' /dev/null").out;
  };
  EXPECT_TRUE(colored(on_terminal("$CAROM check a.yaml")));
  EXPECT_FALSE(colored(on_terminal("NO_COLOR=1 $CAROM check a.yaml")));
  EXPECT_TRUE(colored(on_terminal("NO_COLOR= $CAROM check a.yaml")));
  EXPECT_TRUE(colored(on_terminal("NO_COLOR=1 $CAROM check a.yaml --color always")));
  EXPECT_FALSE(colored(on_terminal("$CAROM check a.yaml --color never")));
  EXPECT_FALSE(colored(on_terminal("TERM=dumb $CAROM check a.yaml")));
  EXPECT_TRUE(colored(here.shell("NO_COLOR=1 $CAROM check a.yaml --color always").out));
}

TEST_F(OnATerminal, BarIsClearedBeforeTheResult) {
  here.write("a.yaml", two_balls("output: {frames: {fps: 600, size: [64, 36], samples: 1}}\n"));
  const Finished run = here.shell("TERM=xterm script -qec '$CAROM run a.yaml --color never' /dev/null");
  const size_t bar = run.out.find("\ra ["), clear = run.out.find("\r\x1b[K"), result = run.out.find("a: Two balls");
  EXPECT_NE(bar, string::npos) << run.out;
  EXPECT_LT(bar, clear);
  EXPECT_LT(clear, result);
  EXPECT_EQ(run.out.find("a [", result), string::npos);
}

TEST_F(OnATerminal, BarOfASweepShowsCountRateAndTimeLeft) {
  SLOW_WITH_SANITIZERS();
  here.write("a.yaml", two_balls());
  const Finished sweep = here.shell(
      "TERM=xterm script -qec 'stty cols 100; $CAROM sweep a.yaml --grid balls.red.mass=1:2:600 -j 1 --color never' "
      "/dev/null");
  ASSERT_EQ(sweep.code, 0) << sweep.out;
  const std::regex bar(R"(a \[=* *\] +[0-9]+ % [0-9]+ of 600 runs \([0-9,]+/s\), [0-9]+ s left)");
  EXPECT_TRUE(std::regex_search(sweep.out, bar)) << sweep.out;
}

TEST(Terminal, LostOutputIsAnError) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Finished full = here.shell("$CAROM check a.yaml > /dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_EQ(full.err, "carom: cannot write to standard output: No space left on device\n");
  const Finished closed = here.shell("$CAROM check a.yaml >&-");
  EXPECT_EQ(closed.code, 1);
  EXPECT_EQ(closed.err, "carom: cannot write to standard output: Bad file descriptor\n");
  EXPECT_EQ(here.shell("$CAROM check a.yaml -q >&-").code, 0);
}

TEST(Terminal, ClosedPipeIsAnErrorAndNoSignal) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Finished piped = here.shell("{ $CAROM check a.yaml; echo $? >&2; } | true");
  EXPECT_TRUE(piped.err == "carom: cannot write to standard output: Broken pipe\n1\n" || piped.err == "0\n")
      << piped.err;
}

TEST(Terminal, ClosedDescriptorsDoNotLetOutputIntoDataFiles) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  EXPECT_EQ(here.shell("$CAROM run a.yaml -q <&- >&- 2>&-").code, 0);
  here.shell("$CAROM run a.yaml -o other <&- >&- 2>&-");
  auto quiet = here.files("output/a"), closed = here.files("other");
  quiet.erase("manifest.json");
  closed.erase("manifest.json");
  EXPECT_EQ(quiet.size(), 5u);
  EXPECT_EQ(quiet, closed);
}

class Interrupt : public ::testing::TestWithParam<int> {};

TEST_P(Interrupt, LeavesWhatIsFinishedAndNoPart) {
  const Workplace here;
  here.write("short.yaml", two_balls());
  here.write("long.yaml", long_scene());
  here.write("never.yaml", two_balls());

  const Finished run = here.interrupted({"run", "short.yaml", "long.yaml", "never.yaml", "--json"},
                                        "output/long/frames/frame_00002.png", GetParam());
  EXPECT_EQ(run.code, 128 + GetParam());
  EXPECT_EQ(run.err.substr(run.err.find("carom:")),
            "carom: long.yaml: interrupted; the same command runs what is missing\n");

  const Json scenes = Json::parse(run.out).at("scenes");
  EXPECT_EQ(scenes.at(0).at("status"), "done");
  EXPECT_EQ(scenes.at(1).at("status"), "interrupted");
  EXPECT_EQ(scenes.at(2).at("status"), "not run");
  EXPECT_TRUE(here.has("output/short/manifest.json"));
  EXPECT_FALSE(here.has("output/long/manifest.json") || here.has("output/never"));

  // No part of a file is left.
  for (const auto& [name, bytes] : here.files("output")) {
    EXPECT_EQ(name.find(".part"), string::npos) << name;
    EXPECT_FALSE(name.ends_with(".csv") && name.starts_with("long/")) << name;
    EXPECT_FALSE(name.ends_with(".mp4")) << name;
  }

  const Finished check = here.carom({"check", "long.yaml"});
  EXPECT_NE(check.out.find("  folder      output/long: incomplete, will be run again\n"), string::npos) << check.out;
}

TEST_P(Interrupt, EndsAllScenesThatRunAtOnce) {
  const Workplace here;
  for (const char* name : {"a.yaml", "b.yaml", "never.yaml"}) here.write(name, long_scene());

  const Finished run =
      here.interrupted({"run", "a.yaml", "b.yaml", "never.yaml", "-j", "2", "--json", "--progress", "none"},
                       "output/b/frames/frame_00002.png", GetParam());
  EXPECT_EQ(run.code, 128 + GetParam());
  EXPECT_EQ(run.err,
            "carom: a.yaml: interrupted; the same command runs what is missing\n"
            "carom: b.yaml: interrupted; the same command runs what is missing\n");

  const Json scenes = Json::parse(run.out).at("scenes");
  EXPECT_EQ(scenes.at(0).at("status"), "interrupted");
  EXPECT_EQ(scenes.at(1).at("status"), "interrupted");
  EXPECT_EQ(scenes.at(2).at("status"), "not run");
  EXPECT_FALSE(here.has("output/a/manifest.json") || here.has("output/b/manifest.json") || here.has("output/never"));

  for (const auto& [name, bytes] : here.files("output")) EXPECT_EQ(name.find(".part"), string::npos) << name;
}

INSTANTIATE_TEST_SUITE_P(BySignal, Interrupt, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& signal) { return signal.param == SIGINT ? "SIGINT" : "SIGTERM"; });

TEST(Terminal, IgnoredSignalStaysIgnored) {
  const Workplace here;
  here.write("a.yaml", two_balls("output: {frames: {fps: 100, size: [64, 36], samples: 1}}\n"));
  const Finished run = here.shell(
      "trap '' INT; $CAROM run a.yaml -q & p=$!; while [ ! -e output/a/frames ]; do sleep 0.01; done; kill -INT $p; "
      "wait $p");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(here.has("output/a/manifest.json"));
}

/// Characters that are invisible or reverse the following text: each is escaped on a terminal.
const string turned = "a\u202eb\u2066\u00ad\u200b\U000e0041";
const string turned_shown = R"(a\u202eb\u2066\u00ad\u200b\udb40\udc41)";

/// Commands that report a title, a key, or a word of their own with such characters.
const vector<vector<string>> commands_with_turned_text = {
    {"check", "a.yaml"},
    {"run", "a.yaml"},
    {"run", "a.yaml", "--json"},
    {"check", "a.yaml", "--json"},
    {"run", "a.yaml", "--set", turned + "=1"},
    {"run", turned + ".yaml"},
    {"run", turned},
    {turned},
    {"run", "--" + turned},
    {"render", turned},
    {"explain", turned},
    {"sweep", "a.yaml", "--grid", turned + "=1:2:3"},
    {"compare", turned},
    {"diff", turned, turned},
    {"gather", turned},
    {"new", "folder/" + turned},
    {"submit", turned + ".yaml", "--slurm"},
};

TEST(Terminal, MarksThatTurnOrHideTextAreEscapedInEveryReport) {
  const Workplace here;
  here.write("a.yaml", "scene: 1\ntitle: \"" + turned + "\"\nsimulate: {duration: 1}\n");
  here.write(turned + ".yaml", "scene: 1\n" + turned + ": 1\n");
  const auto raw = [](const Finished& run) {
    return (run.out + run.err).find("\u202e") != string::npos || (run.out + run.err).find("\u200b") != string::npos;
  };

  for (const auto& words : commands_with_turned_text) {
    const Finished run = here.carom(words);
    EXPECT_FALSE(raw(run)) << words.front() << ":\n" << run.out << run.err;
  }
  EXPECT_NE(here.carom({"check", "a.yaml"}).out.find("a: " + turned_shown), string::npos);
  // The document of --json keeps the meaning of the file.
  EXPECT_EQ(Json::parse(here.carom({"check", "a.yaml", "--json"}).out)["scenes"][0]["title"], turned);
}

TEST(Terminal, AManifestsVersionIsShownEscaped) {
  const Workplace here;
  here.write("a.yaml", two_balls("output: {frames: {fps: 1, size: [16, 16]}}\n"));
  here.carom({"run", "a.yaml"});
  string manifest = here.read("output/a/manifest.json");
  const string version = "\"version\": \"";
  manifest.insert(manifest.find(version) + version.size(), "\u202e\\u001b[2J");
  here.write("output/a/manifest.json", manifest);
  const Finished run = here.carom({"render", "output/a"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find(R"(carom \u202e\x1b[2J)"), string::npos) << run.err;
}

}  // namespace
}  // namespace carom::testing
