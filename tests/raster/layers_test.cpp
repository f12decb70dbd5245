// What a pixel shows of several solids, and which share of it.
#include <gtest/gtest.h>

#include <numbers>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

Shot with_balls(int count) {
  Shot shot = shot_of(80, 60, 0.6);
  uint64_t seed = 11;
  const auto any = [&](double low, double high) { return static_cast<float>(low + (high - low) * noise(seed)); };
  for (int i = 0; i < count; ++i) {
    shot.solids.push_back(ball({any(-1, 1), any(-0.7, 0.7), any(2, 5)}, any(0.05, 0.3)));
    shot.solids.back().color = {any(0, 1), any(0, 1), any(0, 1)};
  }
  return shot;
}

TEST(Layers, AreSortedByDepthAndShareThePixel) {
  size_t most = 0;
  for_each_pixel(drawn(with_balls(60)), [&](int x, int y, const Seen& seen) {
    double sum = seen.clear;
    for (size_t k = 0; k < seen.layers.size(); ++k) {
      sum += seen.layers[k].share;
      EXPECT_LE(seen.layers[k > 0 ? k - 1 : 0].z, seen.layers[k].z) << x << ' ' << y;
    }

    EXPECT_NEAR(sum, 1, 2e-4) << x << ' ' << y;
    most = std::max(most, seen.layers.size());
  });
  EXPECT_GE(most, 3U);
}

TEST(Layers, OfOpaqueSolidsAreTheNearestOneAlone) {
  Shot shot = shot_of(40, 40, 0.2);
  for (const float z : {5.0F, 3.0F, 4.0F}) shot.solids.push_back(ball({0, 0, z}, 0.8F));
  const Drawn picture = drawn(shot);
  const Seen& middle = picture.at(20, 20);
  ASSERT_GE(middle.layers.size(), 1U);
  EXPECT_EQ(middle.layers[0].solid, 1);
  EXPECT_EQ(middle.layers[0].share, 1);
  EXPECT_EQ(middle.clear, 0);
}

TEST(Layers, DoNotDependOnTheOrderOfTheList) {
  Shot shot = with_balls(30);
  const Drawn before = drawn(shot);
  ranges::reverse(shot.solids);
  const Drawn after = drawn(shot);
  for_each_pixel(before, [&](int x, int y, const Seen& seen) {
    EXPECT_NEAR((seen.light - after.at(x, y).light).norm(), 0, 1e-4) << x << ' ' << y;
  });
}

/// A wall across the left of the picture, which ends at this place of pixel 40, from 0 to 1.
Shot with_edge(double end) {
  Shot shot = shot_of(80, 60, 0.6);
  shot.walls.push_back({Float3{1, 0, 0}, Float3{0, 1, 0}, Float3{0, 0, -1}});
  const double x = 2 * (double{shot.lens.left} + (40 - 0.5 + end) * double{shot.lens.pixel});
  shot.solids = {solid(SolidKind::wall, {static_cast<float>(x - 2), 0, 2.01F}, {2, 3, 0.01F})};
  return shot;
}

TEST(Layers, AtAnEdgeHaveTheCoveredShareOfThePixel) {
  for (const double end : {0.1, 0.25, 0.5, 0.8}) {
    const Drawn picture = drawn(with_edge(end));
    ASSERT_EQ(picture.at(40, 30).layers.size(), 1U);
    EXPECT_NEAR(picture.at(40, 30).layers[0].share, end, 1e-3);
    EXPECT_NEAR(picture.at(40, 30).clear, 1 - end, 1e-3);
    EXPECT_EQ(picture.at(39, 30).clear, 0);
    EXPECT_EQ(picture.at(41, 30).clear, 1);
  }
}

TEST(Layers, WithoutSmoothEdgesAreAllOrNothing) {
  for (const double end : {0.25, 0.75}) {
    Shot shot = with_edge(end);
    shot.lens.smooth = false;
    EXPECT_EQ(drawn(shot).at(40, 30).clear, end > 0.5 ? 0 : 1);
  }
}

TEST(Layers, OfABallSmallerThanAPixelHaveItsArea) {
  for (const double pixels : {0.1, 0.3, 0.6, 1.0}) {
    Shot shot = shot_of(64, 64, 0.5);
    shot.solids = {ball({0.013F, 0.021F, 4}, static_cast<float>(pixels * 4 * double{shot.lens.pixel}))};

    double area = 0;
    for_each_pixel(drawn(shot), [&](int, int, const Seen& seen) { area += 1 - seen.clear; });
    EXPECT_NEAR(area / (std::numbers::pi * pixels * pixels), 1, 0.12) << pixels;
  }
}

TEST(Layers, TakeMeshesAsTheyWereDrawnElsewhere) {
  Shot shot = shot_of(40, 40, 0.5);
  shot.solids = {solid(SolidKind::mesh, {0, 0, 3}, {1, 1, 1}), ball({0, 0, 5}, 3)};
  shot.meshes.push_back({});
  MeshPixels meshes;
  meshes.depth.resize(1600), meshes.cover.resize(1600), meshes.solid.resize(1600);
  meshes.normal.resize(1600, {0, 0, -1}), meshes.color.resize(1600, {1, 0, 0});
  const size_t pixel = 17 * 40 + 23;
  meshes.depth[pixel] = 1.5F, meshes.cover[pixel] = 0.25F;
  shot.mesh_pixels = &meshes;

  const Drawn picture = drawn(shot);
  const Seen& seen = picture.at(23, 17);
  ASSERT_EQ(seen.layers.size(), 2U);
  EXPECT_EQ(seen.layers[0].z, 1.5);
  EXPECT_EQ(seen.layers[0].share, 0.25);
  EXPECT_EQ(seen.layers[0].solid, 0);
  EXPECT_EQ(seen.layers[1].share, 0.75);
  EXPECT_EQ(picture.at(22, 17).layers.size(), 1U);
}

}  // namespace
}  // namespace carom::raster
