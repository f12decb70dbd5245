// Light, shadow and the encoding of both.
#include <gtest/gtest.h>

#include "numerics/srgb.h"
#include "render/eye.h"
#include "render/lighting.h"
#include "render/scenes.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using test::grey;

double encode(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055);
}

/// Position of a point in the picture.
pair<int, int> pixel_of(const Scene& scene, Size size, const Vec3& p) {
  const Eye eye(camera_of(scene), size);
  const Vec3 q = eye.point(p);
  return {static_cast<int>(size.width / 2.0 + q.x() / q.z() / eye.pixel),
          static_cast<int>(size.height / 2.0 - q.y() / q.z() / eye.pixel)};
}

Scene floor_scene(const Vec3& ball) {
  Scene scene;
  test::add_ball(scene, ball, 0.5, {1, 0, 0});
  test::add_plane(scene, Vec3::Zero(), Vec3(0, 1, 0), {0.5, 0.5, 0.5});
  Camera camera;
  camera.eye = Vec3(0, 8, 8);
  camera.target = Vec3::Zero();
  scene.camera = camera;
  scene.ambient = Color{0.2, 0.2, 0.2};
  return scene;
}

TEST(Linear, IsTheInverseOfTheSrgbCurve) {
  EXPECT_NEAR(linear({0.5, 0.04, 1})[0], 0.21404114048223255, 1e-7);  // ((0.5 + 0.055) / 1.055)^2.4
  EXPECT_NEAR(linear({0.5, 0.04, 1})[1], 0.04 / 12.92, 1e-8);
  EXPECT_EQ(linear({0.5, 0.04, 1})[2], 1);
}

TEST(Matt, AGreyFloorUnderLightFromAboveHasTheClosedFormsByte) {
  Scene scene = floor_scene(Vec3(50, 1, 0));
  scene.lights.push_back({"noon", Vec3(0, -1, 0), {}, {1, 1, 1}, 0.6});
  Renderer renderer(scene, {200, 200}, 4);
  const Image& image = renderer.draw(scene.initial);
  double brightest = 0;  // a light square away from the lines
  for (int y = 80; y < 120; ++y)
    for (int x = 80; x < 120; ++x) brightest = std::max(brightest, grey(image, x, y));
  const double ambient = 0.033104766570885055;  // of sRGB 0.2; from straight above all of it
  EXPECT_NEAR(brightest, encode(0.21404114 * (ambient + 0.6)), 1.5);
}

TEST(Background, IsTheColourTheSceneNames) {
  Scene scene;
  scene.background.color = Color{0.2, 0.4, 0.6};
  Renderer renderer(scene, {16, 16}, 4);
  const uint8_t* p = renderer.draw(scene.initial).row(3);
  EXPECT_EQ(p[0], 51);
  EXPECT_EQ(p[1], 102);
  EXPECT_EQ(p[2], 153);
}

TEST(Shadow, OfParallelLightFallsAlongItsDirection) {
  Scene scene = floor_scene(Vec3(0, 1.5, 0));
  scene.lights.push_back({"sun", Vec3(1, -1, 0), {}, {1, 1, 1}, 0.8});
  const Size size{400, 400};
  Renderer renderer(scene, size, 4);
  const Image& image = renderer.draw(scene.initial);
  const auto [x, y] = pixel_of(scene, size, Vec3(1.5, 0, 0));
  const auto [mx, my] = pixel_of(scene, size, Vec3(-1.5, 0, 0));
  EXPECT_LT(grey(image, x, y), 0.5 * grey(image, mx, my));
  // Its outline: a circle of the ball's radius across the light, so 0.5 sqrt 2 along x. Blur: 0.02 * 2.1 m.
  for (double out : {0.85, -0.85}) {
    const auto [ex, ey] = pixel_of(scene, size, Vec3(1.5 + out, 0, 0));
    EXPECT_GT(grey(image, ex, ey), 0.75 * grey(image, mx, my)) << out;
    const auto [ix, iy] = pixel_of(scene, size, Vec3(1.5 + 0.7 * out, 0, 0));
    EXPECT_LT(grey(image, ix, iy), 0.5 * grey(image, mx, my)) << out;
  }
}

TEST(Shadow, ItsPenumbraGrowsWithTheWayToTheFloor) {
  // Light from above with half its disc's tangent s: a ball at height h darkens the floor by half at its own radius,
  // and not at all beyond s h more.
  for (const double height : {2.0, 6.0}) {
    Scene scene = floor_scene(Vec3(0, height, 0));
    scene.ambient = Color{0, 0, 0};
    scene.background.color = Color{0, 0, 0};
    scene.lights.push_back({"noon", Vec3(0, -1, 0), {}, {1, 1, 1}, 0.8});
    scene.camera->eye = Vec3(0, 1.2, 6);

    const Size size{1200, 400};
    Renderer renderer(scene, size, 4);
    const Image& image = renderer.draw(scene.initial);

    State away = scene.initial;
    away.position[0] = Vec3(500, height, 0);
    Renderer other(scene, size, 4);
    const Image& open = other.draw(away);

    const auto light = [&](double x) {
      const auto [px, py] = pixel_of(scene, size, Vec3(x, 0, 0));
      const auto decoded = [&, px = px, py = py](const Image& seen) {
        const double c = grey(seen, px, py) / 255;
        return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
      };
      return decoded(image) / decoded(open);
    };

    const double blur = softness * height;
    EXPECT_NEAR(light(0.5), 0.5, 0.1) << height;  // a pixel is up to a tenth of the blur wide
    EXPECT_LT(light(0.5 - 1.15 * blur), 0.03) << height;
    EXPECT_GT(light(0.5 + 1.15 * blur), 0.97) << height;
    EXPECT_NEAR(light(0.5 + 0.5 * blur), 27.0 / 32, 0.1) << height;  // 3 t^2 - 2 t^3 at t = 3/4
    EXPECT_NEAR(light(0.5 - 0.5 * blur), 5.0 / 32, 0.1) << height;
  }
}

TEST(Shadow, OfALampSpreadsFromIt) {
  Scene scene = floor_scene(Vec3(0, 2, 0));
  scene.lights.push_back({"lamp", {}, Vec3(0, 4, 0), {1, 1, 1}, 0.8});
  const Size size{400, 400};
  Renderer renderer(scene, size, 4);
  const Image& image = renderer.draw(scene.initial);
  // The tangent cone from 4 m: sin = 0.5 / 2, so on the floor a disc of 4 tan = 1.0328 m.
  const auto [lx, ly] = pixel_of(scene, size, Vec3(-1.6, 0, 0));
  for (const Vec3& at : {Vec3(0.8, 0, 0), Vec3(-0.8, 0, 0), Vec3(0, 0, 0.8)}) {
    const auto [x, y] = pixel_of(scene, size, at);
    EXPECT_LT(grey(image, x, y), 0.6 * grey(image, lx, ly));
  }
  const auto [ox, oy] = pixel_of(scene, size, Vec3(1.5, 0, 0));
  EXPECT_GT(grey(image, ox, oy), 0.8 * grey(image, lx, ly));
}

TEST(Shadow, OfTwoBallsIsNoDarkerThanOfOne) {
  Scene one = floor_scene(Vec3(0, 1.5, 0));
  one.lights.push_back({"sun", Vec3(1, -1, 0), {}, {1, 1, 1}, 0.8});
  Scene two = one;
  test::add_ball(two, Vec3(-1.5, 3, 0), 0.5, {0, 0, 1});  // in line with the light
  const Size size{300, 300};
  Renderer first(one, size, 4), second(two, size, 4);
  const auto [x, y] = pixel_of(one, size, Vec3(1.5, 0, 0));
  EXPECT_EQ(grey(first.draw(one.initial), x, y), grey(second.draw(two.initial), x, y));
}

TEST(Shadow, FallsOnABallBehindAnother) {
  Scene scene = floor_scene(Vec3(0, 0.5, 0));
  scene.lights.push_back({"sun", Vec3(0, -1, 0), {}, {1, 1, 1}, 0.8});
  const Size size{300, 300};
  const auto [x, y] = pixel_of(scene, size, Vec3(0, 1, 0));
  Renderer alone(scene, size, 4);
  const double lit = grey(alone.draw(scene.initial), x, y);
  test::add_ball(scene, Vec3(0, 10, 0), 0.5, {0, 0, 1});  // high above, behind the camera's eye
  Renderer shaded(scene, size, 4);
  EXPECT_LT(grey(shaded.draw(scene.initial), x, y), 0.6 * lit);
}

TEST(Shadow, OfAWallFallsOnFloorAndBall) {
  Scene scene = floor_scene(Vec3(0, 0.5, 0));
  scene.lights.push_back({"sun", Vec3(0, -1, 0), {}, {1, 1, 1}, 0.8});
  const Size size{300, 300};
  const auto [x, y] = pixel_of(scene, size, Vec3(0, 1, 0));
  const auto [fx, fy] = pixel_of(scene, size, Vec3(1, 0, 0.2));
  Renderer open(scene, size, 4);
  const Image bright = open.draw(scene.initial);
  test::add_wall(scene, Vec3(0, 20, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 4, 4, {1, 1, 1});
  Renderer roofed(scene, size, 4);
  const Image& dark = roofed.draw(scene.initial);
  EXPECT_LT(grey(dark, x, y), 0.6 * grey(bright, x, y));
  EXPECT_LT(grey(dark, fx, fy), 0.6 * grey(bright, fx, fy));
}

TEST(Shadow, WhereABallTouchesTheFloorItIsDarkWithoutAnyKeyLight) {
  Scene scene = floor_scene(Vec3(0, 0.5, 0));
  scene.ambient = Color{1, 1, 1};
  scene.lights.push_back({"none", Vec3(0, -1, 0), {}, {0, 0, 0}, 0});
  const Size size{400, 400};
  const auto [x, y] = pixel_of(scene, size, Vec3(0, 0, 0.55));
  Renderer renderer(scene, size, 4);
  const auto light = [&, x = x, y = y](const State& state) {
    const uint8_t* const pixel = renderer.draw(state).row(y) + 3 * x;
    return Vec3(light_of_srgb(pixel[0] / 255.0), light_of_srgb(pixel[1] / 255.0), light_of_srgb(pixel[2] / 255.0));
  };
  const Vec3 dark = light(scene.initial);
  State away = scene.initial;
  away.position[0] = Vec3(3, 0.5, 0);
  // Of the sky cos (r / d)^2 = 0.304 is hidden. By the formula of surround.inc 0.741 of its light is left, and the ball
  // sends 0.074 of red.
  const Vec3 open = light(away);
  EXPECT_NEAR(dark.x() / open.x(), 0.815, 0.015);
  EXPECT_NEAR(dark.y() / open.y(), 0.741, 0.015);
  EXPECT_NEAR(dark.z() / open.z(), 0.741, 0.015);
}

TEST(Glow, OfADarkBodyIsAsBrightAsOfALightOne) {
  for (const Color& color : {Color{0, 0, 0.5}, Color{0.9, 0.9, 0.9}}) {
    Scene scene;
    test::add_ball(scene, Vec3::Zero(), 0.5, color);
    Drawing drawing;
    drawing.camera = camera_of(scene);
    drawing.glow = {1};
    Renderer renderer(scene, {100, 100}, 4);
    const Image& image = renderer.draw(scene.initial, drawing);
    EXPECT_NEAR(grey(image, 50, 50), encode(0.85), 1);  // white, by the tone curve
  }
}

TEST(Surround, ALitRedBallColoursTheFloorOnItsLitSide) {
  Scene scene = floor_scene(Vec3(0, 0.5, 0));
  scene.lights.push_back({"sun", Vec3(3, -1, 0), {}, {1, 1, 1}, 0.8});
  const Size size{400, 400};
  Renderer renderer(scene, size, 4);
  const Image& image = renderer.draw(scene.initial);

  const auto redness = [&](const Vec3& at) {
    const auto [x, y] = pixel_of(scene, size, at);
    const uint8_t* p = image.row(y) + 3 * x;
    return static_cast<double>(p[0]) / p[1];
  };

  EXPECT_NEAR(redness(Vec3(-3, 0, 0)), 1, 0.01);
  EXPECT_GT(redness(Vec3(-0.6, 0, 0)), 1.04);
  EXPECT_GT(redness(Vec3(-0.6, 0, 0)), redness(Vec3(-0.9, 0, 0)) + 0.01);
}

TEST(Surround, ANeighbourHidesTheSkyThatABallMirrors) {
  // Black balls show nothing but what they mirror.
  Scene scene;
  for (const double x : {0.0, 1.01}) test::add_ball(scene, Vec3(x, 0, 0), 0.5, {0, 0, 0});
  scene.lights.push_back({"none", Vec3(0, -1, 0), {}, {0, 0, 0}, 0});
  Camera camera;
  camera.eye = Vec3(0, 0, 8);
  camera.target = Vec3::Zero();
  scene.camera = camera;
  const Size size{400, 400};
  Renderer renderer(scene, size, 4);
  const Image& image = renderer.draw(scene.initial);
  // There the normal is 45 degrees from the line of sight: the way that is mirrored goes to the side.
  const auto [lx, ly] = pixel_of(scene, size, Vec3(-0.35, 0, 0.35));
  const auto [rx, ry] = pixel_of(scene, size, Vec3(0.35, 0, 0.35));
  EXPECT_GT(grey(image, lx, ly), 30);
  EXPECT_LT(grey(image, rx, ry), 0.3 * grey(image, lx, ly));
}

TEST(Surround, TheFloorLightsAWallThatTheSunDoesNotReach) {
  const auto wall = [](double floor) {
    Scene scene;
    scene.world.planes.clear();
    test::add_plane(scene, Vec3::Zero(), Vec3(0, 1, 0), {floor, floor, floor});
    test::add_plane(scene, Vec3(0, 0, -2), Vec3(0, 0, 1), {0.5, 0.5, 0.5});
    scene.lights.push_back({"sun", Vec3(0, -1, 0.2), {}, {1, 1, 1}, 0.8});

    Camera camera;
    camera.eye = Vec3(0, 1, 4);
    camera.target = Vec3(0, 1, 0);
    scene.camera = camera;
    Renderer renderer(scene, {200, 200}, 4);
    return grey(renderer.draw(scene.initial), 100, 90);
  };

  EXPECT_GT(wall(0.8), 1.1 * wall(0.1));
}

}  // namespace
}  // namespace carom
