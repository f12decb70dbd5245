// The light that solids send to the eye.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

/// A ball before black, in the light of one lamp alone.
Shot one_ball(const Lamp& lamp) {
  Shot shot = shot_of(64, 64, 0.3);
  shot.lighting.ambient = {};
  shot.lighting.lamps = {lamp};
  shot.solids = {ball({0, 0, 3}, 0.7F)};
  shot.solids[0].color = {0.4F, 0.2F, 0.1F};
  return shot;
}

/// The share of a mirror at this angle to the eye beyond its least share, by Schlick's approximation.
double mirrored(double facing) {
  return 0.46 * std::pow(1 - facing, 5);
}

/// Compares pixels without a glint with Lambert's law. Returns their number.
int expect_matt(const Shot& shot) {
  const Solid& s = shot.solids[0];
  const Lamp& lamp = shot.lighting.lamps[0];
  int compared = 0;
  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    if (seen.layers.empty() || seen.layers[0].share < 1) return;
    const Vec3 p = seen.layers[0].z * ray(shot.lens, x, y), n = (p - vec(s.center)).normalized();
    const Vec3 l = lamp.near ? Vec3((vec(lamp.vector) - p).normalized()) : vec(lamp.vector), v = -p.normalized();
    if (n.dot((l + v).normalized()) > 0.85 || std::abs(n.dot(l)) < 0.02) return;

    const double cosine = std::max(n.dot(l), 0.0);
    const Vec3 matt = cosine * (1 - mirrored(n.dot(v))) * vec(s.color);
    EXPECT_NEAR((seen.light - matt).norm(), 0, 2e-3) << x << ' ' << y;
    ++compared;
  });
  return compared;
}

TEST(Light, OfTheSunOnAMattBallFollowsTheCosine) {
  EXPECT_GT(expect_matt(one_ball({unit({0.8F, 0.4F, -0.3F}), false, {1, 1, 1}})), 500);
}

TEST(Light, OfALampOnAMattBallFollowsTheCosineToItsPlace) {
  EXPECT_GT(expect_matt(one_ball({{3, 1, 2}, true, {1, 1, 1}})), 500);
}

TEST(Light, GlintsWhereTheBallMirrorsTheLamp) {
  const Shot shot = one_ball({unit({0.5F, 0.5F, -0.7F}), false, {1, 1, 1}});
  double most = 0;
  Vec3 brightest;
  const Drawn picture = drawn(shot);

  for_each_pixel(picture, [&](int x, int y, const Seen& seen) {
    if (seen.layers.empty() || seen.light.z() <= most) return;
    most = seen.light.z();
    brightest = (seen.layers[0].z * ray(shot.lens, x, y) - vec(shot.solids[0].center)).normalized();
  });

  const Vec3 p = vec(shot.solids[0].center) + 0.7 * brightest;
  const Vec3 between = (vec(shot.lighting.lamps[0].vector) - p.normalized()).normalized();
  EXPECT_GT(brightest.dot(between), 0.995);
  EXPECT_GT(most, 0.3);
}

TEST(Light, OfWhatGlowsIsWhiteByItsShare) {
  Shot shot = one_ball({{0, 0, 1}, false, {1, 1, 1}});  // from behind
  for (const float glow : {0.0F, 0.5F, 0.7F}) {
    shot.solids[0].glow = glow;
    EXPECT_NEAR((drawn(shot).at(32, 32).light - double{glow} * Vec3::Ones()).norm(), 0, 0.01);
  }
}

TEST(Light, OfTheSkyIsHalfFromBelowTheHorizon) {
  // Of a face to the side, half of the directions are below the horizon, and send 0.6 of the sky's light.
  Shot shot = one_ball({{0, 0, 1}, false, {}});
  shot.lighting.ambient = {0.5F, 0.5F, 0.5F};
  EXPECT_NEAR(drawn(shot).at(32, 32).light.x(), 0.4 * 0.5 * 0.8, 2e-3);
}

TEST(Light, IsPressedBelowOne) {
  Shot shot = one_ball({{0, 0, -1}, false, {50, 50, 50}});
  for_each_pixel(drawn(shot), [](int, int, const Seen& seen) { EXPECT_LT(seen.light.maxCoeff(), 1); });
}

TEST(Light, OnFacesOfABoxIsThatOfTheirNormals) {
  Shot shot = one_ball({unit({0.2F, 0.3F, -0.9F}), false, {1, 1, 1}});
  tilt(shot);
  shot.solids = {solid(SolidKind::box, {0, 0, 3}, {0.4F, 0.4F, 0.4F})};
  shot.solids[0].color = {0.3F, 0.3F, 0.3F};
  int compared = 0;

  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    if (seen.layers.empty() || seen.layers[0].share < 1) return;
    const Vec3 p = seen.layers[0].z * ray(shot.lens, x, y), off = p - vec(shot.solids[0].center);

    // The face is the farthest out. Close to an edge its tone is another.
    array<double, 3> out{};
    for (size_t k = 0; k < 3; ++k) out[k] = vec(shot.lens.axes[k]).dot(off);
    ranges::sort(out, [](double a, double b) { return std::abs(a) > std::abs(b); });
    if (std::abs(out[1]) > 0.3) return;
    const size_t face = static_cast<size_t>(
        ranges::max_element(shot.lens.axes, {}, [&](const Float3& axis) { return std::abs(vec(axis).dot(off)); }) -
        shot.lens.axes.begin());
    const Vec3 n = (out[0] < 0 ? -1 : 1) * vec(shot.lens.axes[face]), v = -p.normalized();
    const Vec3 l = vec(shot.lighting.lamps[0].vector);
    if (n.dot((l + v).normalized()) > 0.85) return;

    EXPECT_NEAR(seen.light.x(), 0.3 * (1 - mirrored(n.dot(v))) * std::max(n.dot(l), 0.0), 2e-3) << x << ' ' << y;
    ++compared;
  });

  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace carom::raster
