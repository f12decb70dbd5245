// Looks, finishes, opacity and the thickness of walls.
#include <gtest/gtest.h>

#include "numerics/srgb.h"
#include "render/outlines.h"
#include "render/wall_thickness.h"
#include "scene/scene.h"

namespace carom {
namespace {

using test::add_ball;
using test::add_plane;
using test::add_wall;
using test::black;
using test::grey;
using test::grey_at;
using test::red;
using test::white;

constexpr Size picture{320, 240};

/// A camera in front of the origin, in even light.
Scene even_scene(const Vec3& eye) {
  Scene scene;
  Camera camera;
  camera.eye = eye;
  scene.camera = camera;
  scene.ambient = Color{0.6, 0.6, 0.6};
  scene.lights.push_back({"noon", Vec3(0, -1, 0), {}, white, 0.5});
  return scene;
}

Image drawn(const Scene& scene, const State& state) {
  Renderer renderer(scene, picture, 4);
  return renderer.draw(state);
}

Image drawn(const Scene& scene) {
  return drawn(scene, scene.initial);
}

/// A byte's linear light.
double light_at(const Image& image, const test::Point& at, int channel) {
  const uint8_t byte = image.row(static_cast<int>(at.y))[image.channels * static_cast<int>(at.x) + channel];
  return light_of_srgb(byte / 255.0);
}

TEST(Walls, HideABallThatTouchesThemFromBehind) {
  Scene scene = even_scene(Vec3(0.4, 0.7, 3));
  scene.background.color = black;
  add_wall(scene, Vec3::Zero(), Vec3(0, 0, 1), Vec3(0, 1, 0), 2, 1.5, white);
  add_ball(scene, Vec3(0, 0, -0.3), 0.3, red);
  const Image touching = drawn(scene);
  State away = scene.initial;
  away.position[0] = Vec3(0, 0, -50);
  const Image alone = drawn(scene, away);
  for (double x = -0.9; x < 0.95; x += 0.05)
    for (double y = -0.65; y < 0.7; y += 0.05)
      EXPECT_EQ(grey_at(touching, scene, Vec3(x, y, 0)), grey_at(alone, scene, Vec3(x, y, 0))) << x << " " << y;
}

TEST(Walls, InTwoPartsLetNoLightThroughTheirSeam) {
  // The background and the floor behind are white, the walls black: light at the seam would be seen.
  Scene scene = even_scene(Vec3(0.3, 0.6, 3));
  scene.background.color = white;
  scene.ambient = black;
  scene.lights[0] = {"sun", Vec3(0.1, -1, -0.7), {}, white, 1};
  add_plane(scene, Vec3(0, -0.5, 0), Vec3(0, 1, 0), white);
  add_wall(scene, Vec3(-0.5, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), 1, 1, black);
  add_wall(scene, Vec3(0.5, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), 1, 1, black);

  const Image image = drawn(scene);
  for (double y = -0.45; y < 0.46; y += 0.02) {
    const test::Point at = test::projected(scene, picture, Vec3(0, y, 0));
    const double beside = grey(image, static_cast<int>(at.x) - 6, static_cast<int>(at.y));
    for (int x = -2; x <= 2; ++x)
      EXPECT_LE(grey(image, static_cast<int>(at.x) + x, static_cast<int>(at.y)), beside + 20) << y;
  }

  // From behind, the shadow on the floor: 0.7 m long, without a bright line from the seam.
  scene.camera->eye = Vec3(0.2, 1.2, -3);
  const Image behind = drawn(scene);
  for (double z = -0.6; z < -0.05; z += 0.02)
    for (double x = -0.15; x < 0.2; x += 0.01)
      EXPECT_LE(grey_at(behind, scene, Vec3(x, -0.5, z)), grey_at(behind, scene, Vec3(0.4, -0.5, z)) + 8)
          << x << " " << z;
}

TEST(Walls, AreThickWhereNoBodyIs) {
  Scene scene;
  add_wall(scene, Vec3::Zero(), Vec3(0, 0, 1), Vec3(0, 1, 0), 4, 0.1, white);
  add_ball(scene, Vec3(0, 0, 1), 0.05, red);
  const WallThickness thickness(scene);
  const WallDepths free = thickness.of(0, scene.initial);
  EXPECT_DOUBLE_EQ(free.back, 0.06);  // 0.6 of the shorter side, less than 0.02 of the longer
  EXPECT_DOUBLE_EQ(free.front, 0.04 * 0.05);

  // A ball that comes from behind never sinks in by more than a twentyfifth of its radius.
  State state = scene.initial;
  for (double z = -0.3; z < -0.05; z += 0.001) {
    state.position[0] = Vec3(1.5, 0.02, z);
    const double gap = -z - 0.05;
    EXPECT_LE(thickness.of(0, state).back, std::max(gap, 0.04 * 0.05) + 1e-15) << z;
  }
  // One that passes beside it takes nothing off.
  state.position[0] = Vec3(1.5, 0.2, -0.05);
  EXPECT_DOUBLE_EQ(thickness.of(0, state).back, 0.06);
  // One beyond the edge takes off what the wall would go into it: the edge is 0.03 away from its middle.
  state.position[0] = Vec3(1.5, 0.05 + 0.03, -0.07);
  EXPECT_NEAR(thickness.of(0, state).back, 0.07 - 0.04, 1e-15);
}

TEST(Opacity, MixesWhatIsInFrontAndWhatIsBehind) {
  Scene scene = even_scene(Vec3(0, 0, 3));
  scene.background.color = Color{0.2, 0.4, 0.9};
  add_ball(scene, Vec3::Zero(), 0.8, red);
  const Image opaque = drawn(scene);
  State nothing = scene.initial;
  nothing.position[0] = Vec3(0, 100, 0);
  const Image behind = drawn(scene, nothing);
  scene.roster.bodies[0].surface = {Finish::plastic, 0.3};

  const Image through = drawn(scene);
  for (const Vec3& place : {Vec3(0, 0, 0.8), Vec3(0.3, -0.3, 0.6), Vec3(-0.4, 0, 0.6)}) {
    const test::Point at = test::projected(scene, picture, place);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(light_at(through, at, c), 0.3 * light_at(opaque, at, c) + 0.7 * light_at(behind, at, c), 0.006);
  }
}

TEST(Opacity, LetsLightThroughToTheFloor) {
  Scene scene = even_scene(Vec3(0, 4, 4));
  add_plane(scene, Vec3(0, -1, 0), Vec3(0, 1, 0), {0.5, 0.5, 0.5});
  add_ball(scene, Vec3(0, 1, 0), 0.4, red);
  const auto shade = [&](double opacity) {
    scene.roster.bodies[0].surface.opacity = opacity;
    const test::Point at = test::projected(scene, picture, Vec3(0, -1, 0.2));
    return light_at(drawn(scene), at, 1);
  };
  EXPECT_NEAR(shade(0.5), (shade(0) + shade(1)) / 2, 0.01);
  EXPECT_GT(shade(0), 1.3 * shade(1));
}

TEST(Finishes, AMirrorShowsABallUnderItself) {
  Scene scene = even_scene(Vec3(0, 1.5, 4));
  scene.background.color = black;
  add_plane(scene, Vec3(0, -0.5, 0), Vec3(0, 1, 0), white);
  add_ball(scene, Vec3(0, 0.3, 0), 0.3, red);
  scene.roster.fixed[0].surface.finish = Finish::metal;
  const Image image = drawn(scene);

  // The image of the ball's middle is as far below the floor as that is above.
  const test::Point seen = test::projected(scene, picture, Vec3(0, -1.3, 0)),
                    beside = test::projected(scene, picture, Vec3(0.8, -1.3, 0));
  EXPECT_GT(light_at(image, seen, 0), 4 * light_at(image, seen, 1));
  EXPECT_NEAR(light_at(image, beside, 0), light_at(image, beside, 1), 0.01);
}

TEST(Finishes, AThingThatGlowsLightsItsNeighbourAndTheLens) {
  Scene scene = even_scene(Vec3(0, 0, 4));
  scene.background.color = black;
  scene.ambient = black;
  scene.lights[0].intensity = 0;
  add_ball(scene, Vec3(-0.4, 0, 0), 0.3, white);
  add_ball(scene, Vec3(0.4, 0, 0), 0.3, red);
  const Image dark = drawn(scene);
  scene.roster.bodies[1].surface.finish = Finish::glow;
  const Image bright = drawn(scene);

  const test::Point facing = test::projected(scene, picture, Vec3(-0.14, 0, 0.15)),
                    above = test::projected(scene, picture, Vec3(0.4, 0.5, 0)),
                    far = test::projected(scene, picture, Vec3(-1.9, 0.2, 0));
  EXPECT_GT(light_at(bright, facing, 0), light_at(dark, facing, 0) + 0.05);
  EXPECT_GT(light_at(bright, above, 0), 0.02);
  EXPECT_EQ(light_at(bright, far, 0), 0);
}

TEST(Background, OfNothingLeavesTheShadowsOnAFloor) {
  Scene scene = even_scene(Vec3(0, 3, 6));
  scene.background.transparent = true;
  add_plane(scene, Vec3(0, -0.5, 0), Vec3(0, 1, 0), white);
  add_ball(scene, Vec3(0, 0.5, 0), 0.5, red);

  const Image image = drawn(scene);
  ASSERT_EQ(image.channels, 4);
  const auto opacity = [&](const Vec3& p) {
    const test::Point at = test::projected(scene, picture, p);
    return image.row(static_cast<int>(at.y))[4 * static_cast<int>(at.x) + 3];
  };
  EXPECT_EQ(opacity(Vec3(0, 0.5, 0.5)), 255);
  EXPECT_GT(opacity(Vec3(0, -0.5, 0.2)), 90);
  EXPECT_EQ(opacity(Vec3(-1.9, -0.5, 0)), 0);
  EXPECT_EQ(opacity(Vec3(0, -0.5, -20)), 0);
}

TEST(Looks, GiveWhatTheSceneDoesNot) {
  for (const SceneLook look : {SceneLook::studio, SceneLook::table, SceneLook::night, SceneLook::chalkboard,
                               SceneLook::blueprint, SceneLook::plain}) {
    Scene scene;
    scene.look = look;
    Camera camera;
    camera.eye = Vec3(0, 1, 4);
    scene.camera = camera;
    add_ball(scene, Vec3::Zero(), 0.3, red);
    const Image own = drawn(scene);

    // What the scene says takes the place of the look's.
    scene.background.color = Color{0.2, 0.4, 0.6};
    const Image given = drawn(scene);
    EXPECT_EQ(given.row(3)[0], 51);
    EXPECT_NE(own.row(3)[0], 51);
  }
}

TEST(Looks, HaveNoLineWhereAFloorMeetsASeamlessBackdrop) {
  for (const SceneLook look : {SceneLook::studio, SceneLook::night, SceneLook::chalkboard, SceneLook::plain}) {
    Scene scene;
    scene.look = look;
    Camera camera;
    camera.eye = Vec3(0, 0.7, 4);
    scene.camera = camera;
    add_plane(scene, Vec3(0, -0.5, 0), Vec3(0, 1, 0), from_rgb(style_of(look).plane));
    add_ball(scene, Vec3(0, -0.2, 0), 0.3, red);
    const Image image = drawn(scene);
    for (int y = 1; y < image.height; ++y) EXPECT_LE(std::abs(grey(image, 5, y) - grey(image, 5, y - 1)), 4) << y;
  }
}

TEST(Looks, OutlinesAreOfTheirInk) {
  Scene scene = even_scene(Vec3(0, 0, 4));
  scene.look = SceneLook::chalkboard;
  add_ball(scene, Vec3::Zero(), 0.8, black);
  const Image image = drawn(scene);
  // From the middle to the right: black, then chalk, then the board.
  const int y = picture.height / 2;
  double brightest = 0;
  for (int x = picture.width / 2; x < picture.width; ++x) brightest = std::max(brightest, grey(image, x, y));
  EXPECT_GT(brightest, 200);
  EXPECT_LT(grey(image, picture.width / 2, y), 40);
}

}  // namespace
}  // namespace carom
