#include "render/camera_path.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

vector<Keyframe> keys() {
  return {{0.5, Vec3(5, 1, 0), Vec3(0, 0, 0), 40},
          {1, Vec3(0, 2, 5), Vec3(0, 1, 0), 30},
          {3, Vec3(-5, 3, 0), Vec3(0, 1, 1), 30},
          {3.25, Vec3(-6, 3, 0), Vec3(0, 1, 1), 60}};
}

TEST(CameraPath, PassesThroughItsKeyframesAndStandsStillOutside) {
  const CameraPath path(keys());
  for (const Keyframe& key : keys()) {
    const Keyframe at = path.at(key.at);
    EXPECT_EQ(at.eye, key.eye);
    EXPECT_EQ(at.target, key.target);
    EXPECT_EQ(at.fov, key.fov);
  }
  EXPECT_EQ(path.at(0).eye, keys().front().eye);
  EXPECT_EQ(path.at(99).eye, keys().back().eye);
}

TEST(CameraPath, IsSmoothAndStaysBetweenItsKeyframes) {
  const CameraPath path(keys());

  // Its velocity, by differences over h, has no jump.
  const double h = 1e-4;
  Vec3 before = Vec3::Zero();
  double largest = 0;
  for (double t = 0; t < 4; t += h) {
    const Vec3 velocity = (path.at(t + h).eye - path.at(t).eye) / h;
    largest = std::max(largest, (velocity - before).norm());
    before = velocity;
  }
  EXPECT_LT(largest, 0.02);  // measured: 0.016, where the acceleration is greatest; a corner there would give 1 or more

  for (double t = 1; t < 3; t += 0.01) {
    const Vec3 eye = path.at(t).eye;
    EXPECT_TRUE((eye.array() >= Vec3(-5, 2, 0).array()).all() && (eye.array() <= Vec3(0, 3, 5).array()).all());
    EXPECT_EQ(path.at(t).fov, 30);
  }
}

TEST(CameraPath, ASingleKeyframeIsAStillCamera) {
  const CameraPath path({keys().front()});
  for (const double t : {0.0, 0.5, 7.0}) EXPECT_EQ(path.at(t).eye, keys().front().eye);
}

}  // namespace
}  // namespace carom
