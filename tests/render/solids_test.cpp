// Boxes, cylinders and obstacles in pictures: positions and occlusion.
#include <gtest/gtest.h>

#include <tuple>

#include "physics/world.h"
#include "render/outlines.h"
#include "scene/scene.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

using test::add_ball;
using test::add_body;
using test::add_obstacle;
using test::blue;
using test::flat_scene;
using test::green;
using test::grey;
using test::grey_at;
using test::outline_of_solid;
using test::outside;
using test::Point;
using test::projected;
using test::red;
using test::white;

/// Pixels that show something outside of an outline, or nothing inside of it. (Half a pixel's diagonal is 0.71.)
int wrong_pixels(const Image& image, const vector<Point>& hull) {
  int wrong = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double out = outside(hull, {x + 0.5, y + 0.5});
      const bool shown = grey(image, x, y) > 0;
      if ((out > 0.8 && shown) || (out < -0.8 && !shown)) ++wrong;
    }
  return wrong;
}

TEST(Solid, ItsOutlineIsTheHullOfItsCornersToAPixel) {
  SLOW_WITH_SANITIZERS();
  const Size size{400, 300};
  for (const Volume& volume : {Volume::box(Vec3(1.2, 0.8, 2)), Volume::cylinder(0.7, 1.1), Volume::cylinder(0.1, 0.3)})
    for (const Vec3& center : {Vec3(0, 0, 0), Vec3(1.5, -0.7, 0.4), Vec3(3.2, 2.0, 0)})
      for (const int samples : {1, 4}) {
        Scene scene = flat_scene(Vec3(1, 1.5, 5), Vec3::Zero());
        add_body(scene, center, volume, white);
        Renderer renderer(scene, size, samples);
        EXPECT_EQ(wrong_pixels(renderer.draw(scene.initial), outline_of_solid(scene, size, center, volume)), 0)
            << volume.half.transpose() << " at " << center.transpose();
      }
}

TEST(Solid, SmoothEdgesCoverAsMuchAsTheOutline) {
  const Size size{300, 300};
  // Seen face on: even light from the side is 0.8 of that from above.
  for (const auto& [eye, volume, even] : {std::tuple{Vec3(0, 0, 5), Volume::box(Vec3(1, 1, 1)), 0.8},
                                          {Vec3(0, 0, 5), Volume::box(Vec3(0.05, 0.3, 0.04)), 0.8},
                                          {Vec3(0, 5, 0), Volume::cylinder(0.6, 0.1), 1.0}}) {
    Scene scene = flat_scene(eye, Vec3::Zero());
    add_body(scene, Vec3::Zero(), volume, {0.4, 0.4, 0.4});
    Renderer renderer(scene, size, 4);
    const Image& image = renderer.draw(scene.initial);
    double light = 0;
    for (const uint8_t byte : image.pixels) light += byte > 10 ? pow((byte / 255.0 + 0.055) / 1.055, 2.4) : 0;
    const double full = even * pow((0.4 + 0.055) / 1.055, 2.4);
    const double area = area_of(outline_of_solid(scene, size, Vec3::Zero(), volume));
    EXPECT_NEAR(light / 3 / (area * full), 1, 0.03) << volume.half.transpose();  // measured: 0.023, of 4 by 22 pixels
  }
}

TEST(Solid, WhatIsNearerHidesWhatIsBehindWhateverTheKinds) {
  const Volume ball = Volume::sphere(0.5), box = Volume::box(Vec3(1, 1, 1)), cylinder = Volume::cylinder(0.5, 1);
  for (const auto& [near, far] : {pair{ball, box}, {box, ball}, {cylinder, ball}, {ball, cylinder}, {box, cylinder}})
    for (int swap = 0; swap < 2; ++swap) {
      Scene scene = flat_scene(Vec3(0, 0, 6), Vec3::Zero());
      if (swap) add_body(scene, Vec3(0, 0, 1), near, red);
      add_body(scene, Vec3(0, 0, -1), far, blue);
      if (!swap) add_body(scene, Vec3(0, 0, 1), near, red);

      Renderer renderer(scene, {100, 100}, 4);
      const uint8_t* middle = renderer.draw(scene.initial).row(50) + 3 * 50;
      EXPECT_GT(middle[0], 150);
      EXPECT_LT(middle[2], 60);
    }
}

TEST(Solid, EdgesBlendWithWhatIsBehindThemWhateverTheOrder) {
  // White things before a white box before a white ball, black behind all: no outline shows within the farthest.
  const Size size{200, 200};
  Scene scene = flat_scene(Vec3(0, 0, 8), Vec3::Zero());
  add_ball(scene, Vec3(0, 0, -12), 6, white);
  add_body(scene, Vec3(0, 0, 0), Volume::box(Vec3(2, 2, 2)), white);
  add_body(scene, Vec3(0.3, 0.2, 2), Volume::sphere(0.5), white);
  add_body(scene, Vec3(-0.8, 0.1, 2), Volume::cylinder(0.3, 0.7), white);
  Renderer renderer(scene, size, 4);
  const Image& image = renderer.draw(scene.initial);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)  // measured: 170, on the cylinder's flank
      EXPECT_TRUE(hypot(x - 99.5, y - 99.5) > 60 || grey(image, x, y) > 165) << x << ' ' << y;
}

TEST(Solid, LargerThanATileOfThePictureHasNoSeams) {
  Scene scene = flat_scene(Vec3(0, 0, 3), Vec3::Zero());
  add_body(scene, Vec3::Zero(), Volume::box(Vec3(8, 4, 0.1)), white);
  Renderer renderer(scene, {700, 300}, 4);
  const Image& image = renderer.draw(scene.initial);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 700; ++x) ASSERT_NEAR(grey(image, x, y), grey(image, 350, 150), 6) << x << ' ' << y;
}

TEST(Solid, AroundTheEyeIsNotDrawnAndAcrossTheNearPlaneShowsItsInside) {
  Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  scene.camera->near = 1;
  add_body(scene, Vec3(0, 0, 5), Volume::box(Vec3(1, 1, 1)), white);
  Renderer renderer(scene, {50, 50}, 4);
  EXPECT_EQ(grey(renderer.draw(scene.initial), 25, 25), 0);
  State state = scene.initial;
  state.position[0] = Vec3(0, 0, 3.9);  // from 0.6 to 1.6 ahead: cut open
  const double inside = grey(renderer.draw(state), 25, 25);
  state.position[0] = Vec3(0, 0, 3.4);
  EXPECT_GT(inside, 40);
  EXPECT_LT(inside, 0.8 * grey(renderer.draw(state), 25, 25));
}

TEST(Solid, SmallerThanAPixelIsFaintNotGone) {
  Scene scene = flat_scene(Vec3(0, 0, 100), Vec3::Zero());
  add_body(scene, Vec3::Zero(), Volume::box(Vec3(0.3, 0.3, 0.3)), white);  // a third of a pixel
  Renderer renderer(scene, {101, 101}, 4);
  const double seen = grey(renderer.draw(scene.initial), 50, 50);
  EXPECT_GT(seen, 20);
  EXPECT_LT(seen, 150);
}

TEST(Obstacle, OfEveryVolumeIsDrawnWhereItIsUnlessInvisible) {
  const Size size{300, 200};
  const Vec3 center(0.4, 0.2, 0);
  for (const Volume& volume : {Volume::sphere(0.6), Volume::box(Vec3(1, 0.8, 1.2)), Volume::cylinder(0.5, 1)})
    for (const bool visible : {true, false}) {
      Scene scene = flat_scene(Vec3(0, 1, 5), Vec3::Zero());
      add_obstacle(scene, center, volume, green, visible);
      Renderer renderer(scene, size, 4);
      const Image& image = renderer.draw(scene.initial);
      EXPECT_EQ(grey_at(image, scene, center) > 40, visible);
      if (!visible || volume.shape == Shape::sphere) continue;
      EXPECT_EQ(wrong_pixels(image, outline_of_solid(scene, size, center, volume)), 0) << volume.half.transpose();
    }
}

TEST(Obstacle, IsInThePictureOfASceneWithoutCamera) {
  Scene scene;
  add_ball(scene, Vec3(0, 3, 0), 0.2, red);
  add_obstacle(scene, Vec3(0.3, 2.5, 0), Volume::cylinder(0.3, 0.2), green);
  const Camera camera = camera_of(scene);
  EXPECT_TRUE(is_sphere_in_view(camera, view_of(camera, {1280, 720}), Vec3(0.6, 2.4, 0), 1e-6));
  Scene alone;
  add_obstacle(alone, Vec3(7, 0, 0), Volume::box(Vec3(1, 1, 1)), green);
  const Camera other = camera_of(alone);
  EXPECT_TRUE(is_sphere_in_view(other, view_of(other, {1280, 720}), Vec3(7.5, 0.5, 0.5), 1e-6));
}

TEST(Obstacle, AFloorOfAnySizeLeavesTheCameraWithTheBodies) {
  Scene scene;
  add_ball(scene, Vec3(0, 0.2, 0), 0.2, red);
  add_obstacle(scene, Vec3(0, -1, 0), Volume::box(Vec3(2000, 2, 2000)), green);
  EXPECT_LT((camera_of(scene).eye - Vec3(0, 0.2, 0)).norm(), 10);
}

TEST(Solid, ACylinderIsSeenFromTheCornerOfItsBox) {
  Scene scene = flat_scene(Vec3(0.9, 0, 0.9), Vec3::Zero());
  add_body(scene, Vec3::Zero(), Volume::cylinder(1, 2), white);
  Renderer renderer(scene, {50, 50}, 1);
  EXPECT_GT(grey(renderer.draw(scene.initial), 25, 25), 40);
}

TEST(Merged, APartIsNotDrawnAndTheJointBodyHasTheStatesSize) {
  Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  add_ball(scene, Vec3(-1, 0, 0), 0.3, red);
  add_ball(scene, Vec3(1, 0, 0), 0.3, blue);
  Renderer renderer(scene, {200, 200}, 4);

  State state = scene.initial;
  state.position = {Vec3::Zero(), Vec3::Zero()};
  state.part_of = {0, 0};
  state.mass = {2, 0};
  state.radius = {0.5, 0.3};

  // Where all bodies are balls, a simulator gives no volumes.
  for (const bool volumes : {false, true}) {
    if (volumes) state.volume = {Volume::sphere(0.5), Volume::sphere(0.3)};
    const Image& image = renderer.draw(state);
    EXPECT_EQ(grey_at(image, scene, Vec3(1, 0, 0)), 0);

    const Point at = projected(scene, {200, 200}, Vec3(0.45, 0, 0));
    const uint8_t* p = image.row(100) + 3 * static_cast<int>(at.x);
    EXPECT_GT(p[0], 100);
    EXPECT_LT(p[2], 100);
  }
}

}  // namespace
}  // namespace carom
