// Lines over a picture: their width, ends, depth and opacity.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

Shot black(int width = 80, int height = 60) {
  return shot_of(width, height, 0.6);
}

/// A white line that is as deep as 1 / inverse.
Line line(float x0, float y0, float x1, float y1, float radius, float inverse = 1, float opacity = 1) {
  return {x0, y0, x1, y1, radius, radius, inverse, inverse, {1, 1, 1}, opacity, opacity, false};
}

double light_at(const Drawn& picture, int x, int y) {
  return picture.at(x, y).light.x();
}

/// From the middle of a pixel to the line (pixels).
double distance(const Line& l, int x, int y) {
  const Eigen::Vector2d a(double{l.x0}, double{l.y0}), b(double{l.x1}, double{l.y1}), p(x + 0.5, y + 0.5);
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm();
}

TEST(Lines, CoverWhatIsWithinTheirRadiusOfTheirMiddle) {
  for (const Line& l : {line(10, 12, 70, 50, 3), line(20.5F, 8, 20.5F, 55, 0.8F), line(60, 40, 62, 10, 6)}) {
    const Drawn picture = drawn(black(), {.lines = {l}});
    for_each_pixel(picture, [&](int x, int y, const Seen& seen) {
      const double share = std::clamp(double{l.radius0} + 0.5 - distance(l, x, y), 0.0, 1.0);
      EXPECT_NEAR(seen.light.x(), share, 1e-4) << x << ' ' << y;
    });
  }
}

TEST(Lines, TurnWiderAndFainterFromOneEndToTheOther) {
  Line l = line(10.5F, 30.5F, 70.5F, 30.5F, 2);
  l.radius1 = 6, l.opacity1 = 0.5F;
  const Drawn picture = drawn(black(), {.lines = {l}});
  EXPECT_NEAR(light_at(picture, 10, 30), 1, 1e-4);
  EXPECT_NEAR(light_at(picture, 40, 30), 0.75, 1e-4);
  EXPECT_NEAR(light_at(picture, 70, 30), 0.5, 1e-4);
  EXPECT_EQ(light_at(picture, 10, 34), 0);
  EXPECT_GT(light_at(picture, 70, 34), 0.4);
}

TEST(Lines, AreHiddenByNearerSolidsAlone) {
  Shot shot = black();
  shot.solids = {ball({0, 0, 3}, 0.5F)};
  shot.solids[0].color = {};
  const Line across = line(5, 30.5F, 75, 30.5F, 1);
  for (const bool before : {false, true}) {
    Line l = across;
    l.depth0 = l.depth1 = before ? 1 / 2.0F : 1 / 4.0F;
    const Drawn picture = drawn(shot, {.lines = {l}});
    EXPECT_NEAR(light_at(picture, 40, 30) > 0.9, before, 0);
    EXPECT_NEAR(light_at(picture, 8, 30), 1, 1e-4);
  }
}

TEST(Lines, AreBlendedByOpacityOneAfterTheOther) {
  const Line l = line(5, 30.5F, 75, 30.5F, 2, 1, 0.5F);
  EXPECT_NEAR(light_at(drawn(black(), {.lines = {l}}), 40, 30), 0.5, 1e-4);
  EXPECT_NEAR(light_at(drawn(black(), {.lines = {l, l}}), 40, 30), 0.75, 1e-4);
}

TEST(Lines, ThatAreJoinedAreOneWhereTheyOverlap) {
  Line first = line(5, 30.5F, 40, 30.5F, 2, 1, 0.5F), second = line(40, 30.5F, 75, 30.5F, 2, 1, 0.5F);
  second.joined = true;
  const Drawn picture = drawn(black(), {.lines = {first, second}});
  for (int x = 10; x < 70; ++x) EXPECT_NEAR(light_at(picture, x, 30), 0.5, 1e-4) << x;
}

TEST(Lines, MakeATransparentPictureOpaque) {
  Shot shot = black();
  shot.backdrop.none = true;
  const Drawn picture = drawn(shot, {.channels = 4, .lines = {line(5, 30.5F, 75, 30.5F, 2, 1, 0.5F)}});
  EXPECT_NEAR(picture.at(40, 30).alpha, 0.5, 1e-4);
  EXPECT_EQ(picture.at(40, 10).alpha, 0);
}

TEST(Lines, MayBeginAndEndOutsideOfThePicture) {
  const Line l = line(-500, 30.5F, 700, 30.5F, 1);
  const Drawn picture = drawn(black(), {.lines = {l}});
  for (int x = 0; x < 80; ++x) EXPECT_NEAR(light_at(picture, x, 30), 1, 1e-3) << x;
}

}  // namespace
}  // namespace carom::raster
