// Consistency of the table of fields.
#include "scene/fields.h"
#include "scene/path_field.h"

#include "scene/scenes_in_text.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

TEST(Fields, EveryRowIsComplete) {
  set<string_view> names;
  for (const Kind& kind : kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_FALSE(kind.doc.empty()) << kind.name;

    set<string_view> keys;
    for (const Field& field : kind.fields) {
      EXPECT_TRUE(keys.insert(field.key).second) << kind.name << "." << field.key;
      EXPECT_TRUE(field.doc.ends_with('.')) << kind.name << "." << field.key;
      EXPECT_FALSE(expected(field).empty());

      for (const string_view rival : rivals(field)) {
        const Field* other = find_field(kind, rival);
        ASSERT_NE(other, nullptr) << kind.name << "." << field.key;
        const vector<string_view> its = rivals(*other);
        EXPECT_NE(ranges::find(its, field.key), its.end())
            << kind.name << ": " << rival << " does not exclude " << field.key;
      }

      for (const string_view key : parts_of(field.spared_by)) EXPECT_NE(find_field(kind, key), nullptr) << key;
      if (holds_map(field) || field.type == Type::named || field.type == Type::list) {
        EXPECT_EQ(field.held->name, field.of);
      }
      if (field.type == Type::choice) {
        EXPECT_GE(choices(field).size(), 1u);
      }
    }
  }
}

TEST(Fields, DefaultsAreInTheirRange) {
  for (const Kind& kind : kinds()) {
    for (const Field& field : kind.fields) {
      if (field.initial.empty()) continue;
      const Node& node = *field.member.initial_node;

      if (field.type == Type::number || field.type == Type::whole) {
        ASSERT_TRUE(as_number(&node)) << field.key;
        EXPECT_TRUE(contains(field.range, *as_number(&node))) << field.key;
      } else if (field.type == Type::vector || field.type == Type::direction) {
        EXPECT_TRUE(as_vector(&node)) << field.key;
      } else if (field.type == Type::color) {
        EXPECT_TRUE(as_color(&node)) << field.key;
      }
    }
  }
}

TEST(Fields, EveryKeyOfAThingFillsAMember) {
  for (const Kind& kind : kinds()) {
    if (kind.name == "scene" || kind.name == "defaults") continue;
    for (const Field& field : kind.fields) {
      // Lists, maps in whose place a list may stand, and a group's ball, which has defaults of its own.
      // Repeated things are replaced by their members before maps fill structs.
      if (field.type == Type::list || field.plain == "windows" || field.of == "member" || field.type == Type::repeat)
        continue;
      EXPECT_NE(field.member.fill, nullptr) << kind.name << "." << field.key;
    }
  }
}

TEST(Fields, DefaultOfATableIsAThirtiethOfASecondToTheLastBit) {
  EXPECT_EQ(parse_number(find_field(kind_named("trajectory"), "every")->initial), 1.0 / 30);
}

TEST(Numbers, AreReadAsYamlWritesThem) {
  EXPECT_EQ(parse_number("1"), 1);
  EXPECT_EQ(parse_number("+1.5e0"), 1.5);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  EXPECT_EQ(parse_number("5."), 5);
  EXPECT_EQ(parse_number("1e3"), 1000);
  EXPECT_EQ(parse_number("0.1"), 0.1);
  EXPECT_EQ(parse_number("0e0"), 0);
  EXPECT_EQ(parse_number("5e-324"), 5e-324);

  for (const char* text :
       {"",    "+",   "-",  ".",  "e5",   "1e",  "1e+", "--1",  "+-1",      "01",    "-01.5",  "0x1",
        "1,5", "1 2", " 1", "1 ", ".nan", "nan", "inf", "-inf", "infinity", "1e999", "1e-999", "1.5.2"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Wholes, MayBeWrittenWithAnExponent) {
  EXPECT_EQ(parse_whole("18446744073709551615"), 18446744073709551615ull);
  EXPECT_EQ(parse_whole("1e6"), 1'000'000u);
  EXPECT_EQ(parse_whole("2.0"), 2u);
  for (const char* text : {"-1", "1.5", "18446744073709551616", "1e17", "01", "", "x"})
    EXPECT_FALSE(parse_whole(text)) << text;
}

TEST(Booleans, AreTrueAndFalseOnly) {
  for (const char* text : {"yes", "no", "on", "True", "TRUE", "1", "'true'", "~"}) {
    EXPECT_NE(errors_of(start + "output: {collisions: " + text + "}\n").find("expected true or false"), string::npos)
        << text;
  }
}

TEST(Fields, OfPicturesAloneAreKnownByTheirPaths) {
  for (const char* path :
       {"camera", "camera.eye.y", "lights.sun.direction", "lights.ambient", "background", "caption", "trails.seconds",
        "arrows", "flash", "shutter", "balls.red.color", "balls.red.color.by", "groups.gas.ball.color",
        "defaults.ball.color.map", "planes.floor.visible", "forces.0.visible", "bodies.duck.mesh"})
    EXPECT_TRUE(is_drawn(path)) << path;
  for (const char* path : {"", "title", "output.frames.fps", "balls.color.mass", "balls.mesh", "planes.visible.normal",
                           "forces.0.drag.linear", "simulate.duration", "no_key"})
    EXPECT_FALSE(is_drawn(path)) << path;
}

TEST(Paths, HaveWords) {
  const pair<const char*, const char*> words[] = {{"restitution.default", "Default coefficient of restitution"},
                                                  {"balls.red.position.z", "red: position z"},
                                                  {"defaults.ball.mass", "ball: mass"},
                                                  {"groups.gas.ball.radius", "gas: radius"},
                                                  {"let.r", "r"},
                                                  {"gravity.y", "Gravity y"},
                                                  {"simulate.rest_speed", "Rest speed"},
                                                  {"forces.0.drag.linear", "force 0: linear"},
                                                  {"seed", "Seed"}};
  for (const auto& [path, text] : words) EXPECT_EQ(words_of(path), text);
}

}  // namespace
}  // namespace carom
