#include "render/camera.h"

#include <gtest/gtest.h>

#include "render/scenes.h"
#include "scene/scene.h"

namespace carom {
namespace {

Camera camera_at(const Vec3& eye, const Vec3& target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  return camera;
}

TEST(ViewOf, FromTheBookCameraPlusXIsOnTheLeft) {
  const CameraFrame view = view_of(camera_at(Vec3(0, 3, -5), Vec3::Zero()), {1280, 720});
  EXPECT_EQ(view.right.x(), -1);
  EXPECT_GT(view.up.y(), 0.8);
}

TEST(ViewOf, FromTheFrontPlusXIsOnTheRight) {
  EXPECT_EQ(view_of(camera_at(Vec3(0, 3, 5), Vec3::Zero()), {1280, 720}).right.x(), 1);
}

TEST(ViewOf, LookingStraightDownKeepsPlusXToTheRight) {
  const CameraFrame down = view_of(camera_at(Vec3(0, 5, 0), Vec3::Zero()), {100, 100});
  EXPECT_EQ(down.right, Vec3(1, 0, 0));
  EXPECT_EQ(down.up, Vec3(0, 0, -1));
  const CameraFrame up = view_of(camera_at(Vec3(0, -5, 0), Vec3::Zero()), {100, 100});
  EXPECT_EQ(up.right, Vec3(1, 0, 0));
}

TEST(ViewOf, UpAlongAnySightLineStillGivesAFrame) {
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, -2, 3)}) {
    Camera camera = camera_at(Vec3::Zero(), axis);
    camera.up = axis;
    const CameraFrame view = view_of(camera, {100, 100});
    EXPECT_NEAR(view.right.norm(), 1, 1e-15);
    EXPECT_NEAR(view.right.dot(view.forward), 0, 1e-15);
    EXPECT_NEAR(view.up.dot(view.forward), 0, 1e-15);
  }
}

TEST(ViewOf, BothAnglesFollowFromOneAndTheAspect) {
  Camera camera = camera_at(Vec3(0, 0, 5), Vec3::Zero());
  camera.fov = 90;  // tan 45 = 1, so the other half angle is atan of the aspect
  const CameraFrame vertical = view_of(camera, {200, 100});
  EXPECT_NEAR(vertical.fov_y, 90, 1e-12);
  EXPECT_NEAR(vertical.fov_x, 126.86989764584402, 1e-12);  // 2 atan 2
  camera.fov_horizontal = true;
  const CameraFrame horizontal = view_of(camera, {200, 100});
  EXPECT_NEAR(horizontal.fov_x, 90, 1e-12);
  EXPECT_NEAR(horizontal.fov_y, 53.13010235415598, 1e-12);  // 2 atan 1/2
}

TEST(SphereInView, DecidesAtEveryFaceByTheDistance) {
  Camera camera = camera_at(Vec3::Zero(), Vec3(0, 0, -1));
  camera.fov = 90;
  camera.near = 1;
  camera.far = 10;
  const CameraFrame view = view_of(camera, {100, 100});

  EXPECT_TRUE(is_sphere_in_view(camera, view, Vec3(0, 0, -5), 0.1));
  EXPECT_TRUE(is_sphere_in_view(camera, view, Vec3(6, 0, -5), 0.708));  // 1 / sqrt 2 from the right face
  EXPECT_FALSE(is_sphere_in_view(camera, view, Vec3(6, 0, -5), 0.707));
  EXPECT_TRUE(is_sphere_in_view(camera, view, Vec3(0, -6, -5), 0.708));
  EXPECT_FALSE(is_sphere_in_view(camera, view, Vec3(0, -6, -5), 0.707));

  EXPECT_TRUE(is_sphere_in_view(camera, view, Vec3(0, 0, -0.5), 0.5));  // near
  EXPECT_FALSE(is_sphere_in_view(camera, view, Vec3(0, 0, -0.5), 0.49));
  EXPECT_TRUE(is_sphere_in_view(camera, view, Vec3(0, 0, -11), 1));  // far
  EXPECT_FALSE(is_sphere_in_view(camera, view, Vec3(0, 0, -11), 0.99));
  EXPECT_FALSE(is_sphere_in_view(camera, view, Vec3(0, 0, 5), 1));  // behind
}

TEST(SphereInView, BeyondACornerItIsTheCornerThatCounts) {
  Camera camera = camera_at(Vec3::Zero(), Vec3(0, 0, -1));
  camera.fov = 90;
  camera.near = 1;
  camera.far = 10;
  const CameraFrame view = view_of(camera, {100, 100});
  // (11, 0, -10) lies 1/sqrt 2 beyond the right face's plane, but 1 from the far edge at (10, 0, -10)... of its line
  // the nearest point is (10.5, 0, -10.5), out of reach.
  EXPECT_FALSE(is_sphere_in_view(camera, view, Vec3(11, 0, -10), 0.99));
  EXPECT_TRUE(is_sphere_in_view(camera, view, Vec3(11, 0, -10), 1.01));
}

TEST(CameraOf, TheScenesOwnCameraIsTaken) {
  const Scene scene = test::bowling_balls();
  EXPECT_EQ(camera_of(scene).eye, Vec3(0, 3, -5));
}

TEST(CameraOf, WithoutOneAllBodiesAreWhollyInThePicture) {
  Scene scene = test::gas(200);
  const Camera camera = camera_of(scene);
  const CameraFrame view = view_of(camera, {1280, 720});

  EXPECT_EQ(view.right, Vec3(1, 0, 0));
  EXPECT_LT(view.forward.y(), 0);  // looks slightly down
  const double tx = std::tan(view.fov_x * M_PI / 360), ty = std::tan(view.fov_y * M_PI / 360);

  for (const Vec3& p : scene.initial.position) {
    const Vec3 d = p - camera.eye;
    const double z = view.forward.dot(d);
    EXPECT_GT(z, camera.near);
    EXPECT_LT(std::abs(view.right.dot(d)), z * tx);
    EXPECT_LT(std::abs(view.up.dot(d)), z * ty);
  }
}

TEST(CameraOf, TheFloorUnderABallIsInThePicture) {
  Scene scene;
  test::add_ball(scene, Vec3(0, 2, 0), 0.5, {});
  test::add_plane(scene, Vec3::Zero(), Vec3(0, 1, 0), {});
  const Camera camera = camera_of(scene);
  EXPECT_TRUE(is_sphere_in_view(camera, view_of(camera, {1280, 720}), Vec3(0, 0, 0), 1e-6));
}

TEST(CameraOf, EmptyAndPointlikeScenesGiveAUsableCamera) {
  Scene scene;
  for (int i = 0; i < 2; ++i) {
    const Camera camera = camera_of(scene);
    const CameraFrame view = view_of(camera, {1280, 720});
    EXPECT_TRUE(camera.eye.allFinite());
    EXPECT_GT(camera.near, 0);
    EXPECT_GT((camera.target - camera.eye).norm(), 0);
    EXPECT_NEAR(view.right.norm(), 1, 1e-12);
    test::add_ball(scene, Vec3(1e6, 0, 0), 1e-3, {});
  }
}

}  // namespace
}  // namespace carom
