// The content of pictures: positions of discs, occlusion, and what is drawn at all.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "raster/outline.h"
#include "render/eye.h"
#include "render/scenes.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using test::add_ball;
using test::add_plane;
using test::add_wall;
using test::black;
using test::blue;
using test::flat_scene;
using test::green;
using test::grey;
using test::red;
using test::white;

/// Centre and area of all that is not black, in pixels; a pixel counts as 1 if it is brighter than 0.
struct Blob {
  double x = 0, y = 0, area = 0, width = 0, height = 0;
};
Blob blob_of(const Image& image) {
  Blob blob;
  int x0 = image.width, x1 = -1, y0 = image.height, y1 = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (grey(image, x, y) < 40) continue;
      blob.x += x + 0.5, blob.y += y + 0.5, blob.area += 1;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  blob.x /= blob.area, blob.y /= blob.area;
  blob.width = x1 - x0 + 1, blob.height = y1 - y0 + 1;
  return blob;
}

/// The outline that the projection gives in closed form, in pixels.
Blob expected_blob(const Scene& scene, Size size, const Vec3& center, double radius) {
  const Eye eye(*scene.camera, size);
  Outline o{};
  EXPECT_TRUE(outline_of(eye.point(center), radius, o));
  const double a = hypot(o.ax, o.ay), b = hypot(o.bx, o.by);
  return {size.width / 2.0 + o.x / eye.pixel, size.height / 2.0 - o.y / eye.pixel,
          M_PI * a * b / (eye.pixel * eye.pixel), 2 * hypot(o.ax, o.bx) / eye.pixel, 2 * hypot(o.ay, o.by) / eye.pixel};
}

TEST(Outline, AlongTheAxisItsRadiusIsTheTangentOfTheTangentCone) {
  Outline o{};
  ASSERT_TRUE(outline_of(Vec3(0, 0, 5), 3, o));  // sin = 3/5, tan = 3/4
  EXPECT_DOUBLE_EQ(hypot(o.ax, o.ay), 0.75);
  EXPECT_DOUBLE_EQ(hypot(o.bx, o.by), 0.75);
  EXPECT_FALSE(outline_of(Vec3(0, 5, 1), 2, o));
}

TEST(Disc, IsWhereTheProjectionPutsIt) {
  const Size size{400, 300};
  for (const auto& [center, fov] : {pair{Vec3(0, 0, 0), 45.0}, {Vec3(1.1, 0.6, 0.4), 45.0}, {Vec3(4, 2.5, 0), 100.0}}) {
    Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero(), fov);
    add_ball(scene, center, 0.7, white);
    Renderer renderer(scene, size, 1);

    const Blob seen = blob_of(renderer.draw(scene.initial)), expected = expected_blob(scene, size, center, 0.7);
    EXPECT_NEAR(seen.x, expected.x, 0.15);  // measured: below 0.06
    EXPECT_NEAR(seen.y, expected.y, 0.15);
    EXPECT_NEAR(seen.area / expected.area, 1, 0.01);  // measured: below 0.005
    EXPECT_NEAR(seen.width, expected.width, 1.0);
    EXPECT_NEAR(seen.height, expected.height, 1.0);
  }
}

TEST(Disc, SmoothEdgesCoverAsMuchAsTheDisc) {
  // Of a white unshaded ball before black the bytes' linear light sums up to the area.
  const Size size{200, 200};
  for (double radius : {0.6, 0.11, 0.011}) {
    Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
    add_ball(scene, Vec3(0.123, 0.045, 0), radius, {0.5, 0.5, 0.5});
    Renderer renderer(scene, size, 4);
    const Image& image = renderer.draw(scene.initial);
    double light = 0, most = 0;
    for (uint8_t byte : image.pixels) {
      const double c = byte / 255.0;
      light += c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    }
    // Ambient light from halfway up, without what the rim reflects of the black background: 0.46 (1 - cos)^5, whose
    // mean over a disc is 0.46 / 21.
    const double grey_light = 0.21404 * 0.8 * (1 - 0.46 / 21);
    most = expected_blob(scene, size, Vec3(0.123, 0.045, 0), radius).area * 3 * grey_light;
    EXPECT_NEAR(light / most, 1, 0.08) << radius;  // measured: 0.066, of half a pixel
  }
}

TEST(Disc, TheNearerBallHidesTheFartherWhateverTheirOrder) {
  for (int swap = 0; swap < 2; ++swap) {
    Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
    add_ball(scene, Vec3(0, 0, swap ? 1 : -1), 0.5, swap ? red : blue);
    add_ball(scene, Vec3(0, 0, swap ? -1 : 1), 0.5, swap ? blue : red);
    Renderer renderer(scene, {100, 100}, 4);
    const uint8_t* middle = renderer.draw(scene.initial).row(50) + 3 * 50;
    EXPECT_GT(middle[0], 150);
    EXPECT_LT(middle[2], 60);
  }
}

TEST(Disc, ASmallBallInFrontOfALargeOnesFlankIsNotHidden) {
  // The large ball's centre is nearer to the eye than the small ball, which is nevertheless behind it; and the other
  // way round.
  Scene scene = flat_scene(Vec3(0, 0, 20), Vec3::Zero());
  add_ball(scene, Vec3(0, 0, 0), 5, blue);
  add_ball(scene, Vec3(4.95, 0, 1.6), 0.2, red);  // touches nothing, in front of the flank
  Renderer renderer(scene, {400, 400}, 4);
  const Image& image = renderer.draw(scene.initial);
  const Eye eye(*scene.camera, {400, 400});
  const Vec3 p = eye.point(Vec3(4.95, 0, 1.6));
  const auto x = static_cast<int>(200 + p.x() / p.z() / eye.pixel);
  EXPECT_GT((image.row(200) + 3 * x)[0], 150);
}

TEST(Disc, OverlappingBallsMeetInTheirCommonCircle) {
  // Equal balls side by side that overlap: seen from the front the seam is the line between them.
  Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  add_ball(scene, Vec3(-0.3, 0, 0), 0.5, red);
  add_ball(scene, Vec3(0.3, 0, 0), 0.5, blue);
  Renderer renderer(scene, {201, 201}, 4);
  const Image& image = renderer.draw(scene.initial);
  for (int y = 80; y <= 120; ++y) {
    EXPECT_GT((image.row(y) + 3 * 98)[0], 100 + (image.row(y) + 3 * 98)[2]);
    EXPECT_GT((image.row(y) + 3 * 102)[2], 100 + (image.row(y) + 3 * 102)[0]);
  }
}

TEST(Disc, PlusXIsOnTheLeftFromTheBooksCamera) {
  Scene scene = flat_scene(Vec3(0, 3, -5), Vec3::Zero());
  add_ball(scene, Vec3(1, 0, 0), 0.2, white);
  Renderer renderer(scene, {320, 180}, 4);
  EXPECT_LT(blob_of(renderer.draw(scene.initial)).x, 150);
}

TEST(Disc, ABallAroundTheEyeIsNotDrawnAndOneAcrossTheNearPlaneIs) {
  Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  scene.camera->near = 1;
  add_ball(scene, Vec3(0, 0, 5), 0.5, white);
  Renderer around(scene, {50, 50}, 4);
  EXPECT_EQ(grey(around.draw(scene.initial), 25, 25), 0);
  State state = scene.initial;
  state.position[0] = Vec3(0, 0, 4);  // from 0.5 to 1.5 ahead: cut open, the inside shows
  EXPECT_GT(grey(around.draw(state), 25, 25), 40);
  state.position[0] = Vec3(0.6, 0, 4.9);  // reaches behind the eye
  EXPECT_EQ(grey(around.draw(state), 2, 25), 0);
}

TEST(Plane, SeenFromBehindItHidesNothing) {
  Scene scene = flat_scene(Vec3(0, -3, 5), Vec3::Zero());
  add_plane(scene, Vec3(0, -1, 0), Vec3(0, 1, 0), green);
  add_ball(scene, Vec3::Zero(), 0.5, red);
  Renderer renderer(scene, {100, 100}, 4);
  const Image& image = renderer.draw(scene.initial);
  EXPECT_GT((image.row(50) + 3 * 50)[0], 150);
  EXPECT_EQ(grey(image, 2, 2), 0);
  EXPECT_EQ(grey(image, 50, 98), 0);
}

TEST(Plane, OfARoomOnlyTheFarSidesAreSeenFromOutside) {
  Scene scene = test::gas(0);
  scene.background.color = black;
  Camera camera;
  camera.eye = Vec3(0, 0, 20);
  camera.target = Vec3::Zero();
  camera.fov = 60;
  scene.camera = camera;
  Renderer renderer(scene, {300, 300}, 4);
  const Image& image = renderer.draw(scene.initial);
  EXPECT_GT(grey(image, 150, 150), 60);  // the far wall
  // The open front is at 15 m: its half side of 5 m is 150 / tan 30 * 5 / 15 = 86.6 pixels.
  EXPECT_EQ(grey(image, 150 - 90, 150), 0);
  EXPECT_GT(grey(image, 150 - 84, 150), 20);
}

TEST(Plane, InvisibleOnesAreNotDrawnAndCutNothingOff) {
  Scene scene = flat_scene(Vec3(0, 3, 5), Vec3::Zero());
  add_plane(scene, Vec3(0, 0, 0), Vec3(0, 1, 0), white, false);
  Renderer hidden(scene, {100, 100}, 4);
  EXPECT_EQ(grey(hidden.draw(scene.initial), 50, 90), 0);
  add_plane(scene, Vec3(0, -1, 0), Vec3(0, 1, 0), white);
  Renderer below(scene, {100, 100}, 4);
  EXPECT_GT(grey(below.draw(scene.initial), 50, 90), 100);
}

TEST(Wall, HidesWhatIsBehindItFromBothSides) {
  for (double side : {1.0, -1.0}) {
    Scene scene = flat_scene(Vec3(0, 0, 5 * side), Vec3::Zero());
    add_wall(scene, Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), 2, 2, green);
    add_ball(scene, Vec3(0, 0, -1), 0.5, red);
    Renderer renderer(scene, {100, 100}, 4);
    const uint8_t* middle = renderer.draw(scene.initial).row(50) + 3 * 50;
    EXPECT_EQ(middle[0] > 100, side < 0);
    EXPECT_EQ(middle[1] > 100, side > 0);
  }
}

TEST(Wall, ItsEdgeBlendsWithTheBallBehindItNotWithTheBackground) {
  // A white ball fills the picture behind a white wall's edge: nowhere does the black background shine through.
  Scene scene = flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  add_wall(scene, Vec3(1.003, 0, 0), Vec3(0, 0, 1), Vec3(0.1, 1, 0), 2, 40, white);
  add_ball(scene, Vec3(0, 0, -30), 25, white);
  Renderer renderer(scene, {100, 100}, 4);
  const Image& image = renderer.draw(scene.initial);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 90; ++x) EXPECT_GT(grey(image, x, y), 180) << x << ' ' << y;
}

}  // namespace
}  // namespace carom
