// Planes with their pattern, and the background.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

/// A plane whose free side is where n points, with the eye at this height above it.
Ground ground(const Float3& n, float height) {
  const Across sides = across(n);
  return {n, height, sides.u, sides.v, 0, 0, {0.5F, 0.5F, 0.5F}, false};
}

/// A line that is not seen: with lines the kernel finds how deep each pixel is.
const Line no_line{0, 0, 1, 1, 1, 1, 1, 1, {1, 1, 1}, 0, 0, false};

/// 1 / z of the plane through which the ray leaves the room, 0: the background.
double inverse_depth(const Shot& shot, const Vec3& d) {
  double nearest = 0;
  for (const Ground& g : shot.grounds) nearest = std::max(nearest, -vec(g.normal).dot(d) / double{g.height});
  return nearest;
}

TEST(Planes, AreAsDeepAsTheirEquationSays) {
  Shot shot = shot_of(90, 70, 0.6);
  shot.grounds = {ground(unit({0.1F, 0.9F, -0.2F}), 1.5F)};
  int below = 0;
  for_each_pixel(drawn(shot, {.lines = {no_line}}), [&](int x, int y, const Seen& seen) {
    const double inverse = inverse_depth(shot, ray(shot.lens, x, y));
    EXPECT_NEAR(seen.inverse, inverse, 1e-6) << x << ' ' << y;
    below += inverse > 0;
  });
  EXPECT_GT(below, 1000);
}

TEST(Planes, OfARoomHideEachOther) {
  Shot shot = shot_of(90, 70, 0.6);
  shot.grounds = {ground({0, 1, 0}, 1), ground({1, 0, 0}, 1.5F), ground({0, 0, -1}, 4), ground({0, -1, 0}, 1)};
  for_each_pixel(drawn(shot, {.lines = {no_line}}), [&](int x, int y, const Seen& seen) {
    // Where two meet, the pixel has a share of each.
    EXPECT_NEAR(seen.inverse, inverse_depth(shot, ray(shot.lens, x, y)), 0.02) << x << ' ' << y;
  });
}

TEST(Planes, HaveTheSquaresOfAChessboard) {
  Shot shot = shot_of(96, 96, 0.8);
  shot.grounds = {ground({0, 0, -1}, 2)};
  shot.grounds[0].right_offset = 0.3F, shot.grounds[0].up_offset = -0.2F;
  shot.pattern = {0.5F, 1000};
  const Ground& g = shot.grounds[0];

  // All of the plane has the same light, so that its tone alone tells the squares apart.
  array<double, 2> light{};
  int compared = 0;
  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    const Vec3 p = 2 * ray(shot.lens, x, y);
    const double u = (vec(g.right).dot(p) + double{g.right_offset}) / 0.5;
    const double v = (vec(g.up).dot(p) + double{g.up_offset}) / 0.5;
    const double from_line = std::min(std::abs(u - std::round(u)), std::abs(v - std::round(v)));
    if (from_line < 0.05) return;

    double& known = light[(static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) % 2 != 0];
    if (known == 0) known = seen.light.x();
    EXPECT_NEAR(seen.light.x(), known, 1e-4) << x << ' ' << y;
    ++compared;
  });
  EXPECT_GT(compared, 1000);
  EXPECT_NEAR(std::min(light[0], light[1]) / std::max(light[0], light[1]), 0.9, 0.01);
}

TEST(Planes, FadeIntoAnEvenToneWhereSquaresAreSmallerThanPixels) {
  Shot shot = shot_of(64, 64, 0.8);
  shot.grounds = {ground({0, 0, -1}, 2)};
  shot.pattern = {0.01F, 1000};
  const Drawn picture = drawn(shot);
  for_each_pixel(picture,
                 [&](int, int, const Seen& seen) { EXPECT_NEAR(seen.light.x(), picture.at(0, 0).light.x(), 1e-4); });
}

TEST(Planes, TakeLessOfTheSkyBesideABall) {
  Shot shot = shot_of(96, 96, 0.8);
  shot.grounds = {ground({0, 0, -1}, 2)};
  shot.pattern = {0.001F, 1000};
  shot.lighting.lamps[0].radiance = {};
  shot.solids = {ball({0, 0, 1.5F}, 0.5F)};
  shot.solids[0].color = {}, shot.solids[0].shadow_only = true;
  const double open = drawn(shot).at(1, 1).light.x();

  int compared = 0;
  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    // The share that a ball takes of an even sky: cos(angle) (r / d)^2. Small shares fade.
    const Vec3 to = vec(shot.solids[0].center) - 2 * ray(shot.lens, x, y);
    const double near2 = 0.25 / to.squaredNorm(), taken = -to.z() / to.norm() * near2;
    if (near2 < 3 * double{least_taken}) return;
    EXPECT_NEAR(seen.light.x() / open, 1 - 0.85 * std::min(taken, 1.0), 1e-3) << x << ' ' << y;
    ++compared;
  });
  EXPECT_GT(compared, 100);
}

TEST(Background, OfOneColourIsThatColour) {
  Shot shot = shot_of(40, 40, 0.5);
  shot.backdrop.color = {0.1F, 0.2F, 0.3F};
  for_each_pixel(drawn(shot), [](int, int, const Seen& seen) {
    EXPECT_NEAR((seen.light - Vec3(0.1, 0.2, 0.3)).norm(), 0, 1e-6);
    EXPECT_EQ(seen.alpha, 1);
  });
}

TEST(Background, ThatIsNoneIsTransparentWhereNoSolidIs) {
  Shot shot = shot_of(40, 40, 0.5);
  shot.backdrop.none = true;
  shot.solids = {ball({0, 0, 3}, 0.5F)};
  const Drawn picture = drawn(shot, {.channels = 4});
  for_each_pixel(picture, [&](int x, int y, const Seen& seen) {
    EXPECT_NEAR(seen.alpha, 1 - seen.clear, 1e-6);
    EXPECT_NEAR(picture.bytes[4 * static_cast<size_t>(y * 40 + x) + 3], 255 * seen.alpha, 0.51);
  });
}

TEST(Background, OfASkyDependsOnTheHeightAlone) {
  Shot shot = shot_of(41, 40, 0.5);
  shot.backdrop.plain = false;
  shot.backdrop.horizon = {0.6F, 0.6F, 0.6F}, shot.backdrop.above = {0.2F, 0.3F, 0.4F};
  const Drawn level = drawn(shot);
  for_each_pixel(level, [&](int x, int y, const Seen& seen) {
    EXPECT_NEAR((seen.light - level.at(40 - x, y).light).norm(), 0, 1e-6);
  });
  EXPECT_GT(level.at(20, 19).light.x(), level.at(20, 0).light.x());

  // The same rays about the vertical axis, the camera turned by a quarter.
  Shot turned = shot;
  turned.lens.axes = {Float3{0, 0, 1}, Float3{0, 1, 0}, Float3{1, 0, 0}};
  const Drawn other = drawn(turned);
  for_each_pixel(
      level, [&](int x, int y, const Seen& seen) { EXPECT_NEAR((seen.light - other.at(x, y).light).norm(), 0, 1e-6); });
}

}  // namespace
}  // namespace carom::raster
