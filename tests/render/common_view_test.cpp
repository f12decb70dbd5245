// One camera for several motions.
#include "render/common_view.h"

#include <gtest/gtest.h>

#include <random>

#include "render/eye.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size wide{1280, 720};

/// A camera that looks down a little, as those do that frame a motion.
Camera camera_at(const Vec3& eye, double distance, double slope = 0.3) {
  Camera camera;
  camera.eye = eye;
  camera.target = eye + distance * Vec3(0, -slope, -1).normalized();
  return camera;
}

/// The parts of half the picture at which a point is seen, to the right and up.
pair<double, double> seen_at(const Camera& camera, const Vec3& point) {
  const Eye eye(camera, wide);
  const Vec3 p = eye.point(point);
  EXPECT_GT(p.z(), 0);
  return {p.x() / (p.z() * eye.tan_x), p.y() / (p.z() * eye.tan_y)};
}

TEST(CommonView, OfOneCameraIsItsOwn) {
  const Camera camera = camera_at({1, 2, 5}, 4);
  const Camera common = common_view(span(&camera, 1), wide);
  EXPECT_LT((common.eye - camera.eye).norm(), 1e-12);
  EXPECT_LT((common.target - camera.target).norm(), 1e-12);
  EXPECT_EQ(common.fov, camera.fov);
}

TEST(CommonView, HasAllInViewThatEachCameraHas) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int round = 0; round < 50; ++round) {
    vector<Camera> cameras;
    for (int i = 0; i < 3; ++i)
      cameras.push_back(
          camera_at(5 * Vec3(anywhere(random), anywhere(random), anywhere(random)), 3 + 2 * anywhere(random)));
    const Camera common = common_view(cameras, wide);

    // Points of all pictures, at all depths.
    double widest = 0;
    for (const Camera& camera : cameras) {
      const Eye eye(camera, wide);
      for (int i = 0; i < 40; ++i) {
        const double depth = 4 + 3.9 * anywhere(random);
        const double x = i < 4 ? (i & 1 ? 1 : -1) : anywhere(random), y = i < 4 ? (i & 2 ? 1 : -1) : anywhere(random);

        const Vec3 point =
            camera.eye + depth * (eye.view.forward + x * eye.tan_x * eye.view.right + y * eye.tan_y * eye.view.up);
        const auto [right, up] = seen_at(common, point);
        widest = max({widest, std::abs(right), std::abs(up)});
      }
    }
    EXPECT_LT(widest, 1 + 1e-9);
    EXPECT_GT(widest, 1 - 1e-9) << "it is no farther away than needed";
  }
}

TEST(CommonView, OfOtherDirectionsHasTheirTargetsInView) {
  const vector<Camera> cameras = {camera_at({0, 1, 5}, 5), camera_at({2, 3, 4}, 5, 0.6)};
  const Camera common = common_view(cameras, wide);
  for (const Camera& camera : cameras) {
    const auto [right, up] = seen_at(common, camera.target);
    EXPECT_LT(max(std::abs(right), std::abs(up)), 1);
  }
}

}  // namespace
}  // namespace carom
