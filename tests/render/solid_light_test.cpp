// Shadows and shading of boxes and cylinders.
#include <gtest/gtest.h>

#include "render/outlines.h"
#include "scene/scene.h"

namespace carom {
namespace {

using test::add_ball;
using test::add_body;
using test::add_obstacle;
using test::add_plane;
using test::blue;
using test::green;
using test::grey_at;
using test::red;
using test::white;

TEST(SolidLight, EachFaceOfABoxHasItsShare) {
  Scene scene = test::flat_scene(Vec3(3, 3, 3), Vec3::Zero());
  scene.ambient = Color{0.3, 0.3, 0.3};
  scene.lights[0] = {"sun", Vec3(-1, -2, -0.2), {}, white, 0.7};
  add_body(scene, Vec3::Zero(), Volume::box(Vec3(1, 1, 1)), {0.6, 0.6, 0.6});
  Renderer renderer(scene, {200, 200}, 4);
  const Image& image = renderer.draw(scene.initial);
  const double top = grey_at(image, scene, Vec3(0, 0.5, 0)), right = grey_at(image, scene, Vec3(0.5, 0, 0)),
               front = grey_at(image, scene, Vec3(0, 0, 0.5));
  EXPECT_GT(top, 1.1 * right);
  EXPECT_GT(right, 1.3 * front);
}

Scene sunny_floor() {
  Scene scene;
  add_plane(scene, Vec3::Zero(), Vec3(0, 1, 0), {0.5, 0.5, 0.5});
  Camera camera;
  camera.eye = Vec3(0, 8, 8);
  camera.target = Vec3::Zero();
  scene.camera = camera;
  scene.ambient = Color{0.2, 0.2, 0.2};
  scene.lights.push_back({"sun", Vec3(1, -1, 0), {}, white, 0.8});
  return scene;
}

TEST(SolidShadow, IsTheSolidAlongTheLight) {
  for (const Volume& volume : {Volume::box(Vec3(1, 1, 1)), Volume::cylinder(0.5, 1)}) {
    Scene scene = sunny_floor();
    add_body(scene, Vec3(0, 1.5, 0), volume, red);
    Renderer renderer(scene, {400, 400}, 4);
    const Image& image = renderer.draw(scene.initial);
    // Its underside, at 1 m, falls onto x = 0.5 ... 1.5, its top, at 2 m, onto 1.5 ... 2.5. Blur: 0.02 * 2.8 m.
    const double open = grey_at(image, scene, Vec3(-1.5, 0, 0));
    for (const double x : {0.62, 1.5, 2.38}) EXPECT_LT(grey_at(image, scene, Vec3(x, 0, 0)), 0.55 * open) << x;
    EXPECT_GT(grey_at(image, scene, Vec3(0.38, 0, 0)), 0.75 * open);
    EXPECT_GT(grey_at(image, scene, Vec3(2.62, 0, 0)), 0.75 * open);
    EXPECT_GT(grey_at(image, scene, Vec3(1.5, 0, 0.6)), 0.75 * open);
    EXPECT_LT(grey_at(image, scene, Vec3(1.5, 0, 0.4)), 0.55 * open);
    // The far end is straight, or round.
    EXPECT_EQ(grey_at(image, scene, Vec3(2.38, 0, 0.4)) < 0.55 * open, volume.shape == Shape::box);
  }
}

TEST(SolidShadow, OfALampSpreadsFromIt) {
  Scene scene = sunny_floor();
  scene.lights[0] = {"lamp", {}, Vec3(0, 4, 0), white, 0.8};
  add_body(scene, Vec3(0, 2, 0), Volume::box(Vec3(1, 0.001, 1)), red);  // twice its size on the floor
  Renderer renderer(scene, {400, 400}, 4);
  const Image& image = renderer.draw(scene.initial);
  const double open = grey_at(image, scene, Vec3(-2, 0, 0));
  EXPECT_LT(grey_at(image, scene, Vec3(-0.85, 0, 0.85)), 0.6 * open);
  EXPECT_GT(grey_at(image, scene, Vec3(-1.2, 0, 0)), 0.8 * open);
}

TEST(SolidShadow, FallsOnBallsBoxesAndCylindersOfEachOther) {
  for (const Volume& below : {Volume::sphere(0.5), Volume::box(Vec3(1, 1, 1)), Volume::cylinder(0.5, 1)})
    for (const Volume& above : {Volume::sphere(0.5), Volume::box(Vec3(1, 1, 1)), Volume::cylinder(0.5, 1)}) {
      Scene scene = sunny_floor();
      scene.lights[0] = {"noon", Vec3(0, -1, 0), {}, white, 0.8};
      add_body(scene, Vec3(0, 0.5, 0), below, red);
      add_body(scene, Vec3(5, 20, 0), above, blue);
      Renderer renderer(scene, {300, 300}, 4);
      const double lit = grey_at(renderer.draw(scene.initial), scene, Vec3(0, 1, 0));
      State state = scene.initial;
      state.position[1] = Vec3(0, 10, 0);  // high above, behind the camera's eye
      EXPECT_LT(grey_at(renderer.draw(state), scene, Vec3(0, 1, 0)), 0.7 * lit);
    }
}

TEST(SolidShadow, UponABoxEndsWhereTheBoxEnds) {
  // The plane of the box's top is shaded at (3, 1, 0), where there is no box; the floor at (4, 0, 0).
  Scene scene = sunny_floor();
  add_obstacle(scene, Vec3(-2, 0.5, 0), Volume::box(Vec3(1, 1, 1)), green);
  add_ball(scene, Vec3(100, 3, 0), 0.4, red);
  Renderer empty(scene, {400, 400}, 4);
  const double open = grey_at(empty.draw(scene.initial), scene, Vec3(3, 1, 0));
  State state = scene.initial;
  state.position.back() = Vec3(1, 3, 0);
  Renderer renderer(scene, {400, 400}, 4);
  const Image& image = renderer.draw(state);
  EXPECT_EQ(grey_at(image, scene, Vec3(3, 1, 0)), open);
  EXPECT_LT(grey_at(image, scene, Vec3(4, 0, 0)), 0.55 * open);
}

}  // namespace
}  // namespace carom
