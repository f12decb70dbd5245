// Cameras that frame the motion, of real scenes.
#include "run/survey.h"

#include <gtest/gtest.h>

#include "engine/engine.h"
#include "export/picture_streams.h"
#include "paths.h"
#include "physics/world.h"
#include "render/camera.h"
#include "run/run_testing.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

Camera surveyed(const Scene& scene, Size size = {1280, 720}) {
  MovingCamera camera(scene, size);
  MovingCamera* const cameras[] = {&camera};
  survey(cameras, *make_simulator(scene, {.collisions = true}), [] {});
  return camera.at(scene.initial);
}

/// How far bodies extend at all instants of pictures: the largest part of half the picture's width or height.
double filled(const Scene& scene, const Camera& camera, Size size = {1280, 720}) {
  const CameraFrame view = view_of(camera, size);
  const double tan_x = std::tan(view.fov_x * M_PI / 360), tan_y = std::tan(view.fov_y * M_PI / 360);

  const auto part = [](double across, double depth, double radius, double tangent) {
    return std::tan(std::atan2(std::abs(across), depth) + std::asin(radius / hypot(across, depth))) / tangent;
  };

  double most = 0;
  const auto simulator = make_simulator(scene);
  const PictureStreams plan = plan_pictures(scene);
  for (int64_t i = plan.ticks.front().first(); i <= plan.ticks.front().last(); ++i) {
    while (simulator->time() < plan.ticks.front().at(i)) simulator->advance_to(plan.ticks.front().at(i));

    const State& state = simulator->state();
    for (Entity body = 0; body < scene.world.body_count(); ++body) {
      const Vec3 p = state.position[body] - camera.eye;
      const double x = view.right.dot(p), y = view.up.dot(p), z = view.forward.dot(p);
      const double radius = scene.world.radius[body];
      EXPECT_TRUE(z - radius > camera.near && z + radius < camera.far);
      most = std::max({most, part(x, z, radius, tan_x), part(y, z, radius, tan_y)});
    }
  }
  return most;
}

class SceneWithoutCamera : public ::testing::TestWithParam<const char*> {};

TEST_P(SceneWithoutCamera, HasAllBodiesInViewAtAllPicturesAndFillsThem) {
  Scene scene = scene_at(SCENES_DIR "/" + string(GetParam()) + ".yaml");
  scene.camera.reset();
  const double most = filled(scene, surveyed(scene));
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 0.75);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneWithoutCamera,
                         ::testing::Values("bouncing_ball", "billiard_break", "ten_pins", "wall_fly_over", "gust",
                                           "clay", "two_bowling_balls", "restitution_row", "newtons_cradle_gap",
                                           "gas_in_a_room", "crates"),
                         [](const auto& scene) { return string(scene.param); });

const string marble_run =
    "scene: 1\nballs: {marble: {mass: 0.01, radius: 0.02, position: [-1.5, 1.62, 0], velocity: [0.8, 0, 0], "
    "restitution: 0.6}}\nobstacles:\n  first: {box: [0.6, 0.04, 0.3], position: [-1.3, 1.5, 0]}\n"
    "  second: {box: [0.6, 0.04, 0.3], position: [-0.6, 1.2, 0]}\n  third: {box: [0.6, 0.04, 0.3], position: [0.1, "
    "0.9, "
    "0]}\nplanes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 4}\n";

TEST(Survey, FramesTheWindowsThatAreShown) {
  const RunPlace place;
  const Scene early = place.scene(marble_run + "output: {video: {until: 0.5}}\n");
  const Scene whole = place.scene(marble_run + "output: {video: true}\n");
  EXPECT_LT((surveyed(early).eye - surveyed(early).target).norm(),
            0.5 * (surveyed(whole).eye - surveyed(whole).target).norm());
  const Scene both = place.scene(marble_run + "output: {video: {from: 0, until: 0.5}, frames: {from: 0.5}}\n");
  EXPECT_NEAR((surveyed(both).eye - surveyed(whole).eye).norm(), 0, 1e-12);
}

// The drops are in the air for most of the film. The view of their collisions alone would show them larger, and nothing
// at first.
TEST(Survey, HasALongFallBeforeTheFirstCollisionInView) {
  Scene scene = scene_at(SCENES_DIR "/raindrops.yaml");
  scene.camera.reset();
  const Size size{540, 960};
  EXPECT_LT(filled(scene, surveyed(scene, size), size), 1);
}

TEST(Survey, SeesFromAboveWhatThingsOnATableWouldHide) {
  Scene scene = scene_at(SCENES_DIR "/pinball.yaml");
  scene.camera.reset();
  MovingCamera camera(scene, {720, 960});
  MovingCamera* const cameras[] = {&camera};
  survey(cameras, *make_simulator(scene, {.collisions = true}), [] {});
  const Camera at_start = camera.at(scene.initial);
  EXPECT_TRUE(camera.faded().empty());
  EXPECT_NEAR((at_start.target - at_start.eye).normalized().y(), -std::sin(85 * M_PI / 180), 1e-12);
}

// From above, between the walls, nothing would be hidden, and nothing of the fall be seen.
TEST(Survey, SeesAnUprightMotionThroughTheWallBeforeIt) {
  const RunPlace place;
  const Scene scene = place.scene(
      "scene: 1\nballs: {b: {mass: 1, radius: 0.05, position: [0, 1, 0], restitution: 0.8}}\n"
      "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nwalls:\n"
      "  front: {center: [0, 1, 0.2], normal: [0, 0, 1], size: [3, 2]}\n"
      "  back: {center: [0, 1, -0.2], normal: [0, 0, 1], size: [3, 2]}\n"
      "simulate: {duration: 2}\noutput: {video: true}\n");

  MovingCamera camera(scene, {1280, 720});
  MovingCamera* const cameras[] = {&camera};
  survey(cameras, *make_simulator(scene, {.collisions = true}), [] {});
  EXPECT_EQ(camera.faded(), vector<uint32_t>{1});
  const Camera at_start = camera.at(scene.initial);
  EXPECT_GT((at_start.target - at_start.eye).normalized().y(), -std::sin(61 * M_PI / 180));
}

TEST(Survey, OfSmallBodiesFramesTheCollisionsAroundTheMiddle) {
  const RunPlace place;
  const string floor = "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";
  const string row =
      "scene: 1\ndefaults: {ball: {mass: 1, radius: 0.02, restitution: 0.8}}\n"
      "simulate: {duration: 2}\noutput: {video: true}\n" +
      floor + "balls:\n  row: {repeat: 20, position: ['= 0.05 * i', '= 0.9 + 0.005 * i', 0]}\n";

  const Scene near = place.scene(row), with_far = place.scene(row + "  far: {position: [30, 1, 0]}\n");
  const auto distance = [](const Scene& scene) {
    const Camera camera = surveyed(scene);
    return (camera.eye - camera.target).norm();
  };
  EXPECT_LT(distance(with_far), 1.5 * distance(near));
}

TEST(Survey, OfSlowMotionFramesItsInstants) {
  const RunPlace place;
  const Scene scene = place.scene(marble_run + "output: {video: {speed: 0.125, until: 0.5}}\n");
  const double most = filled(scene, surveyed(scene));
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 0.75);
}

TEST(Survey, DoesNotDependOnWhichOutputsAreLeft) {
  const RunPlace place;
  Scene scene = place.scene(marble_run + "output: {video: {until: 0.5}, frames: {fps: 7}}\n");
  const Camera camera = surveyed(scene);
  scene.output.frames.reset();
  EXPECT_EQ(surveyed(scene), camera);
}

TEST(Survey, AMotionThatFailsIsFramedAsFarAsItGoes) {
  const RunPlace place;
  const Scene scene = place.scene(marble_run + "output: {video: true}\n");
  Scene failing = scene;
  failing.simulate.max_collisions = 1;
  const Camera camera = surveyed(failing);
  EXPECT_TRUE(camera.eye.allFinite());
  EXPECT_LT((camera.eye - camera.target).norm(), (surveyed(scene).eye - surveyed(scene).target).norm());
}

}  // namespace
}  // namespace carom
