// Where the camera is at each instant: with a body, with a group's centre, on a path.
#include "render/moving_camera.h"

#include <gtest/gtest.h>

#include "render/eye.h"
#include "render/lighting.h"
#include "render/scenes.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size size{1280, 720};

/// The place of a point in the picture, in pixels from its middle.
Vec3 seen(const Camera& camera, const Vec3& point) {
  const Eye eye(camera, size);
  const Vec3 p = eye.point(point);
  return Vec3(p.x() / p.z() / eye.pixel, p.y() / p.z() / eye.pixel, 0);
}

/// Three balls, of which the second is three times as heavy.
Scene three_balls() {
  Scene scene;
  test::add_ball(scene, Vec3(1, 2, 3), 0.1, test::red);
  test::add_ball(scene, Vec3(-1, 0, 0), 0.2, test::green);
  test::add_ball(scene, Vec3(5, 0, 0), 0.2, test::blue);
  scene.world.mass = {1, 3, 1};
  return scene;
}

CameraPlan following(Entity first, Entity count) {
  CameraPlan plan(Camera{.eye = Vec3(1, 3, 9), .target = Vec3(1, 2, 3)});
  plan.follow = {first, count, true};
  return plan;
}

TEST(Follow, KeepsTheBodyInTheMiddleOfThePicture) {
  Scene scene = three_balls();
  scene.camera = following(0, 1);
  const MovingCamera camera(scene, size);
  EXPECT_FALSE(camera.stands_still());
  State state = scene.initial;
  for (int i = 0; i < 100; ++i) {
    state.time = 0.01 * i;
    // A parabola, and from 0.5 s on another direction: a bounce.
    const double t = state.time, after = std::max(0.0, t - 0.5);
    state.position[0] = Vec3(1 + 40 * t - 70 * after, 2 + 3 * t - 5 * t * t + 9 * after, 3 - 20 * t);
    EXPECT_LT(seen(camera.at(state), state.position[0]).norm(), 1e-9) << t;  // pixels; measured: 2e-11
    EXPECT_EQ(camera.at(state).fov, scene.camera->fov);
  }
}

TEST(Follow, ABodyBesideTheTargetStaysWhereItWasInThePicture) {
  Scene scene = three_balls();
  scene.camera = following(0, 1);
  scene.camera->target = Vec3(0.5, 2, 3);
  const MovingCamera camera(scene, size);
  const Vec3 at_start = seen(camera.at(scene.initial), scene.initial.position[0]);
  EXPECT_GT(at_start.norm(), 10);
  State state = scene.initial;
  state.position[0] += Vec3(7, -3, 100);
  EXPECT_LT((seen(camera.at(state), state.position[0]) - at_start).norm(), 1e-9);
}

TEST(Follow, AGroupIsFollowedAtItsCentreOfMass) {
  Scene scene = three_balls();
  scene.camera = following(0, 2);
  scene.camera->target = Vec3(-0.5, 0.5, 0.75);  // of 1 kg at (1, 2, 3) and 3 kg at (-1, 0, 0)
  const MovingCamera camera(scene, size);
  State state = scene.initial;
  // A collision of the two: their velocities change, their centre moves on.
  for (const double t : {0.0, 0.25, 0.5, 1.0, 2.0}) {
    state.time = t;
    const double after = std::max(0.0, t - 0.5);
    state.position[0] = Vec3(1, 2, 3) + t * Vec3(2, 0, 0) - 9 * after * Vec3(1, 0, 0);
    state.position[1] = Vec3(-1, 0, 0) + 3 * after * Vec3(1, 0, 0);
    EXPECT_LT((camera.at(state).target - Vec3(-0.5 + 0.5 * t, 0.5, 0.75)).norm(), 1e-14) << t;
    EXPECT_LT((camera.at(state).eye - camera.at(state).target - Vec3(1.5, 2.5, 8.25)).norm(), 1e-14);
  }
}

TEST(Follow, WithoutAnEyeTheBodyHasRoomAroundItFromTheFront) {
  Scene scene = three_balls();
  scene.camera = following(1, 1);
  scene.camera->follow->has_eye = false;
  scene.camera->target = scene.initial.position[1];
  const MovingCamera camera(scene, size);
  const Camera at = camera.at(scene.initial);
  EXPECT_LT(seen(at, scene.initial.position[1]).norm(), 1e-9);
  const CameraFrame view = view_of(at, size);
  EXPECT_EQ(view.right, Vec3(1, 0, 0));
  EXPECT_LT(view.forward.y(), 0);
  // The ball of 0.2 m within a ball eight times as large, which leaves a twentieth of the picture free on each side.
  const Vec3 top = scene.initial.position[1] + 8 * 0.2 * (view.up * std::cos(0.35) - view.forward * std::sin(0.35));
  EXPECT_NEAR(seen(at, top).y(), 0.9 * size.height / 2, 4);
  EXPECT_LT(at.near, (at.target - at.eye).norm() / 100);
}

TEST(Follow, AJointBodyIsFollowedAsThePartThatItWas) {
  Scene scene = three_balls();
  scene.camera = following(0, 2);
  const MovingCamera camera(scene, size);
  State apart = scene.initial;
  apart.position = {Vec3(0.4, 0, 0), Vec3(0, 0, 0), Vec3(5, 0, 0)};
  State merged = apart;
  merged.position[0] = merged.position[1] = Vec3(0.1, 0, 0);  // the centre of mass
  merged.part_of = {1, 1, 2};
  EXPECT_LT((camera.at(merged).target - camera.at(apart).target).norm(), 1e-15);
}

TEST(CameraOnAPath, IsAtItsKeyframes) {
  Scene scene = three_balls();
  CameraPlan plan;
  plan.path = {{0, Vec3(0, 1, 9), Vec3(0, 0, 0), 45}, {2, Vec3(9, 1, 0), Vec3(0, 1, 0), 30}};
  scene.camera = plan;

  const MovingCamera camera(scene, size);
  EXPECT_FALSE(camera.stands_still());

  State state = scene.initial;
  state.time = 2;
  EXPECT_EQ(camera.at(state).eye, Vec3(9, 1, 0));
  EXPECT_EQ(camera.at(state).target, Vec3(0, 1, 0));
  EXPECT_EQ(camera.at(state).fov, 30);

  state.time = 1;
  EXPECT_EQ(camera.at(state).eye, Vec3(4.5, 1, 4.5));
  EXPECT_EQ(camera.at(state).fov, 37.5);
}

TEST(CameraOnAPath, LeavesTheLightsWhereTheyWere) {
  for (const bool lamp : {false, true}) {
    Scene scene = three_balls();
    if (lamp) scene.lights.push_back({"lamp", {}, Vec3(1, 5, 2), {1, 1, 1}, 1});
    CameraPlan plan;
    plan.path = {{0, Vec3(0, 1, 9), Vec3(0, 0, 0), 45}, {2, Vec3(9, 1, 0), Vec3(0, 1, 0), 30}};
    scene.camera = plan;
    const MovingCamera camera(scene, size);

    State state = scene.initial;
    vector<Vec3> lights;  // in the world
    vector<float> radii;

    for (const double time : {0.0, 1.0, 2.0}) {
      state.time = time;
      const Eye eye(camera.at(state), size);
      raster::Shot shot;
      add_lights(scene, camera_of(scene), eye, shot);

      const raster::Float3 in_picture = shot.lighting.lamps.at(0).vector;
      const Vec3 world =
          in_picture[0] * eye.view.right + in_picture[1] * eye.view.up + in_picture[2] * eye.view.forward;
      lights.push_back(lamp ? Vec3(world + eye.camera.eye) : world);
      radii.push_back(shot.lighting.lamp_radius);
    }

    for (const Vec3& light : lights) EXPECT_LT((light - lights[0]).norm(), 1e-5);  // floats
    for (const float radius : radii) EXPECT_EQ(radius, radii[0]);
  }
}

TEST(CameraThatGoesRound, IsBackAfterItsPeriodAndKeepsItsDistance) {
  Scene scene = three_balls();
  CameraPlan plan(Camera{.eye = Vec3(1, 3, 9), .target = Vec3(1, 2, 3)});
  plan.orbit = 8;
  scene.camera = plan;

  const MovingCamera camera(scene, size);
  EXPECT_FALSE(camera.stands_still());
  State state = scene.initial;
  EXPECT_EQ(camera.at(state).eye, plan.eye);
  state.time = 2;  // a quarter: from the front (+z) to the right (+x)
  EXPECT_LT((camera.at(state).eye - Vec3(7, 3, 3)).norm(), 1e-14);
  state.time = 8;
  EXPECT_LT((camera.at(state).eye - plan.eye).norm(), 1e-14);
  EXPECT_EQ(camera.at(state).target, plan.target);
}

TEST(ParallelProjection, ShowsThingsAtAnyDepthInOneSize) {
  Scene scene = three_balls();
  CameraPlan plan(Camera{.eye = Vec3(0, 0, 9), .target = Vec3(0, 0, 0)});
  const auto height = [&](const Vec3& from, const Vec3& to) {
    scene.camera = plan;
    const Camera camera = MovingCamera(scene, size).at(scene.initial);
    return (seen(camera, to) - seen(camera, from)).norm();
  };
  const double at_target = height(Vec3(0, 0, 0), Vec3(0, 1, 0));
  EXPECT_GT(height(Vec3(0, 0, 4.5), Vec3(0, 1, 4.5)), 1.9 * at_target);

  plan.orthographic = true;
  EXPECT_NEAR(height(Vec3(0, 0, 0), Vec3(0, 1, 0)), at_target, 1e-6 * at_target);
  for (const double z : {-4.5, 4.5})
    EXPECT_NEAR(height(Vec3(0, 0, z), Vec3(0, 1, z)), at_target, 0.00051 * at_target);  // measured: 0.0005
  const Camera camera = MovingCamera(scene, size).at(scene.initial);
  EXPECT_NEAR((camera.eye - camera.target).norm() - camera.near, 9 - plan.near, 1e-9);
}

TEST(StillCamera, IsTheScenesOwnAtAllTimes) {
  Scene scene = three_balls();
  scene.camera = Camera{.eye = Vec3(0, 1, 9), .target = Vec3(0, 0, 0)};
  const MovingCamera camera(scene, size);
  EXPECT_TRUE(camera.stands_still());
  State state = scene.initial;
  state.time = 5;
  state.position[0] = Vec3(99, 0, 0);
  EXPECT_EQ(camera.at(state), static_cast<const Camera&>(*scene.camera));
}

}  // namespace
}  // namespace carom
