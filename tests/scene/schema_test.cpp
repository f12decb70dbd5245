// The schema against the loader: both made from one table, held together by another project's validator.
#include "scene/schema.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "paths.h"
#include "scene/fields.h"
#include "scene/format_page.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "scene/variations.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

/// A folder with a schema, in which documents are validated against it.
class Validator {
 public:
  explicit Validator(string_view root) : folder_(test_folder() + "/" + string(root)) {
    fs::create_directories(folder_);
    std::ofstream(folder_ + "/schema.json") << json_schema(root);
  }
  ~Validator() { fs::remove_all(folder_); }
  Validator(const Validator&) = delete;
  Validator& operator=(const Validator&) = delete;

  const string& folder() const { return folder_; }
  void add_json(const string& text) { lines_ += fmt::format("{{\"json\": {}}}\n", text); }
  void add_yaml(const string& text) { lines_ += nlohmann::json{{"yaml", text}}.dump() + "\n"; }
  void add_yaml11(const string& text) { lines_ += nlohmann::json{{"yaml 1.1", text}}.dump() + "\n"; }

  /// "right" or "wrong ..." for each document.
  vector<string> run() const {
    std::ofstream(folder_ + "/documents") << lines_;
    const string command = fmt::format("cd '{}' && /usr/bin/python3 {} schema.json documents > verdicts 2> errors",
                                       folder_, SOURCE_DIR "/tests/scene/validate.py");
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of("errors");
    std::istringstream in(text_of("verdicts"));
    vector<string> verdicts;
    for (string line; std::getline(in, line);) verdicts.push_back(line);
    return verdicts;
  }

 private:
  string text_of(const char* name) const {
    std::ifstream in(folder_ + "/" + name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  string folder_, lines_;
};

/// The errors of a scene, empty if there are none.
string loaded(const string& path, const string& text) {
  std::ofstream(path, std::ios::binary) << text;
  LoadOptions options;
  options.mesh_points = [](const string&) { return vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; };
  options.former_state = [](const string&, optional<double> at) {
    return FormerState{{"former"}, {at.value_or(1), {{0, 40, 0}}, {{0, 0, 0}}}};
  };
  try {
    load_scene(path, options);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

/// Errors of the loader that a schema cannot express: they need more than keys, types and ranges.
struct Beyond {
  string error;  // a part of its text
  string why;
};

const vector<Beyond> beyond_schemas = {
    {"nothing is named", "which names there are"},
    {"no number is named", "which names there are"},
    {"there is no `", "which members there are"},
    {"`repeat` in `defaults`", "defaults have the definition of their things"},
    {", which never meet", "what a name stands for"},
    {"but an event happens once", "two keys against one another"},
    {"after the event but `from` is", "two numbers against one another"},
    {"does not meet itself", "two names against one another"},
    {"is a fixed thing: no force acts on it", "what a name stands for"},
    {"is a fixed thing: it has no trail", "what a name stands for"},
    {"is a fixed thing: it has no rows", "what a name stands for"},
    {"is a fixed thing: it has no label", "what a name stands for"},
    {"a chart shows one", "what a name stands for"},
    {"the scene has none", "a key of another map"},
    {"has no room for a chart", "two keys against one another"},
    {"do not fit into a picture", "how many bodies there are"},
    {"is a fixed thing: it enters no region", "what a name stands for"},
    {"a film slows down around collisions of bodies", "what a name stands for"},
    {"no region is named", "which names there are"},
    {"is tied to itself", "two names against one another"},
    {" is tied to it", "what a name stands for"},
    {" has one at each end", "what a name stands for"},
    {"which appears at", "a key of another thing"},
    {"`on` beside `from` and `to`", "a key against those of a map beside it"},
    {"but its ends are", "a length against where things are"},
    {"m/s at time 0", "velocities against where things are"},
    {"are at the same point at time 0", "a length against where things are"},
    {"the scale of colours ends at", "two numbers against one another"},
    {"has no meaning for groups", "two keys against one another"},
    {"an MP4 has no transparency", "two keys against one another"},
    {"are both commas", "two keys against one another"},
    {"has no sound", "two keys against one another"},
    {"the run has none of the bodies of this scene", "what a run holds"},
    {"begin where a former run had them", "a default that a former run cannot give"},
    {"and `count` is", "two keys against one another"},
    {"is taken", "names of two kinds of things against one another"},
    {"there is no file", "what files there are"},
    {"at the start", "where things are"},
    {"not fit into the box", "how many balls a box holds"},
    {"not fit into the ball", "how many balls a ball holds"},
    {"not fit into the cylinder", "how many balls a cylinder holds"},
    {"the radii go from", "two numbers against one another"},
    {"has no volume", "two vectors against one another"},
    {"is not above its min", "two vectors against one another"},
    {"the camera's target is where its eye is", "two vectors against one another"},
    {"the camera looks along its up direction", "vectors against one another"},
    {"there is nothing to follow", "what a name stands for"},
    {"not later than the keyframe before", "two numbers against one another"},
    {"up is parallel to the normal", "two vectors against one another"},
    {"is not beyond near", "two numbers against one another"},
    {"as wide as the largest radius", "a width against the sizes of bodies"},
    {"but the scene ends at", "two numbers against one another"},
    {"but `from` is", "two numbers against one another"},
    {"times the smallest size", "how far and how fast things are against how small they are"},
    {"the limit is", "how much a run may write, which --force lifts"},
    {"not for `strings`", "what an engine can do depends on forces, volumes and strings together"},
    {"paths have no closed form", "what an engine can do depends on forces, volumes and obstacles together"},
    {"`engine: book` has no", "what an engine can do depends on forces, volumes and obstacles together"},
    {"has an opening and is solid", "two keys against one another"},
    {"is hollow, and a mesh is not", "two keys against one another"},
    {"is open at the top or at the bottom", "two keys against one another"},
    {"which only balls can meet", "what volumes bodies and things have"},
    {"is too wide for the opening", "sizes of things against one another"},
    {"balls may merge into one", "sizes of things against one another"},
    {"a contact sheet of", "how many pictures a size holds"},
    {"a GIF cannot show", "the end of a name against a number"},
    {"but the windows repeat every", "the end of a window against their period"},
    {"parabolas from impact to impact", "what an engine can do depends on forces, volumes and obstacles together"},
};

/// The one of beyond_schemas that explains each error; empty: another error is among them.
set<size_t> explained(const string& errors) {
  set<size_t> found;
  std::istringstream in(errors);
  for (string line; std::getline(in, line);) {
    if (line.find(": error: ") == string::npos) continue;
    size_t i = 0;
    while (i < beyond_schemas.size() && line.find(beyond_schemas[i].error) == string::npos) ++i;
    if (i == beyond_schemas.size()) return {};
    found.insert(i);
  }
  return found;
}

TEST(Schema, RefusesWhatTheLoaderRefusesAndNothingElse) {
  SLOW_WITH_SANITIZERS();
  Validator validator("scene");
  const string file = validator.folder() + "/scene.yaml";
  std::ofstream(validator.folder() + "/box.stl") << "a mesh";
  std::ofstream(validator.folder() + "/heap.csv") << "x_m,y_m,z_m,radius_m,mass_kg\n-5,30,0,0.1,1\n-6,30,0,0.1,1\n";

  set<string> visited, all;
  vector<Variation> variations;
  for (const string& scene : right_scenes()) {
    EXPECT_EQ(loaded(file, scene), "");
    for (Variation& variation : vary(scene, visited)) variations.push_back(std::move(variation));
  }
  for (const Kind& kind : kinds()) {
    for (const Field& field : kind.fields) all.insert(fmt::format("{}.{}", kind.name, field.key));
  }

  vector<string> lacking;
  ranges::set_difference(all, visited, std::back_inserter(lacking));
  EXPECT_EQ(lacking, vector<string>()) << "right_scenes() lacks a key of the table";

  for (const Variation& variation : variations) validator.add_json(variation.text);
  std::future<vector<string>> validating = std::async(std::launch::async, [&] { return validator.run(); });
  vector<string> all_errors;
  for (const Variation& variation : variations) all_errors.push_back(loaded(file, variation.text));

  const vector<string> verdicts = validating.get();
  ASSERT_EQ(verdicts.size(), variations.size());
  set<size_t> used;
  size_t right = 0, differing = 0;

  for (size_t i = 0; i < variations.size(); ++i) {
    const string& errors = all_errors[i];
    right += errors.empty();
    if (errors.empty() == (verdicts[i] == "right")) continue;
    const set<size_t> why = explained(errors);
    used.insert(why.begin(), why.end());
    if (!why.empty() && verdicts[i] == "right") continue;
    if (++differing <= 40) ADD_FAILURE() << variations[i].what << "\nschema: " << verdicts[i] << "\nloader: " << errors;
  }

  EXPECT_EQ(differing, 0u) << "of " << variations.size();
  EXPECT_GT(right, 500u) << "of " << variations.size();

  for (size_t i = 0; i < beyond_schemas.size(); ++i)
    EXPECT_TRUE(used.contains(i)) << "no variation has: " << beyond_schemas[i].error;
  RecordProperty("variations", static_cast<int>(variations.size()));
}

/// A number of a scene as text, as read by the loader and by an editor.
struct Written {
  string text;
  bool loads, fits;
  string why = {};  // where they differ
};

const vector<Written> written_numbers = {
    {"1", true, true},
    {"+1.5e0", true, true},
    {".5", true, true},
    {"5.", true, true},
    {"1e3", true, true},
    {"1.e+3", true, true},
    {"-0", true, true},
    {"'1'", false, false},
    {"1_000", false, false},
    {"1 s", false, false},
    {"1,5", false, false},
    {"1:30", false, false},
    {"~", false, false},
    {"", false, false},
    {"true", false, false},
    {".inf", false, false},
    {"-.inf", false, false},
    {"1e999", false, false},
    {"NaN", false, false},
    {"0b1", false, false},
    {".nan", false, false},
    {"010", false, true, "YAML 1.2 reads 10, YAML 1.1 reads 8: the loader wants it said"},
    {"0x10", false, true, "YAML reads 16: numbers of a scene are decimal"},
    {"0o17", false, true, "YAML reads 15: numbers of a scene are decimal"},
    {"1e-999", false, true, "YAML reads 0"},
};

const vector<Written> written_flags = {
    {"true", true, true},
    {"false", true, true},
    {"yes", false, false},
    {"on", false, false},
    {"1", false, false},
    {"'true'", false, false},
    {"~", false, false},
    {"True", false, true, "YAML reads true: the loader has one way to write it"},
    {"FALSE", false, true, "YAML reads false: the loader has one way to write it"},
};

TEST(Schema, AgreesWithTheLoaderOnHowNumbersAndFlagsAreWritten) {
  Validator validator("scene");
  vector<pair<string, Written>> all;
  for (const Written& number : written_numbers)
    all.emplace_back("scene: 1\nsimulate: {duration: 1, rest_speed: " + number.text + "}\n", number);
  for (const Written& flag : written_flags)
    all.emplace_back("scene: 1\nsimulate: {duration: 1}\noutput: {collisions: " + flag.text + "}\n", flag);
  // A quoted number is no choice; a name may be anything that YAML reads as text.
  all.emplace_back("scene: 1\nsimulate: {duration: 1}\noutput: {frames: {samples: 4}}\n",
                   Written{"samples", true, true});
  all.emplace_back("scene: 1\nsimulate: {duration: 1}\noutput: {frames: {samples: '4'}}\n",
                   Written{"'4'", false, false});
  all.emplace_back("scene: 1\nsimulate: {duration: 1}\noutput: {frames: {samples: 4.0}}\n",
                   Written{"4.0", false, true, "JSON knows one 4"});

  all.emplace_back("scene: 1\nsimulate: {duration: 1}\nseed: 1e17\n",
                   Written{"1e17", false, true, "JSON knows one 1e17"});
  all.emplace_back("scene: 1\nsimulate: {duration: 1}\nseed: 1e3\n", Written{"1e3", true, true});
  all.emplace_back("scene: 1\nsimulate: {duration: 1}\nplanes:\n  on: {point: [0, 0, 0], normal: [0, 1, 0]}\n",
                   Written{"on", true, true});
  const string file = validator.folder() + "/scene.yaml";
  for (const auto& [text, written] : all) validator.add_yaml(text);

  const vector<string> verdicts = validator.run();
  ASSERT_EQ(verdicts.size(), all.size());
  for (size_t i = 0; i < all.size(); ++i) {
    const Written& written = all[i].second;
    EXPECT_EQ(loaded(file, all[i].first).empty(), written.loads) << written.text << "\n" << loaded(file, all[i].first);
    EXPECT_EQ(verdicts[i] == "right", written.fits) << written.text << ": " << verdicts[i];
    EXPECT_EQ(written.loads != written.fits, !written.why.empty()) << written.text;
  }
}

vector<fs::path> scene_files() {
  vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(SCENES_DIR)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Schema, HasEverySceneRightByReadersOfYaml12And11) {
  Validator validator("scene"), sweeps("sweep");
  vector<fs::path> of_scenes, of_sweeps;
  for (const fs::path& path : scene_files()) {
    const string text = text_of(path);
    const bool sweep = text.find("\nsweep: 1") != string::npos;
    (sweep ? of_sweeps : of_scenes).push_back(path);
    (sweep ? sweeps : validator).add_yaml(text);
    (sweep ? sweeps : validator).add_yaml11(text);
  }

  ASSERT_GT(of_scenes.size(), 20u);
  for (const auto& [files, verdicts] : {pair(of_scenes, validator.run()), pair(of_sweeps, sweeps.run())}) {
    ASSERT_EQ(verdicts.size(), 2 * files.size());
    for (size_t i = 0; i < verdicts.size(); ++i) EXPECT_EQ(verdicts[i], "right") << files[i / 2];
  }
}

TEST(Schema, StandsBesideTheScenesAsTheTableHasIt) {
  for (const string kind : {"scene", "sweep"}) {
    EXPECT_TRUE(text_of(SCENES_DIR "/" + kind + ".schema.json") == json_schema(kind))
        << fmt::format("carom schema {} > scenes/{}.schema.json", kind, kind);
  }
  for (const fs::path& path : scene_files()) {
    const string text = text_of(path), head = "# yaml-language-server: $schema=";
    ASSERT_TRUE(text.starts_with(head)) << path;
    const string schema = text.substr(head.size(), text.find('\n') - head.size());
    EXPECT_TRUE(fs::exists(path.parent_path() / schema)) << path << " names " << schema;
  }
}

TEST(FormatPage, StandsBesideTheScenesAsTheTableHasIt) {
  EXPECT_TRUE(text_of(SCENES_DIR "/format.md") == format_page()) << "carom explain --page > scenes/format.md";
}

TEST(Schema, DescribesEveryField) {
  for (const auto family : families()) {
    const auto whole = nlohmann::json::parse(json_schema(family.front().name));
    for (const Kind& kind : family) {
      const auto& map = &kind == &family.front() ? whole : whole["definitions"][string(kind.name)];
      for (const Field& field : kind.fields) {
        const auto& schema = map["properties"][string(field.key)];
        EXPECT_FALSE(schema.value("title", "").empty()) << kind.name << "." << field.key;
        EXPECT_TRUE(schema.value("description", "").starts_with(field.doc)) << kind.name << "." << field.key;
        EXPECT_EQ(schema.contains("default"), !field.initial.empty()) << kind.name << "." << field.key;
        EXPECT_EQ(schema["examples"].size(), 1u) << kind.name << "." << field.key;

        if (!field.unit.empty()) {
          EXPECT_TRUE(schema["title"].get<string>().ends_with(fmt::format("({})", field.unit)));
        }
      }
    }
  }
}

}  // namespace
}  // namespace carom
