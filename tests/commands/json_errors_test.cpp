// Errors as objects in the documents of --json, the same for every command.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

/// The only error of a command that must fail with exit code 2. It is that of the first scene, if the document has any.
Json error_of(const Workplace& here, vector<string> words) {
  words.emplace_back("--json");
  const Finished run = here.carom(words);
  EXPECT_EQ(run.code, 2) << run.err;
  const Json document = Json::parse(run.out);
  const Json errors = (document.contains("scenes") ? document.at("scenes").at(0) : document).at("errors");
  EXPECT_EQ(errors.size(), 1u) << run.out;
  return errors.at(0);
}

TEST(JsonErrors, OfASceneHavePlaceMessageRemedyAndTheNearName) {
  const Workplace here;
  here.write("a.yaml", two_balls() + "camra: {}\n");
  const Json expected = {{"file", "a.yaml"},
                         {"line", 9},
                         {"column", 1},
                         {"message", "unknown key `camra` in the scene"},
                         {"remedy", "did you mean `camera`?"},
                         {"near", "camera"}};

  for (const string command : {"run", "check", "bench"}) EXPECT_EQ(error_of(here, {command, "a.yaml"}), expected);
  here.write("s.yaml", "sweep: 1\nbase: a.yaml\ngrid: {balls.red.mass: [1, 2]}\n");
  for (const string command : {"sweep", "submit"})
    EXPECT_EQ(error_of(here, command == "sweep" ? vector<string>{command, "s.yaml"}
                                                : vector<string>{command, "s.yaml", "--slurm"}),
              expected);
}

TEST(JsonErrors, OfASettingNameTheOption) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const Json error = error_of(here, {"run", "a.yaml", "--set", "balls.red.mass=-1"});
  EXPECT_EQ(error.at("file"), "--set balls.red.mass=-1");
  EXPECT_EQ(error.at("line"), nullptr);
  EXPECT_EQ(error.at("message"), "`mass` is -1");
  EXPECT_EQ(error.at("remedy"), "expected a number above 0 in kg");
  EXPECT_EQ(error.at("near"), nullptr);
}

TEST(JsonErrors, OfFoldersAndOptionsHaveTheSameMembers) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  here.write("output/a/notes.txt", "mine");
  const Json folder = error_of(here, {"run", "a.yaml"});
  EXPECT_EQ(folder.at("file"), "a.yaml");
  EXPECT_NE(folder.at("message").get<string>().find("the folder output/a holds"), string::npos);
  EXPECT_EQ(folder.at("remedy"), "write elsewhere with -o, or overwrite it with --force");
  EXPECT_EQ(error_of(here, {"run", "a.yaml", "--engin", "exact"}).at("near"), nullptr);
  EXPECT_EQ(error_of(here, {"run", "a.yaml", "--onl", "energy"}).at("near"), "--only");

  for (const string command : {"diff", "compare", "gather", "render", "plot"}) {
    const Json error =
        error_of(here, command == "diff" ? vector<string>{command, "no", "none"} : vector<string>{command, "no"});
    for (const char* member : {"file", "line", "column", "message", "remedy", "near"})
      EXPECT_TRUE(error.contains(member)) << command;
  }
  EXPECT_EQ(error_of(here, {"new", "a"}).at("file"), nullptr);
}

TEST(JsonErrors, OfTheCommandLineHaveTheirRemedyApart) {
  const Workplace here;
  here.write("a.yaml", two_balls());
  const auto expect = [&](const vector<string>& words, const string& message, const string& remedy) {
    const Json error = error_of(here, words);
    EXPECT_EQ(error.at("message"), message);
    EXPECT_EQ(error.at("remedy"), remedy);
  };

  expect({"run", "a.yaml", "a.yaml"}, "a.yaml and a.yaml would both be written to output/a",
         "run one of them with another -o");
  expect({"run", "a.yaml", "--watch"}, "--watch has no end that a JSON document could wait for", "leave out --json");
  expect({"sweep", "a.yaml", "--grid", "seed=1:3"}, "--grid seed=1:3 has no count",
         "add one, such as seed=1:3:6, or draw from it with --latin 50");

  // In the terminal they stand in one line.
  EXPECT_EQ(here.carom({"sweep", "a.yaml", "--grid", "seed=1:3"}).err,
            "carom sweep: --grid seed=1:3 has no count: add one, such as seed=1:3:6, or draw from it with --latin 50\n"
            "  carom sweep --help shows how it is used\n");
}

}  // namespace
}  // namespace carom::testing
