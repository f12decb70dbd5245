// The table of outputs, from which --only, the manifest, the folder's files and the reserved names are made.
#include "scene/output_kinds.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scene/fields.h"
#include "scene/film_layout.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

TEST(Outputs, AreTheKeysOfOutputInTheTableOfFields) {
  vector<string_view> keys, names;
  for (const Field& field : kind_named("output").fields) keys.push_back(field.key);
  for (const OutputKind& kind : output_kinds()) names.push_back(kind.name);
  // How all tables are written.
  names.emplace_back("tables");
  EXPECT_EQ(names, keys);
}

TEST(Outputs, FilesOfTablesFollowTheirFormat) {
  Output output;
  output.energy.emplace();
  output.sheet.emplace();
  EXPECT_EQ(output_files(output), (vector<string>{"energy.csv", "sheet.png"}));
  output.tables.format = TablesOutput::Format::gzip;
  EXPECT_EQ(output_files(output), (vector<string>{"energy.csv.gz", "sheet.png"}));
  output.tables.format = TablesOutput::Format::xlsx;
  EXPECT_EQ(output_files(output), (vector<string>{"energy.csv", "sheet.png", "tables.xlsx"}));
  EXPECT_EQ(restricted(output, {"collisions"}).tables, output.tables);
  for (const char* name : {"energy.csv.gz", "energy.csv", "tables.xlsx"}) EXPECT_TRUE(is_reserved(name)) << name;
  EXPECT_FALSE(is_reserved("sheet.png.gz"));
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

TEST(Video, TakesAChartOfEnergyMomentumOrABody) {
  const string ball = start + "balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}}\n";
  const string gas =
      "groups: {gas: {count: 3, in: {min: [5, 5, 5], max: [9, 9, 9]}, ball: {mass: 1, radius: 0.1}}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";
  const auto chart = [&](const string& beside) {
    return load_text(ball + gas + "output: {video: {beside: " + beside + "}}\n").output.video->chart.value();
  };
  EXPECT_EQ(chart("energy").kind, ChartSubject::Kind::energy);
  EXPECT_EQ(chart("momentum").kind, ChartSubject::Kind::momentum);
  EXPECT_EQ(chart("x(red)"), (ChartSubject{ChartSubject::Kind::body, Quantity::x, 0}));
  EXPECT_EQ(chart("speed(gas.2)"), (ChartSubject{ChartSubject::Kind::body, Quantity::speed, 3}));
  EXPECT_EQ(chart("kinetic(gas.0)").quantity, Quantity::kinetic);

  const auto refused = [&](const string& video) {
    return errors_of(ball + gas + "output: {video: {" + video + "}}\n");
  };
  EXPECT_NE(refused("beside: energies").find("`energies` is no chart"), string::npos);
  EXPECT_NE(refused("beside: x_m(red)").find("is no chart"), string::npos);
  EXPECT_NE(refused("beside: x(rd)").find("did you mean `red`?"), string::npos);
  EXPECT_NE(refused("beside: x(gas)").find("`gas` stands for 3 bodies: a chart shows one"), string::npos);
  EXPECT_NE(refused("beside: x(floor)").find("`floor` is a fixed thing: a chart shows a body"), string::npos);
  EXPECT_NE(refused("beside: energy, size: [64, 36]").find("a film of 64 x 36 pixels has no room for a chart"),
            string::npos);
}

TEST(Video, WithATitleNeedsOneOfTheScene) {
  const string errors = errors_of(start + "output: {video: {title: true}}\n");
  EXPECT_NE(errors.find("the film is to begin with the scene's title, and the scene has none"), string::npos) << errors;
  EXPECT_EQ(errors_of(start + "title: A\noutput: {video: {title: true}}\n"), "");
  EXPECT_EQ(errors_of(start + "output: {video: {title: false}}\n"), "");
}

TEST(Video, OfFilmsWithChartsHaveAPictureInTwoThirds) {
  VideoOutput video;
  EXPECT_EQ(layout_of(video).picture, (Size{1280, 720}));
  video.chart.emplace();
  EXPECT_EQ(layout_of(video).picture, (Size{854, 720}));
  EXPECT_EQ(layout_of(video).chart, (Size{426, 720}));
  EXPECT_EQ(layout_of(video).left, 854);
  video.size = {1080, 1080};
  EXPECT_EQ(layout_of(video).picture, (Size{1080, 720}));
  EXPECT_EQ(layout_of(video).top, 720);
}

}  // namespace
}  // namespace carom
