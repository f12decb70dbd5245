#include <gtest/gtest.h>

#include "export/export_testing.h"
#include "export/forecast.h"
#include "numerics/whole.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

TEST(Forecast, CountsWhatARunWillWrite) {
  Scene scene = small_scene();
  EXPECT_TRUE(forecast(scene).tables.empty());
  EXPECT_EQ(forecast(scene).frames, 0u);

  scene.output.trajectory = TrajectoryOutput{0.01, false};
  EXPECT_EQ(forecast(scene).tables.at(0).rows, 84u);  // 21 instants of 4 bodies

  scene.output.frames = FramesOutput{30, {1280, 720}, 4, 0, {}};
  EXPECT_EQ(forecast(scene).frames, 7u);
  scene.output.video = VideoOutput{};
  EXPECT_EQ(forecast(scene).frames, 7u);  // the same pictures

  scene.output.video->fps = 60;
  EXPECT_EQ(forecast(scene).frames, 7u + 13u);
  scene.output.sheet = SheetOutput{4, 3};
  EXPECT_EQ(forecast(scene).frames, 7u + 13u + 12u);
}

TEST(Forecast, BytesAreOfTheRightSize) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.simulate.duration = 10;
  scene.output.trajectory = TrajectoryOutput{0.01, false};
  scene.output.energy = EnergyOutput{0.01};
  for (auto* vectors : {&scene.initial.position, &scene.initial.velocity})
    for (Vec3& v : *vectors) v = Vec3(1.0 / 3, 1.0 / 7, -1.0 / 11);
  run(scene, temp / "run");
  double bytes = 0;
  for (const string& name : names_in(temp / "run")) bytes += static_cast<double>(fs::file_size(temp / "run/" + name));
  EXPECT_NEAR(static_cast<double>(forecast(scene).bytes) / bytes, 1, 0.2);
}

TEST(Forecast, BytesFollowTheFormatOfTables) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.simulate.duration = 10;
  scene.output.trajectory = TrajectoryOutput{0.01, false};
  for (auto* vectors : {&scene.initial.position, &scene.initial.velocity})
    for (Vec3& v : *vectors) v = Vec3(1.0 / 3, 1.0 / 7, -1.0 / 11);
  const auto plain = static_cast<double>(forecast(scene).bytes);
  scene.output.tables.format = TablesOutput::Format::gzip;
  EXPECT_NEAR(static_cast<double>(forecast(scene).bytes) / plain, 0.4, 0.01);
  scene.output.tables.format = TablesOutput::Format::xlsx;
  EXPECT_NEAR(static_cast<double>(forecast(scene).bytes) / plain, 1.7, 0.01);
}

TEST(Forecast, SenselessRequestsDoNotOverflow) {
  Scene scene = small_scene();
  scene.simulate.duration = 1e300;
  scene.output.trajectory = TrajectoryOutput{1e-300, false};
  scene.output.frames = FramesOutput{1e300, {16384, 16384}, 4, 0, {}};
  EXPECT_GT(forecast(scene).tables.at(0).rows, uint64_t{1} << 53);
  EXPECT_GE(forecast(scene).frames, uint64_t{1} << 53);
  EXPECT_EQ(forecast(scene).bytes, static_cast<uint64_t>(most_whole));
}

}  // namespace
}  // namespace carom
