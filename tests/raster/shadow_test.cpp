// Which points of a floor the key light reaches, against rays towards it in double precision.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

constexpr double height = 2;  // m, of the eye above the floor

/// A camera over a floor in the plane z = `height`, in the light of one lamp alone.
Shot over_a_floor(const Lamp& lamp) {
  Shot shot = shot_of(72, 64, 0.7);
  shot.lens.axes = {Float3{1, 0, 0}, Float3{0, 0, -1}, Float3{0, 1, 0}};
  shot.grounds = {{{0, 0, -1}, float{height}, {1, 0, 0}, {0, 1, 0}, 0, 0, {0.5F, 0.5F, 0.5F}, false}};
  shot.pattern = {1, 1000};
  shot.lighting.ambient = {};
  shot.lighting.softness = 1e-4F, shot.lighting.lamp_radius = 1e-4F;
  shot.lighting.lamps = {lamp};
  return shot;
}

const Lamp sun{unit({0.6F, 0.5F, -0.8F}), false, {1, 1, 1}};
const Lamp bulb{{0.4F, 0.2F, -1}, true, {1, 1, 1}};

Vec3 floor_point(const Shot& shot, int x, int y) {
  return height * ray(shot.lens, x, y);
}

/// Whether one of the solids, `scale` times as large, is between the point and the lamp.
bool is_blocked(const Shot& shot, const Vec3& p, double scale) {
  const Lamp& lamp = shot.lighting.lamps[0];
  const Vec3 way = lamp.near ? Vec3(vec(lamp.vector) - p) : vec(lamp.vector);
  return any_of(shot.solids, [&](const Solid& s) {
    const auto span = inside(shot, s, p, way, scale);
    return span && span->from > 0 && (!lamp.near || span->to < 1);
  });
}

struct Counts {
  int dark = 0, lit = 0;
};

/// The solids cast shadows, are not seen and send no light. Their edges, where shadows are blurred, are left out.
Counts expect_shadows(Shot shot, double least = 0.85, double most = 1.15) {
  for (Solid& s : shot.solids) s.shadow_only = true, s.color = {};
  Shot empty = shot;
  empty.solids.clear();
  const Drawn picture = drawn(shot), without = drawn(empty);

  Counts counts;
  for_each_pixel(picture, [&](int x, int y, const Seen& seen) {
    const Vec3 p = floor_point(shot, x, y);
    const double all = without.at(x, y).light.x();
    if (is_blocked(shot, p, least)) {
      EXPECT_LT(seen.light.x(), 0.02 * all) << x << ' ' << y;
      ++counts.dark;
    } else if (!is_blocked(shot, p, most)) {
      EXPECT_NEAR(seen.light.x(), all, 1e-5) << x << ' ' << y;
      ++counts.lit;
    }
  });

  return counts;
}

TEST(Shadows, OfEachKindLieWhereItIsInTheWayOfTheSun) {
  Shot shot = over_a_floor(sun);
  for (const Solid& s : one_of_each_kind(shot, {0.1F, 0, 1.3F})) {
    SCOPED_TRACE(static_cast<int>(s.kind));
    shot.solids = {s};
    const Counts counts = expect_shadows(shot);
    EXPECT_GT(counts.dark, 25);
    EXPECT_GT(counts.lit, 1000);
  }
}

TEST(Shadows, OfEachKindLieWhereItIsInTheWayOfALamp) {
  Shot shot = over_a_floor(bulb);
  for (const Solid& s : one_of_each_kind(shot, {0.1F, 0, 1.2F})) {
    SCOPED_TRACE(static_cast<int>(s.kind));
    shot.solids = {s};
    const Counts counts = expect_shadows(shot);
    EXPECT_GT(counts.dark, 25);
    EXPECT_GT(counts.lit, 500);
  }
}

TEST(Shadows, AreNotCastByWhatIsBehindTheLampOrBelowTheFloor) {
  Shot shot = over_a_floor(bulb);
  shot.solids = {ball({0.6F, 0.3F, -3}, 0.7F), ball({0, 0, 3.2F}, 0.8F)};
  EXPECT_EQ(expect_shadows(shot, 0.6, 1.1).lit, 72 * 64);

  // Close above the lamp: seen from there, the ball is beside the floor's far points.
  shot = over_a_floor({{0, 0, 1.5F}, true, {1, 1, 1}});
  shot.solids = {ball({0.05F, 0, 1.1F}, 0.35F)};
  EXPECT_EQ(expect_shadows(shot, 0.6, 1.05).lit, 72 * 64);
}

TEST(Shadows, OfACrowdAreThoseOfItsBalls) {
  for (const Lamp& lamp : {sun, bulb}) {
    Shot shot = over_a_floor(lamp);
    uint64_t seed = 21;
    for (int i = 0; i < 300; ++i)
      shot.solids.push_back(ball({static_cast<float>(2 * noise(seed) - 1), static_cast<float>(2 * noise(seed) - 1),
                                  static_cast<float>(0.5 + noise(seed))},
                                 0.08F));
    SCOPED_TRACE(lamp.near ? "lamp" : "sun");
    // A pixel is a quarter of their radius wide.
    const Counts counts = expect_shadows(shot, 0.6, 1.4);
    EXPECT_GT(counts.dark, 100);
    EXPECT_GT(counts.lit, 100);
  }
}

/// Pixels that have some of the light, but not all.
int half_lit(const Shot& shot) {
  int count = 0;
  double most = 0;
  const Drawn picture = drawn(shot);
  for_each_pixel(picture, [&](int, int, const Seen& seen) { most = std::max(most, seen.light.x()); });
  for_each_pixel(picture, [&](int, int, const Seen& seen) {
    count += seen.light.x() > 0.1 * most && seen.light.x() < 0.75 * most;
  });
  return count;
}

TEST(Shadows, AreTheSofterTheLargerTheLightLooks) {
  Shot shot = over_a_floor(sun);
  shot.solids = {ball({0, 0, 1}, 0.4F)};
  shot.solids[0].shadow_only = true;
  const int sharp = half_lit(shot);
  shot.lighting.softness = 0.2F;
  EXPECT_GT(half_lit(shot), 2 * sharp);
}

TEST(Shadows, AreNotCastByOtherLamps) {
  Shot shot = over_a_floor(sun);
  shot.lighting.lamps.push_back({{0, 0, -1}, false, {0.4F, 0.4F, 0.4F}});
  shot.solids = {ball({0, 0, 1.3F}, 0.4F)};
  shot.solids[0].shadow_only = true;

  Shot second = shot;
  second.lighting.lamps.erase(second.lighting.lamps.begin());
  second.solids.clear();
  const Drawn both = drawn(shot), alone = drawn(second);
  int dark = 0;

  for_each_pixel(both, [&](int x, int y, const Seen& seen) {
    if (!is_blocked(shot, floor_point(shot, x, y), 0.6)) return;
    EXPECT_NEAR(seen.light.x(), alone.at(x, y).light.x(), 0.01);
    ++dark;
  });

  EXPECT_GT(dark, 25);
}

}  // namespace
}  // namespace carom::raster
