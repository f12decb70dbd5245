// The tiles of a picture: their order, the threads that draw them, and where they begin change nothing.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "raster/threads.h"
#include "std.h"

namespace carom::raster {
namespace {

using namespace test;

Shot room(int width, int height) {
  Shot shot = shot_of(width, height, 0.6);
  uint64_t seed = 8;
  const auto any = [&](double low, double high) { return static_cast<float>(low + (high - low) * noise(seed)); };
  for (int i = 0; i < 50; ++i) shot.solids.push_back(ball({any(-1, 1), any(-0.7, 0.7), any(2, 5)}, any(0.05, 0.3)));
  shot.solids.push_back(solid(SolidKind::box, {0.3F, 0.1F, 3}, {0.2F, 0.2F, 0.2F}));
  shot.grounds = {{{0, 1, 0}, 1, {1, 0, 0}, {0, 0, 1}, 0, 0, {0.6F, 0.5F, 0.4F}, false}};
  return shot;
}

vector<uint8_t> by_threads(const Shot& shot, Threads& threads) {
  Silhouettes silhouettes;
  silhouettes.fill(shot);
  Bins bins;
  bins.fill(shot, silhouettes);
  LightGrid lights;
  lights.fill(shot);
  vector<uint8_t> bytes(size_t{3} * static_cast<size_t>(shot.lens.width * shot.lens.height));
  threads.draw({&shot, &silhouettes, &bins, &lights, nullptr, nullptr, bytes.data(), 3});
  return bytes;
}

TEST(Tiles, GiveTheSamePictureInAnyOrder) {
  const Shot shot = room(150, 110);
  EXPECT_TRUE(drawn(shot).bytes == drawn(shot, {.last_tile_first = true}).bytes);
}

TEST(Tiles, GiveTheSamePictureByAnyNumberOfThreads) {
  const Shot shot = room(150, 110);
  const vector<uint8_t> expected = drawn(shot).bytes;
  for (const int count : {1, 2, 5}) {
    Threads threads(count);
    EXPECT_TRUE(by_threads(shot, threads) == expected) << count;
  }
}

TEST(Tiles, KeepNothingOfTheLastPicture) {
  Threads threads(2);
  const Shot crowded = room(150, 110);
  Shot other = room(90, 40);
  other.solids.resize(5);
  by_threads(crowded, threads);
  EXPECT_TRUE(by_threads(other, threads) == drawn(other).bytes);
  EXPECT_TRUE(by_threads(crowded, threads) == drawn(crowded).bytes);
}

TEST(Tiles, MayBeCutOffByThePicture) {
  // The same pixels, of a picture that ends in its tiles at other places.
  const Shot whole = room(128, 96);
  Shot part = whole;
  part.lens.width = 71, part.lens.height = 33;
  const Drawn all = drawn(whole);
  for_each_pixel(drawn(part), [&](int x, int y, const Seen& seen) {
    EXPECT_NEAR((seen.light - all.at(x, y).light).norm(), 0, 1e-6) << x << ' ' << y;
  });
}

TEST(Tiles, MayBeginAnywhere) {
  const Shot whole = room(128, 96);
  Shot part = whole;
  constexpr int right = 13, down = 5;
  part.lens.width -= right, part.lens.height -= down;
  part.lens.left += right * part.lens.pixel, part.lens.top -= down * part.lens.pixel;
  const Drawn all = drawn(whole);
  for_each_pixel(drawn(part), [&](int x, int y, const Seen& seen) {
    EXPECT_NEAR((seen.light - all.at(x + right, y + down).light).norm(), 0, 5e-3) << x << ' ' << y;
  });
}

}  // namespace
}  // namespace carom::raster
