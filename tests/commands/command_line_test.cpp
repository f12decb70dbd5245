// Complete answers to command lines.
#include "commands/command_line.h"

#include <gtest/gtest.h>

#include <regex>

#include "commands/commands.h"
#include "commands/program.h"
#include "std.h"
#include "version.h"

namespace carom::testing {
namespace {

// The text on stderr of a command line that is wrong: exit code 2, nothing on stdout, no scene read.
string complaint(const vector<string>& words) {
  const Workplace here;
  const Finished finished = here.carom(words);
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.out, "");
  EXPECT_TRUE(here.files().empty());
  return finished.err;
}

TEST(CommandLine, MisspeltCommandGetsItsNearName) {
  EXPECT_EQ(complaint({"rnu", "a.yaml"}),
            "carom: no command `rnu`; did you mean `run`?\n"
            "  carom --help shows how it is used\n");
  EXPECT_EQ(complaint({"chekc", "a.yaml"}),
            "carom: no command `chekc`; did you mean `check`?\n"
            "  carom --help shows how it is used\n");
}

TEST(CommandLine, CommandThatIsNearNothingGetsTheList) {
  const string list = complaint({"simulate"});
  EXPECT_TRUE(list.starts_with("carom: no command `simulate`; the commands are run, check, ")) << list;
  EXPECT_TRUE(list.ends_with(" and explain\n  carom --help shows how it is used\n")) << list;
}

TEST(CommandLine, SceneWithoutCommandGetsTheCommandAsRemedy) {
  EXPECT_EQ(complaint({"balls.yaml"}),
            "carom: name a command first: carom run balls.yaml\n"
            "  carom --help shows how it is used\n");
}

TEST(CommandLine, OptionBeforeTheCommandIsRefusedWithItsPlace) {
  EXPECT_EQ(complaint({"--quiet", "run", "a.yaml"}),
            "carom: options come after the command: carom run SCENE --quiet\n"
            "  carom --help shows how it is used\n");
}

TEST(CommandLine, MisspeltOptionGetsItsNearName) {
  EXPECT_EQ(complaint({"run", "a.yaml", "--ouput", "x"}),
            "carom run: no option `--ouput`; did you mean `--output`?\n"
            "  carom run --help shows how it is used\n");
  EXPECT_EQ(complaint({"check", "a.yaml", "--forse"}),
            "carom check: no option `--forse`; did you mean `--force`?\n"
            "  carom check --help shows how it is used\n");
  EXPECT_EQ(complaint({"run", "a.yaml", "--frobnicate=1"}),
            "carom run: no option `--frobnicate`\n"
            "  carom run --help shows how it is used\n");
  EXPECT_EQ(complaint({"run", "a.yaml", "-z"}),
            "carom run: no option `-z`\n"
            "  carom run --help shows how it is used\n");
}

TEST(CommandLine, LongOptionAfterASingleDashIsNotReadAsAShortOneWithAValue) {
  EXPECT_EQ(complaint({"run", "a.yaml", "-output", "x"}),
            "carom run: no option `-output`; did you mean `--output`?\n"
            "  carom run --help shows how it is used\n");
}

TEST(CommandLine, NoSceneIsAnError) {
  EXPECT_EQ(complaint({"run"}),
            "carom run: name a scene file: carom run scenes/two_bowling_balls.yaml\n"
            "  carom run --help shows how it is used\n");
}

TEST(CommandLine, ValuesAreCheckedBeforeAnySceneIsRead) {
  const string end = "\n  carom run --help shows how it is used\n";
  EXPECT_EQ(complaint({"run", "a.yaml", "-o"}), "carom run: --output needs a value" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--set"}), "carom run: --set needs a value" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--set", "gravity"}),
            "carom run: --set takes path=value, such as balls.red.mass=2, not `gravity`" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--set", "=1"}),
            "carom run: --set takes path=value, such as balls.red.mass=2, not `=1`" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--seed", "-1"}),
            "carom run: --seed takes a whole number from 0 to 18446744073709551615, not `-1`" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--seed", "18446744073709551616"}),
            "carom run: --seed takes a whole number from 0 to 18446744073709551615, not `18446744073709551616`" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--seed", "1", "--seed", "2"}), "carom run: --seed is given 2 times" + end);

  EXPECT_EQ(complaint({"run", "a.yaml", "--only", "frmes"}),
            "carom run: --only takes trajectory, collisions, energy, contacts, regions, frames, video, sheet, vtk, "
            "xyz, gltf, "
            "flights, plots, report, not `frmes`; "
            "did you mean `frames`?" +
                end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--only", "energy,"}),
            "carom run: --only takes trajectory, collisions, energy, contacts, regions, frames, video, sheet, vtk, "
            "xyz, gltf, "
            "flights, plots, report, not ``" +
                end);

  EXPECT_EQ(complaint({"run", "a.yaml", "--color", "sometimes"}),
            "carom run: --color takes auto, always, never, not `sometimes`" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--progress", "bars"}),
            "carom run: --progress takes auto, bar, lines, none, not `bars`; did you mean `bar`?" + end);
  EXPECT_EQ(complaint({"run", "a.yaml", "--force=yes"}), "carom run: --force takes no value" + end);
}

TEST(CommandLine, TwoScenesForOneFolderAreRefused) {
  EXPECT_EQ(complaint({"run", "a/balls.yaml", "b/balls.yaml"}),
            "carom run: a/balls.yaml and b/balls.yaml would both be written to output/balls: "
            "run one of them with another -o\n"
            "  carom run --help shows how it is used\n");
  EXPECT_EQ(complaint({"run", "balls.yaml", "./balls.yaml", "-o", "x"}),
            "carom run: balls.yaml and ./balls.yaml would both be written to x/balls: "
            "run one of them with another -o\n"
            "  carom run --help shows how it is used\n");
}

TEST(CommandLine, HelpOpensWithExamples) {
  const Workplace here;
  for (const vector<string>& words :
       {vector<string>{"--help"}, {"-h"}, {"help"}, {"run", "--help"}, {"check", "-h"}, {"help", "run"}}) {
    const Finished help = here.carom(words);
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.err, "");
    const size_t examples = help.out.find("\nExamples:\n  carom "), usage = help.out.find("\nUsage:\n");
    EXPECT_LT(examples, 120u) << help.out;
    EXPECT_LT(examples, usage) << help.out;
    EXPECT_NE(usage, string::npos) << help.out;
  }
}

TEST(CommandLine, HelpNamesEveryOption) {
  const string help = Workplace().carom({"run", "--help"}).out;
  for (const string option : {"-o,--output DIR", "--set PATH=VALUE", "--only LIST", "--seed N", "--force",
                              "--progress HOW", "--color WHEN", "--json", "-q,--quiet", "-h,--help"}) {
    EXPECT_NE(help.find("\n  " + option + " "), string::npos) << option;
  }
}

TEST(CommandLine, NothingAtAllGetsTheHelpAsAnError) {
  const Finished finished = Workplace().carom({});
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.out, "");
  EXPECT_TRUE(finished.err.starts_with("carom turns scenes")) << finished.err;
}

// The commit has ten digits, and none is known outside of a clone.
TEST(CommandLine, VersionIsOneLineWithTheCommit) {
  const Finished finished = Workplace().carom({"--version"});
  EXPECT_EQ(finished.code, 0);
  EXPECT_TRUE(std::regex_match(
      finished.out, std::regex(string(program_and_version) + "( \\([0-9a-f]{10}(, sources changed)?\\))?\n")))
      << finished.out;
  EXPECT_EQ(finished.err, "");
}

TEST(CommandLine, WordsAfterTwoDashesAreScenes) {
  const Command& text = run_command;
  const Options options = parse_options(text, {"-q", "a.yaml", "--", "--force", "-o"}).options;
  EXPECT_EQ(options.operands, (vector<string>{"a.yaml", "--force", "-o"}));
  EXPECT_TRUE(options.quiet);
  EXPECT_FALSE(options.force);
}

TEST(CommandLine, EveryOptionIsRead) {
  const Command& text = run_command;
  const Options options = parse_options(text, {"a.yaml", "--set", "x=1", "b.yaml", "--set=y=2=3", "-oout", "--only",
                                               "energy,sheet,energy", "--seed", "18446744073709551615", "--force",
                                               "--json", "-q", "--progress=lines", "--color", "never"})
                              .options;

  EXPECT_EQ(options.operands, (vector<string>{"a.yaml", "b.yaml"}));
  EXPECT_EQ(options.set, (vector<string>{"x=1", "y=2=3"}));
  EXPECT_EQ(options.output, "out");
  EXPECT_EQ(options.only, (vector<string>{"energy", "sheet"}));
  EXPECT_EQ(options.seed, 18446744073709551615u);
  EXPECT_TRUE(options.force && options.json && options.quiet);
  EXPECT_EQ(options.progress, ProgressChoice::lines);
  EXPECT_EQ(options.color, ColorChoice::never);
}

}  // namespace
}  // namespace carom::testing
