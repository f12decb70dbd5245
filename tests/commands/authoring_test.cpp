// carom new, explain and schema, by the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "commands/starting_scene.h"
#include "scene/absent_words.h"
#include "scene/field_places.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

TEST(New, WritesASceneThatRunsAsItIsAndTheSchemaBesideIt) {
  const Workplace here;
  const Finished made = here.carom({"new", "first"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.out, "wrote first.yaml and scene.schema.json\n");
  EXPECT_EQ(here.files().size(), 2u);
  EXPECT_EQ(here.read("scene.schema.json"), here.carom({"schema"}).out);
  EXPECT_TRUE(here.read("first.yaml").starts_with("# yaml-language-server: $schema=scene.schema.json\n"));

  const Finished check = here.carom({"check", "first.yaml", "--json"});
  EXPECT_EQ(check.code, 0) << check.err;
  const Json scene = Json::parse(check.out)["scenes"][0];
  EXPECT_EQ(scene["camera"]["out_of_view"], 0);
  EXPECT_GT(scene["pictures"], 0);

  const Finished run = here.carom({"run", "first.yaml"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(here.has("output/first/frames/frame_00000.png"));
}

TEST(New, SceneDoesWhatItsCommentDescribes) {
  const Workplace here;
  here.carom({"new", "first"});
  const Json run = Json::parse(here.carom({"run", "first.yaml", "--only", "collisions", "--json"}).out)["scenes"][0];
  const string scene(starting_scene()), phrase = "sqrt(2 * 1 / 9.80665) = ";
  const double stated = std::stod(scene.substr(scene.find(phrase) + phrase.size()));
  EXPECT_NEAR(run["summary"]["first_collision_s"].get<double>(), stated, 5e-5);
  const string table = here.read("output/first/collisions.csv");
  EXPECT_NE(table.find(",body-fixed,red,floor,"), string::npos) << table;
  EXPECT_NE(table.find(",body-body,red,blue,"), string::npos) << table;
}

TEST(New, EveryLineThatIsCommentedOutMayBeTakenIn) {
  const Workplace here;
  const string scene(starting_scene());
  string all;
  bool inside = false;  // from the scene's first key on

  for (size_t i = 0; i < scene.size();) {
    const size_t end = scene.find('\n', i);
    string line = scene.substr(i, end - i);
    i = end + 1;
    inside = inside || line.starts_with("scene: 1");
    const size_t mark = line.find_first_not_of(' ');
    const bool key = mark != string::npos && line[mark] == '#' && line.find(": ") != string::npos;
    const bool opens = line.starts_with("# groups:") || line.starts_with("# walls:");
    if (inside && (opens || (key && !line.ends_with(".") && !line.ends_with(":")))) line.erase(mark, 2);
    all += line + "\n";
  }

  EXPECT_NE(all.find("\ngroups:\n  marbles:"), string::npos);
  EXPECT_NE(all.find("\n  video:"), string::npos);

  here.write("all.yaml", all);
  const Finished check = here.carom({"check", "all.yaml", "--set", "gravity=[0,-1,0]"});
  EXPECT_EQ(check.code, 0) << check.err << all;
  EXPECT_NE(check.out.find("22 bodies"), string::npos) << check.out;
  EXPECT_NE(check.out.find("1 plane, 1 wall"), string::npos) << check.out;
}

TEST(New, NamesMayHaveAFolderAndAnEnding) {
  const Workplace here;
  EXPECT_EQ(here.carom({"new", "demos/more/one.yaml"}).code, 0);
  EXPECT_TRUE(here.has("demos/more/one.yaml"));
  EXPECT_TRUE(here.has("demos/more/scene.schema.json"));
  EXPECT_EQ(here.carom({"new", "two.yml", "-q"}).out, "");
  EXPECT_TRUE(here.has("two.yml"));
  EXPECT_EQ(here.carom({"new", "with space 1.5"}).code, 0);
  EXPECT_TRUE(here.has("with space 1.5.yaml"));
  const Json document = Json::parse(here.carom({"new", "demos/three", "--json"}).out);
  EXPECT_EQ(document["scene"], "demos/three.yaml");
  EXPECT_EQ(document["schema"], "demos/scene.schema.json");
}

TEST(New, OverwritesNothingWithoutForce) {
  const Workplace here;
  here.write("first.yaml", "mine\n");
  const Finished refused = here.carom({"new", "first"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err,
            "carom new: first.yaml exists already: choose another name, or overwrite it with --force\n"
            "  carom new --help shows how it is used\n");
  EXPECT_EQ(here.read("first.yaml"), "mine\n");
  EXPECT_FALSE(here.has("scene.schema.json"));
  EXPECT_EQ(here.carom({"new", "first", "--force"}).code, 0);
  EXPECT_EQ(here.read("first.yaml"), starting_scene());
}

TEST(New, ReplacesNoFolder) {
  const Workplace here;
  here.write("first.yaml/file", "");
  const Finished refused = here.carom({"new", "first", "--force"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("first.yaml is a folder"), string::npos) << refused.err;
  EXPECT_EQ(here.files().size(), 1u);
}

TEST(New, ReplacesAnOldSchemaButNothingElseOfItsName) {
  const Workplace here;
  const string schema = here.carom({"schema"}).out;
  here.write("scene.schema.json", schema.substr(0, schema.size() / 2));
  EXPECT_EQ(here.carom({"new", "first"}).code, 0);
  EXPECT_EQ(here.read("scene.schema.json"), schema);
  here.write("scene.schema.json", "{}");
  EXPECT_EQ(here.carom({"new", "second"}).code, 2);
  EXPECT_FALSE(here.has("second.yaml"));
  EXPECT_EQ(here.read("scene.schema.json"), "{}");
}

TEST(New, RefusesWhatIsNoName) {
  const Workplace here;
  for (const string name : {"", ".", "..", "demos/", ".hidden", "demos/.yaml", "a\nb", "back\\slash", "/"}) {
    const Finished made = here.carom({"new", name});
    EXPECT_EQ(made.code, 2) << name;
    EXPECT_NE(made.err.find("is not a name for a scene"), string::npos) << name << ": " << made.err;
  }

  EXPECT_EQ(here.carom({"new", "--", "-dash"}).code, 2);
  EXPECT_EQ(here.carom({"new", string(151, 'a')}).code, 2);
  EXPECT_EQ(here.carom({"new"}).code, 2);
  EXPECT_EQ(here.carom({"new", "a", "b"}).code, 2);

  // A file stands where the folder would.
  here.write("file", "");
  const Finished under = here.carom({"new", "file/first"});
  EXPECT_EQ(under.code, 1);
  EXPECT_NE(under.err.find("cannot make file: Not a directory"), string::npos) << under.err;
  EXPECT_EQ(here.files().size(), 1u);
}

TEST(Explain, PrintsAllOfAKeyByItsPath) {
  const Workplace here;
  const Finished checked = here.carom({"explain", "balls.red.mass"});
  EXPECT_EQ(checked.code, 0);
  EXPECT_EQ(checked.out,
            "mass: Mass (kg)\n"
            "  meaning     Mass.\n"
            "  value       a number above 0 in kg\n"
            "  example     mass: 10\n"
            "  needed      one of mass and density, here or in `defaults`\n"
            "  excludes    density\n"
            "  stands at   balls.NAME.mass\n");

  // The same by other paths to it.
  EXPECT_EQ(here.carom({"explain", "balls.mass"}).out, checked.out);
  EXPECT_EQ(here.carom({"explain", "balls.NAME.mass"}).out, checked.out);
}

TEST(Explain, PrintsEveryPlaceOfABareKey) {
  const Workplace here;
  const Json fields = Json::parse(here.carom({"explain", "restitution", "--json"}).out)["fields"];
  set<string> paths;
  for (const Json& field : fields) {
    for (const Json& path : field["paths"]) paths.insert(path);
  }
  for (const char* path : {"restitution", "balls.NAME.restitution", "defaults.ball.restitution",
                           "groups.NAME.ball.restitution", "planes.NAME.restitution", "room.restitution"})
    EXPECT_TRUE(paths.contains(path)) << path;
  // One entry for equal rows.
  EXPECT_EQ(fields.size(), 4u);
}

TEST(Explain, ReadsPathsAsSetDoes) {
  const Workplace here;
  for (const char* path : {"simulate.rest_speed", "restitution.combine", "output.frames.size.width", "gravity.y",
                           "forces.0.drag.linear", "balls.red.position.x", "defaults.ball.mass", "lights", "ball.mass",
                           "ball", "camera", "frames.fps", "defaults.group.ball.radius"})
    EXPECT_EQ(here.carom({"explain", path}).code, 0) << path;
  for (const char* path : {"balls.red.mass.x", "gravity.w", "simulate.mass", "nonsense", "", ".", "balls.red.", "w"})
    EXPECT_EQ(here.carom({"explain", path}).code, 2) << path;
}

TEST(Explain, HasNearNames) {
  const Workplace here;
  EXPECT_EQ(here.carom({"explain", "rest_sped"}).err,
            "carom explain: the format has no `rest_sped`; did you mean `rest_speed`?\n"
            "  carom explain --help shows how it is used\n");
  EXPECT_EQ(here.carom({"explain", "simulate.rest_sped"}).err,
            "carom explain: the format has no `simulate.rest_sped`; in `simulate`: did you mean `rest_speed`?\n"
            "  carom explain --help shows how it is used\n");
}

TEST(Explain, GivesAProgramUnitRangeDefaultAndExample) {
  const Workplace here;
  const Json document = Json::parse(here.carom({"explain", "camera.fov", "--json"}).out);
  EXPECT_EQ(document["command"], "explain");
  const Json fov = document["fields"][0];
  EXPECT_EQ(fov["unit"], "degrees");
  EXPECT_EQ(fov["range"], Json({{"above", 0}, {"below", 180}}));
  EXPECT_EQ(fov["default"], 45);
  EXPECT_EQ(fov["example"], 30);
  EXPECT_EQ(fov["needed"], false);
  const Json engine = Json::parse(here.carom({"explain", "engine", "--json"}).out)["fields"][0];
  EXPECT_EQ(engine["choices"], Json({"auto", "exact", "stepped", "book"}));
}

TEST(Explain, NamesWhatReplacesAnAbsentWord) {
  const Workplace here;
  EXPECT_EQ(here.carom({"explain", "hinge"}).out,
            "hinge: no key of the format\n"
            "  instead     A body on a string is a pendulum; with `rod: true` it may stand above its pivot, too.\n"
            "  see         carom explain strings, carom explain string.rod\n");
  EXPECT_EQ(here.carom({"explain", "slow", "motion"}).out, here.carom({"explain", "Slow-Motion"}).out);

  for (const char* word :
       {"friction",    "rotation",    "spin",         "joint",      "rope",        "hinge",   "timestep",
        "speed",       "slow motion", "bounce",       "elasticity", "camera path", "loop",    "variable",
        "scale",       "periodic",    "filter",       "emitter",    "pour",        "insert",  "delay",
        "transparent", "momentum",    "orthographic", "python",     "random",      "pressure"}) {
    const Json words = Json::parse(here.carom({"explain", word, "--json"}).out)["words"];
    ASSERT_EQ(words.size(), 1u) << word;
    for (const Json& key : words[0]["see"])
      EXPECT_EQ(here.carom({"explain", key.get<string>()}).code, 0) << word << ": " << key;
  }
}

TEST(Explain, EveryWordThatIsAbsentStandsInOneRowAndPointsAtKeys) {
  set<string_view> words;
  for (const AbsentWord& row : absent_words()) {
    for (const string_view word : parts_of(row.words)) {
      EXPECT_TRUE(words.insert(word).second) << word;
      EXPECT_EQ(find_absent_word(word), &row) << word;
    }
    for (const string_view key : parts_of(row.see))
      EXPECT_TRUE(!find_places(key).empty() || find_kind(key) != nullptr) << key;
  }
}

TEST(Explain, WhatAnAbsentWordProposesIsOfTheFormat) {
  const auto choice_of = [](const FieldPlaces& row, const string& value) {
    const Field& field = *row.field;
    if (field.type == Type::flag) return value == "true" || value == "false";
    const vector<string_view> all = choices(field);
    return field.type != Type::choice || contains(all, value);
  };

  for (const AbsentWord& row : absent_words()) {
    const string text(row.meaning);
    for (size_t open = text.find('`'); open != string::npos;) {
      const size_t close = text.find('`', open + 1);
      ASSERT_NE(close, string::npos) << text;

      const string term = text.substr(open + 1, close - open - 1);
      open = text.find('`', close + 1);
      const size_t colon = std::min(term.find(": "), term.size());
      const string key = term.substr(0, colon), value = colon < term.size() ? term.substr(colon + 2) : "";

      if (term.starts_with("carom ")) {
        EXPECT_EQ(Workplace().carom({term.substr(6), "--help"}).code, 0) << term;
      } else if (term.starts_with("--set ") || term == "#" || term == "1080p") {
        continue;  // an option, a mark of YAML, a size
      } else {
        const vector<FieldPlaces> rows = find_places(key);
        EXPECT_FALSE(rows.empty()) << term;
        EXPECT_TRUE(value.empty() || any_of(rows, [&](const FieldPlaces& place) { return choice_of(place, value); }))
            << term;
      }
    }
  }
}

TEST(Explain, AKindHasItsKeysWithUnitsAndDefaults) {
  const Workplace here;
  for (const char* kind : {"ball", "body", "group", "plane", "wall", "obstacle"}) {
    const string out = here.carom({"explain", kind}).out;
    EXPECT_TRUE(out.starts_with(string(kind) + ": ")) << out;
    EXPECT_EQ(out.find("needed      no"), string::npos) << out;  // no row of `defaults`
  }
  const string ball = here.carom({"explain", "ball"}).out;
  EXPECT_TRUE(ball.starts_with("ball: A sphere that moves without turning.\n")) << ball;
  EXPECT_NE(ball.find("  stands at   balls.NAME and defaults.ball\n"), string::npos) << ball;
  EXPECT_NE(ball.find("    velocity        Velocity at time 0. (m/s; default [0, 0, 0])\n"), string::npos) << ball;
  EXPECT_NE(ball.find("    mass            Mass. (kg; mass or density needed)\n"), string::npos) << ball;
}

TEST(Explain, AloneListsTheKinds) {
  const Workplace here;
  const string out = here.carom({"explain"}).out;
  EXPECT_NE(out.find("\n    ball            A sphere that moves without turning.\n"), string::npos) << out;
  EXPECT_EQ(here.carom({"explain", "-q"}).out, "");
}

TEST(Explain, PrintsThePageOfAllKeys) {
  const Workplace here;
  const string page = here.carom({"explain", "--page"}).out;
  EXPECT_TRUE(page.starts_with("# The format of scene and sweep files\n")) << page;
  EXPECT_NE(page.find("| `rest_speed` | a number of at least 0 in m/s |  | `0.01` |"), string::npos) << page;
  EXPECT_EQ(here.carom({"explain", "--page", "balls"}).code, 2);
}

TEST(SchemaCommand, HasTheKindsOfFiles) {
  const Workplace here;
  const Json scene = Json::parse(here.carom({"schema"}).out);
  EXPECT_EQ(scene["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_EQ(here.carom({"schema", "scene"}).out, here.carom({"schema"}).out);
  EXPECT_TRUE(Json::parse(here.carom({"schema", "sweep"}).out)["properties"].contains("sweep"));
  const Finished wrong = here.carom({"schema", "scne"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("no kind of file `scne`; did you mean `scene`?"), string::npos) << wrong.err;
}

}  // namespace
}  // namespace carom::testing
