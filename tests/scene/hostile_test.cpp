// Any bytes give a Scene or a SceneError, soon, and no crash.
#include <fmt/format.h>
#include <sys/stat.h>

#include "numerics/random.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

string repeat(string_view part, int times) {
  string out;
  for (int i = 0; i < times; ++i) out += part;
  return out;
}

/// Ten times as many aliases of each anchor as of the one before.
string alias_bomb() {
  string text = "a0: &a0 [x]\n";
  for (int i = 1; i < 30; ++i) {
    const string last = fmt::format("*a{}", i - 1);
    text += fmt::format("a{0}: &a{0} [{1}{2}]\n", i, repeat(last + ", ", 9), last);
  }
  return text;
}

const vector<string> hostile_texts = {"",
                                      ",",
                                      "{",
                                      "}",
                                      "[",
                                      "]",
                                      ":",
                                      "?",
                                      "-",
                                      "- ",
                                      "*",
                                      "&",
                                      "!",
                                      "|",
                                      ">",
                                      "%",
                                      "@",
                                      "`",
                                      "\"",
                                      "'",
                                      "#",
                                      "~",
                                      "...",
                                      "---",
                                      "--- ---",
                                      "{,,,,",
                                      "{,}",
                                      "[,]",
                                      "{:}",
                                      "{?}",
                                      "? ",
                                      "? a",
                                      ": b",
                                      "a: b: c",
                                      "{a: b: c}",
                                      "[a: b: c]",
                                      "a:\n- b\n c",
                                      "a\n b\n  c: d",
                                      "\n\n\n",
                                      "\r",
                                      "a: b\r",
                                      "\xEF\xBB\xBF",
                                      "\xEF\xBB\xBF\xEF\xBB\xBF",
                                      string("\0", 1),
                                      string("s\0c\0e\0", 6),
                                      string("\0s\0c", 4),
                                      string("scene: 1\0\n", 10),
                                      "\xFF\xFEs",
                                      "\xFE\xFFs",
                                      string("\0\0\xFE\xFF", 4),
                                      "scene: 1 \x1B[31m",
                                      "scene: 1 \x7F",
                                      "a: \xC0\x80",
                                      "a: \xED\xA0\x80",
                                      "a: \xF4\x90\x80\x80",
                                      "a: \xE2\x80",
                                      "a: \xC2\x85",
                                      "a: \xE2\x80\xA8",
                                      "a: \xEF\xBB\xBF",
                                      "a: \"\\0\"",
                                      "a: \"\\x1b\"",
                                      "a: \"\\ud800\"",
                                      "a: \"\\U00110000\"",
                                      "a: \"\\",
                                      "*a",
                                      "&a *a",
                                      "a: &a *a",
                                      "a: &a {b: *a}",
                                      "&a a: *a",
                                      "<<: *a",
                                      "!!map {a: b}",
                                      "!<tag:x> a",
                                      "%YAML 9.9\n---\na: b",
                                      "%TAG ! x\n---\n!a b",
                                      "%TAG ! x\n%TAG ! x\n---\na",
                                      "? [a]\n: b",
                                      "? {a: b}\n: c",
                                      "{[a]: b}",
                                      "{{a: b}: c}",
                                      "a: |\n  b\n c\n",
                                      "a: |9\n b",
                                      "a: |0\n b",
                                      "a: >-+\n b",
                                      "a: |\n\tb",
                                      "a: 'b",
                                      "a: \"b",
                                      "a: \"b\nc: d\n",
                                      "a: 'b\n...\n",
                                      "scene: 1\n...\nscene: 1\n",
                                      "scene: 1\n---\n",
                                      "--- 1\n--- 2",
                                      "scene: 1\n...\n...\n,",
                                      "scene: 1\n}"};

/// Made where they are read: every test of this program would wait for them.
vector<string> long_texts() {
  return {repeat("[", 1'000'000), repeat("{", 1'000'000), repeat("{,,,,", 200'000), repeat("- ", 100'000),
          repeat("? ", 100'000), repeat("a: ", 1000), repeat("[[],", 100'000),
          // Tags, anchors and aliases.
          repeat("!a ", 50'000), repeat("&a ", 50'000), repeat("*a ", 50'000), repeat("\"a\" ", 50'000),
          repeat("a\n", 50'000), repeat("[ #]\n", 100'000), repeat("%a\n", 50'000), "a: " + repeat("x", 200'000),
          "a: |\n" + repeat(" a\n", 50'000), "a: [" + repeat("1,", 200'000) + "]", repeat("\n", 200'000),
          repeat("a: 1\n", 2000), alias_bomb()};
}

TEST(HostileFiles, NoneLoadsAndNoneCrashes) {
  vector<string> texts = long_texts();
  texts.insert(texts.end(), hostile_texts.begin(), hostile_texts.end());
  for (const string& text : texts) {
    const string errors = errors_of(text);
    EXPECT_NE(errors.find("error: "), string::npos) << text.substr(0, 60);
    EXPECT_LT(errors.size(), 40'000u) << text.substr(0, 60);
    for (const char c : errors) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << text.substr(0, 60);
  }
}

TEST(HostileFiles, WhatIsNoFileIsReported) {
  const auto error = [](const string& path) -> string {
    try {
      load_scene(path);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  };

  const string folder = test_folder();
  EXPECT_EQ(error(folder + "/none.yaml"), folder + "/none.yaml: error: no such file\n");
  EXPECT_EQ(error(""), ": error: no such file\n");
  EXPECT_EQ(error(folder), folder + ": error: this is a folder, not a scene file\n    = name the scene file in it\n");
  ASSERT_EQ(mkfifo((folder + "/pipe").c_str(), 0600), 0);
  EXPECT_EQ(error(folder + "/pipe"),
            folder + "/pipe: error: this is not a regular file\n    = write the scene to a file and name that\n");
  EXPECT_EQ(error("/dev/zero"),
            "/dev/zero: error: this is not a regular file\n    = write the scene to a file and name that\n");
  EXPECT_NE(error(string(5000, 'x')).find("File name too long"), string::npos);

  std::filesystem::resize_file(write_file("scene: 1\n", "sparse.yaml"), 1ull << 40);
  EXPECT_EQ(
      error(folder + "/sparse.yaml"),
      folder +
          "/sparse.yaml: error: the file is larger than 32 MiB\n    = many balls of one kind are a group: `groups`\n");

  std::filesystem::remove_all(folder);
}

TEST(HostileFiles, Utf16IsNamed) {
  EXPECT_EQ(errors_of(string("\xFF\xFEs\0c\0", 6)),
            "scene.yaml: error: this is not UTF-8 text (it looks like UTF-16 or UTF-32, or is no text at all)\n    = "
            "save it as UTF-8\n");
  EXPECT_EQ(errors_of("scene: 1\ntitle: caf\xE9\n"),
            "scene.yaml:2:11: error: byte 0xE9 is not valid UTF-8\n"
            "   2 | title: caf?\n"
            "     |           ^\n"
            "     = save the file as UTF-8\n");
}

/// A scene that uses nearly every key.
const string everything = R"(scene: 1
title: "everything \u00e9"
seed: 7
gravity: [0, -9.8, 0]
restitution: {default: 0.9, combine: geometric_mean, pairs: [{between: [red, gas.1], value: 0.5}, {between: [gas, room], value: 1}]}
defaults:
  ball: {mass: 1, radius: 0.1}
  group: {arrange: lattice}
balls:
  red: {position: [0, 0, 0], velocity: [1, 0, 0], color: crimson, impulse: [0, 0, 1]}
  blue: {density: 100, position: [0, 1, 0], restitution: 0.5, color: [0, 0.5, 1]}
groups:
  gas: {count: 4, ball: {color: '#abc'}, in: {min: [1, 1, 1], max: [2, 2, 2]}, speed: 2}
  dust:
    count: 5
    ball: {radius: 0.01, mass: 1e-3}
    in: {min: [-2, -2, -2], max: [-1, -1, -1]}
    arrange: random
planes:
  floor: {point: [0, -3, 0], normal: [0, 1, 0], restitution: 0.7, visible: false}
walls:
  net: {center: [0, 0, 2.5], normal: [0, 0, 1], size: [1, 0.5], up: [1, 1, 0]}
room: {min: [-3, -3, -3], max: [3, 3, 3]}
simulate: {duration: 2.5, engine: book, step: 0.01, max_collisions: 1000, rest_speed: 1e-3}
camera: {eye: [0, 3, -5], target: [0, 0, 0], fov: 45, fov_axis: horizontal, near: 1, far: 100}
lights:
  sun: {direction: [0, -1, 0.5], intensity: 2}
  ambient: dimgray
background: '#112233'
output: {trajectory: {every: 0.1, layout: wide}, collisions: true, energy: true, frames: {fps: 10, size: [64, 48], samples: 2}, video: {file: a.mp4, crf: 20}, sheet: {columns: 2, rows: 2}}
)";

/// What may stand between the characters of a scene.
const vector<string> pieces = {": ",
                               ", ",
                               "{",
                               "}",
                               "[",
                               "]",
                               "\n",
                               "  ",
                               "- ",
                               "#",
                               "'",
                               "\"",
                               "|",
                               ">",
                               "&a ",
                               "*a",
                               "!!x ",
                               "<<: ",
                               "---\n",
                               "...\n",
                               "\t",
                               "1e999",
                               "-1",
                               ".nan",
                               "\xC3",
                               "\xF0\x9F\x8E\xB1",
                               "null",
                               "~",
                               "true",
                               "? ",
                               "0",
                               "1e9",
                               "9999999999999999999999",
                               string(1, '\0'),
                               "\\",
                               "1e-300",
                               "1e300"};

/// `everything` with up to three changes.
string mutated(Random& random) {
  string text = everything;
  const auto piece = [&] { return pieces[random.below(pieces.size())]; };

  for (uint64_t changes = 1 + random.below(3); changes > 0; --changes) {
    const uint64_t at = random.below(text.size());
    const uint64_t kind = random.below(8);
    const uint64_t length = std::min<uint64_t>(1 + random.below(12), text.size() - at);

    if (kind == 0) text.erase(at, length);
    if (kind == 1) text.insert(at, piece());
    if (kind == 2) text[at] = static_cast<char>(random.below(256));
    if (kind == 3) text.insert(random.below(text.size()), text.substr(at, length * 8));
    if (kind == 4) text.replace(at, length, piece());
    if (kind > 4 && text[at] >= '0' && text[at] <= '9') text[at] = static_cast<char>('0' + random.below(10));
    if (text.empty()) text.assign(1, 'x');
  }
  return text;
}

TEST(MutatedScenes, AreScenesOrErrors) {
  SLOW_WITH_SANITIZERS();
  ASSERT_EQ(errors_of(everything), "");
  const string path = write_file("");
  LoadOptions options;
  options.budget.bodies = 10'000;  // mutated counts are to stay cheap
  Random random(1, "mutations");
  int scenes = 0, errors = 0;

  for (int round = 0; round < 4000; ++round) {
    const string text = mutated(random);
    std::ofstream(path, std::ios::binary) << text;
    try {
      const Scene scene = load_scene(path, options);
      EXPECT_EQ(scene.initial.position.size(), scene.world.body_count());
      for (const Vec3& p : scene.initial.position) EXPECT_TRUE(p.allFinite()) << text;
      ++scenes;
    } catch (const SceneError& error) {
      EXPECT_GT(error.count, 0u);
      ++errors;
    }
  }

  EXPECT_GT(scenes, 200);  // both kinds must be met for the test to mean anything
  EXPECT_GT(errors, 1000);
  std::filesystem::remove_all(test_folder());
}

/// The two sides of settings.
const vector<string> mutated_paths = {"balls.red.position.z",
                                      "simulate.duration",
                                      "camera.fov",
                                      "output.frames.fps",
                                      "restitution.pairs.0.value",
                                      "groups.gas.in.max.x",
                                      "lights.ambient",
                                      "x",
                                      "",
                                      "balls"};
const vector<string> mutated_values = {"1",    "",     "[1, 2, 3]", "{a: b}", "{",         "'",    "*a",
                                       "&a 1", "- x",  "a: b",      "\n",     "#fff",      "true", "~",
                                       ",",    "\xFF", "\t",        "---",    "1\n---\n2", "=",    "1e999"};

TEST(MutatedScenes, SettingsAreScenesOrErrorsToo) {
  SLOW_WITH_SANITIZERS();
  const string path = write_file(everything);
  for (const string& p : mutated_paths) {
    for (const string& v : mutated_values) {
      for (const char* equals : {"=", "", ".=", ".y="}) {
        LoadOptions options;
        options.set = {p + equals + v};

        try {
          load_scene(path, options);
        } catch (const SceneError& error) {
          EXPECT_GT(error.count, 0u);
        }
      }
    }
  }

  std::filesystem::remove_all(test_folder());
}

}  // namespace
}  // namespace carom
