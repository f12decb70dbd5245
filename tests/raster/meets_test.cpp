// Where rays meet solids, against the formulas of textbooks in double precision.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

/// Rays well inside of the outline meet the solid where the formula says. Rays well beside it do not.
void expect_met(const Shot& shot, const Solid& solid) {
  int met = 0, missed = 0;
  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    const Vec3 d = ray(shot.lens, x, y);
    const auto place = inside(shot, solid, Vec3::Zero(), d);

    if (!inside(shot, solid, Vec3::Zero(), d, 1.15)) {
      EXPECT_TRUE(seen.layers.empty()) << x << ' ' << y;
      ++missed;
    } else if (inside(shot, solid, Vec3::Zero(), d, 0.9)) {
      ASSERT_EQ(seen.layers.size(), 1U) << x << ' ' << y;
      EXPECT_EQ(seen.layers[0].share, 1) << x << ' ' << y;
      EXPECT_NEAR(seen.layers[0].z, place->from, 2e-5 * place->from) << x << ' ' << y;
      EXPECT_FALSE(seen.layers[0].inside);
      ++met;
    }
  });

  EXPECT_GT(met, 100);
  EXPECT_GT(missed, 1000);
}

TEST(Rays, MeetEachKindOfSolidWhereItsFormulaSays) {
  Shot shot = shot_of(90, 70, 0.6);
  for (const Solid& s : one_of_each_kind(shot, {0.2F, -0.1F, 3})) {
    SCOPED_TRACE(static_cast<int>(s.kind));
    shot.solids = {s};
    expect_met(shot, s);
  }
}

TEST(Rays, MeetThemBeforeATiltedCameraToo) {
  Shot shot = shot_of(90, 70, 0.6);
  tilt(shot);
  for (const Solid& s : one_of_each_kind(shot, {-0.3F, 0.2F, 3})) {
    SCOPED_TRACE(static_cast<int>(s.kind));
    shot.solids = {s};
    expect_met(shot, s);
  }
}

TEST(Rays, MeetTheFarSideOfWhatTheNearPlaneCutsOpen) {
  Shot shot = shot_of(90, 70, 0.6);
  const Solid box =
      solid(SolidKind::box, {0, 0, 1}, {0.3F, 0.3F, 0.95F});  // its front is at 0.05, the near plane at 0.1
  shot.solids = {box};

  int cut = 0;
  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    const Vec3 d = ray(shot.lens, x, y);
    // Through the front and the back.
    if (std::max(std::abs(d.x()), std::abs(d.y())) > 0.9 * 0.3 / 1.95) return;
    ASSERT_EQ(seen.layers.size(), 1U);
    EXPECT_TRUE(seen.layers[0].inside);
    EXPECT_NEAR(seen.layers[0].z, 1.95, 1e-5);
    ++cut;
  });
  EXPECT_GT(cut, 100);
}

TEST(Rays, MeetABallThatReachesBehindTheEye) {
  Shot shot = shot_of(90, 70, 0.6);
  const Solid wide = ball({0.9F, 0, 0.5F}, 0.8F);
  shot.solids = {wide};

  int met = 0;
  for_each_pixel(drawn(shot), [&](int x, int y, const Seen& seen) {
    const auto place = inside(shot, wide, Vec3::Zero(), ray(shot.lens, x, y), 0.97);
    const auto exact = inside(shot, wide, Vec3::Zero(), ray(shot.lens, x, y));
    if (!place || exact->from < 0.11) return;
    ASSERT_EQ(seen.layers.size(), 1U) << x << ' ' << y;
    EXPECT_NEAR(seen.layers[0].z, exact->from, 1e-4);
    ++met;
  });

  EXPECT_GT(met, 100);
}

TEST(Rays, MeetNothingThatIsOutOfViewOrBehindTheEye) {
  Shot shot = shot_of(40, 40, 0.6);
  shot.solids = {ball({0, 0, -3}, 0.5F), ball({0, 0, 3}, 0.5F)};
  shot.solids[1].shadow_only = true;
  for_each_pixel(drawn(shot), [](int, int, const Seen& seen) {
    EXPECT_TRUE(seen.layers.empty());
    EXPECT_EQ(seen.clear, 1);
  });
}

}  // namespace
}  // namespace carom::raster
