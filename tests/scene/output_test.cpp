// The table of outputs, from which --only, the manifest, the folder's files and the reserved names are made.
#include "scene/output_kinds.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scene/fields.h"
#include "std.h"

namespace carom {
namespace {

TEST(Outputs, AreTheKeysOfOutputInTheTableOfFields) {
  vector<string_view> keys, names;
  for (const Field& field : kind_named("output").fields) keys.push_back(field.key);
  for (const OutputKind& kind : output_kinds()) names.push_back(kind.name);
  EXPECT_EQ(names, keys);
}

TEST(Outputs, EachIsRequestedOnceItIsAddedAndNoOtherIs) {
  for (const OutputKind& added : output_kinds()) {
    const Output output = restricted({}, {string(added.name)});
    for (const OutputKind& kind : output_kinds()) {
      EXPECT_EQ(kind.asked(output), kind.name == added.name) << added.name << ", " << kind.name;
      EXPECT_EQ(holds_all(output, {string(kind.name)}), kind.name == added.name);
      EXPECT_TRUE(kind.asked(with_all(output)));
    }
  }
}

TEST(Outputs, HaveDefaultSettingsOfTheTableOfFields) {
  // --only adds the output that `name: true` requests.
  for (const OutputKind& kind : output_kinds()) {
    const nlohmann::ordered_json settings = kind.settings(with_all({}));
    if (settings.is_boolean()) continue;
    for (const auto& [key, value] : settings.items()) {
      const Field* field = find_field(kind_named(kind.name), key);
      ASSERT_NE(field, nullptr) << kind.name << " has no key " << key;

      if (field->initial.empty())
        EXPECT_TRUE(value.is_null()) << kind.name << "." << key;
      else if (value.is_string())
        EXPECT_EQ(value.get<string>(), field->initial);
      else
        EXPECT_EQ(value, nlohmann::ordered_json::parse(field->initial)) << kind.name << "." << key;
    }
  }
}

TEST(Outputs, KeepTheirSettingsAndTakeThoseOfTheirLike) {
  Output requested;
  requested.energy = EnergyOutput{0.5};
  requested.frames = FramesOutput{12, {64, 32}, 2, 1, 3.0};
  const Output output = restricted(requested, {"energy", "video"});
  EXPECT_EQ(output.energy->every, 0.5);
  EXPECT_FALSE(output.frames);
  EXPECT_EQ(output.video->fps, 12);
  EXPECT_EQ(output.video->size.width, 64);
  EXPECT_EQ(output.video->samples, 2);
  EXPECT_EQ(output.video->from, 0);
  EXPECT_EQ(output.video->until, nullopt);
}

TEST(Outputs, NoTwoHaveAFileOfTheSameName) {
  vector<string> names = output_files(with_all({}));
  for (const OutputKind& kind : output_kinds())
    if (!kind.series.folder.empty()) names.emplace_back(kind.series.folder);
  ranges::sort(names);
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  for (const string& name : names) EXPECT_EQ(is_reserved(name), name != VideoOutput{}.file) << name;
}

TEST(Outputs, ASeriesRecognisesItsOwnNames) {
  EXPECT_EQ(frame_files.name(7), "frame_00007.png");
  EXPECT_EQ(frame_files.name(1234567), "frame_1234567.png");
  for (const char* name : {"frame_00007.png", "frame_1234567.png"}) EXPECT_TRUE(frame_files.has(name));
  for (const char* name : {"frame_0007.png", "frame_0000x.png", "frame_.png", "x_00007.png", "frame_00007.pn"})
    EXPECT_FALSE(frame_files.has(name)) << name;
}

}  // namespace
}  // namespace carom
