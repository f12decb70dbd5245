// The manual page and bash completion, as the program prints them.
#include <gtest/gtest.h>

#include "commands/commands.h"
#include "commands/manual.h"
#include "commands/option_table.h"
#include "commands/program.h"
#include "scene/field_places.h"
#include "scene/fields.h"
#include "std.h"

namespace carom::testing {
namespace {

string replaced(string text, const string& from, const string& to) {
  for (size_t i = text.find(from); i != string::npos; i = text.find(from, i + to.size()))
    text.replace(i, from.size(), to);
  return text;
}

TEST(ManualPage, HasEveryCommandItsExamplesAndItsOptions) {
  const string page = manual_page();
  for (const Command& command : commands()) {
    const string head = ".SS carom " + command.name + "\n";
    const size_t begin = page.find(head);
    ASSERT_NE(begin, string::npos) << head;
    const string section = page.substr(begin, page.find(".S", begin + 3) - begin);
    for (const OptionUse& use : command.options)
      EXPECT_NE(section.find("\\fB" + replaced(string(use.name), "-", "\\-") + "\\fR"), string::npos)
          << command.name << " " << use.name;
    EXPECT_NE(section.find("carom " + command.name), string::npos);
  }
}

TEST(ManualPage, IsSetByGroffWithoutAWarning) {
  const Workplace here;
  const Finished set = here.shell(R"("$CAROM" --man | groff -man -Tutf8 -ww -rLL=100n -P-c -P-b -P-u)");
  ASSERT_EQ(set.code, 0) << set.err;
  EXPECT_EQ(set.err, "");
  EXPECT_NE(set.out.find("carom run scenes/two_bowling_balls.yaml\n"), string::npos) << set.out;
  EXPECT_NE(set.out.find("--output DIR"), string::npos);
  EXPECT_NE(set.out.find("EXIT STATUS"), string::npos);
  EXPECT_EQ(set.out.find('\\'), string::npos);
}

TEST(SettablePaths, ArePathsOfExplain) {
  ASSERT_GT(settable_paths().size(), 30u);
  for (const string& path : settable_paths()) EXPECT_FALSE(find_places(path).empty()) << path;
  for (const string& path : plain_paths()) EXPECT_FALSE(find_places(path).empty()) << path;
}

/// Bash's completions of the last word, sorted, in a folder with some files.
class BashCompletion : public ::testing::Test {
 protected:
  BashCompletion() {
    here_.write("completion", bash_completion());
    here_.write("scenes/one.yaml", "");
    here_.write("scenes/two words.yml", "");
    here_.write("scenes/notes.txt", "");
    here_.write("output/one/summary.csv", "");
  }
  string offered(const string& words) const {
    const Finished bash = here_.shell(R"(bash -c '
      compopt() { :; }
      source completion || exit 9
      COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
      _carom
      printf "%s\n" "${COMPREPLY[@]}" | sort | paste -sd "|"' bash )" +
                                      words);
    EXPECT_EQ(bash.code, 0) << bash.err;
    EXPECT_EQ(bash.err, "") << words;
    return bash.out.substr(0, bash.out.find('\n'));
  }
  Workplace here_;
};

TEST_F(BashCompletion, OffersCommands) {
  EXPECT_EQ(offered("carom s"), "schema|submit|sweep");
  EXPECT_EQ(offered("carom help s"), "schema|submit|sweep");
  EXPECT_EQ(offered("carom --v"), "--version");
  for (const Command& command : commands()) EXPECT_EQ(offered("carom " + command.name), command.name);
}

TEST_F(BashCompletion, OffersTheOptionsOfTheCommandAndNoOthers) {
  EXPECT_EQ(offered("carom run --s"), "--seed|--set");
  EXPECT_EQ(offered("carom sweep --s"), "--seed|--set|--shard|--skip-invalid");
  EXPECT_EQ(offered("carom schema --f"), "");
  for (const Command& command : commands())
    for (const OptionUse& use : options_of(command))
      EXPECT_EQ(offered("carom " + command.name + " " + string(use.name)).find(use.name), 0u)
          << command.name << " " << use.name;
}

TEST_F(BashCompletion, OffersValuesOfOptionsThatHaveAChoice) {
  EXPECT_EQ(offered("carom run --progress ''"), "auto|bar|lines|none");
  EXPECT_EQ(offered("carom run --color = n"), "never");
  EXPECT_EQ(offered("carom run --color ="), "always|auto|never");
  EXPECT_EQ(offered("carom run --only tr"), "trajectory");
  EXPECT_EQ(offered("carom run --only energy,tr"), "energy,trajectory");
  EXPECT_EQ(offered("carom run --set simulate.dur"), "simulate.duration=");
  EXPECT_EQ(offered("carom run --seed ''"), "");
}

TEST_F(BashCompletion, OffersFilesByWhatACommandTakes) {
  EXPECT_EQ(offered("carom run scenes/"), "scenes/one.yaml|scenes/two words.yml");
  EXPECT_EQ(offered("carom check sc"), "scenes");
  EXPECT_EQ(offered("carom compare output/"), "output/one");
  EXPECT_EQ(offered("carom run scenes/one.yaml -o out"), "output");
  EXPECT_EQ(offered("carom new sc"), "");
  EXPECT_EQ(offered("carom schema ''"), "scene|sweep");
  EXPECT_EQ(offered("carom explain restitution.c"), "restitution.combine");
}

}  // namespace
}  // namespace carom::testing
