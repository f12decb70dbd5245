// The tree against its layout, and the banned contents of files.
#include <gtest/gtest.h>

#include <regex>

#include "architecture/source_tree.h"
#include "std.h"

namespace carom::testing {
namespace {

TEST(Layout, TopLevelHoldsOnlyWhatTheLayoutNames) {
  const set<string> named = {"CMakeLists.txt", "CMakePresets.json", "README.md", "dev", "scenes", "src", "tests",
                             "output"};
  for (const SourceFile& file : tracked_files()) {
    const string top = file.path.substr(0, file.path.find('/'));
    EXPECT_TRUE(named.contains(top) || top.starts_with(".")) << file.path;
  }
}

TEST(Layout, OutputsOfRunsAreNotTracked) {
  for (const SourceFile& file : tracked_files()) {
    const bool own = file.path == "output/.gitignore" || file.path == "output/README.md";
    EXPECT_FALSE(file.path.starts_with("output/") && !own) << file.path;
  }
}

TEST(Layout, EveryHeaderOpensWithPragmaOnce) {
  for (const SourceFile& file : program_files()) {
    EXPECT_TRUE(!file.path.ends_with(".h") || file.text.starts_with("#pragma once\n")) << file.path;
  }
}

TEST(Layout, EverySceneOpensWithACommentAndNamesItsFormat) {
  static const std::regex modeline("# *yaml-language-server:.*");
  for (const SourceFile& file : tracked_files()) {
    if (!file.path.starts_with("scenes/") || !file.path.ends_with(".yaml")) {
      continue;
    }
    const auto lines = file.lines();
    const auto first = ranges::find_if(lines, [](const auto& line) { return !std::regex_match(line, modeline); });
    EXPECT_TRUE(first != lines.end() && first->starts_with("# ")) << file.path << " says nothing of itself";
    EXPECT_EQ(ranges::count(lines, file.path.starts_with("scenes/sweeps/") ? "sweep: 1" : "scene: 1"), 1) << file.path;
  }
}

TEST(Layout, NoFileNamesAPathOfSomebodysMachine) {
  static const std::regex machine(R"((^|[\s"'`=(:])/(work|home|root|Users)/)");
  for (const SourceFile& file : tracked_files()) {
    for (const string& line : file.lines()) {
      EXPECT_FALSE(line.size() < 4096 && std::regex_search(line, machine)) << file.path << ": " << line;
    }
  }
}

// Same scene, same bytes on every machine: results may not depend on the processor or on a licence to reorder sums.
TEST(Layout, NoBuildOptionLetsResultsDependOnTheMachine) {
  static const std::regex option(
      "-f"
      "fast-math|-O"
      "fast|-m(arch|cpu|tune)="
      "native|-ffp-contract="
      "(fast|on)");
  for (const SourceFile& file : tracked_files()) {
    EXPECT_FALSE(!file.path.ends_with(".md") && std::regex_search(file.text, option)) << file.path;
  }
}

}  // namespace
}  // namespace carom::testing
