// The kernel that draws a tile: equal bytes in every vector width, and edges against supersampling.
#include <gtest/gtest.h>

#include "raster/shots.h"
#include "std.h"

namespace carom::raster {
namespace {

using test::ball;
using test::noise;
using test::shot_of;

vector<uint8_t> bytes_of(const Shot& shot, TileKernel kernel, int channels = 3) {
  const Line line{10, 10, 90, 60, 1, 3, 0.3F, 0.2F, {1, 1, 0}, 1, 0.2F, false};
  return test::drawn(shot, {.kernel = kernel, .channels = channels, .lines = {line}}).bytes;
}

/// Solids of all kinds, many and few, small and large, before a room.
Shot crowded(int balls, bool lamp) {
  Shot shot = shot_of(203, 121, 0.5);
  uint64_t seed = 3;
  const auto any = [&](double low, double high) { return static_cast<float>(low + (high - low) * noise(seed)); };

  for (int i = 0; i < balls; ++i) {
    const Float3 center{any(-2, 2), any(-1, 1), any(2, 7)};
    shot.solids.push_back(ball(center, any(0.01, 0.15)));
    shot.solids.back().color = {any(0, 1), any(0, 1), any(0, 1)};
    shot.solids.back().glow = i % 7 ? 0.0F : 0.5F;
  }

  for (const SolidKind kind : {SolidKind::box, SolidKind::cylinder, SolidKind::wall}) {
    Solid s = ball({any(-1, 1), any(-0.5, 0.5), any(2, 5)}, 0.7F);
    s.kind = kind;
    s.half = {0.3F, 0.2F, 0.3F};
    shot.solids.push_back(s);
  }

  shot.walls.push_back({Float3{1, 0, 0}, Float3{0, 0.8F, 0.6F}, Float3{0, 0.6F, -0.8F}});
  shot.solids.push_back(ball({0.2F, -0.1F, 0.15F}, 0.1F));  // across the near plane
  shot.grounds.push_back({{0, 1, 0}, 1, {1, 0, 0}, {0, 0, 1}, 0.3F, 0.2F, {0.6F, 0.5F, 0.4F}, true});
  shot.grounds.push_back({{0, 0, -1}, 8, {1, 0, 0}, {0, 1, 0}, 0.3F, 0.2F, {0.4F, 0.5F, 0.4F}, true});
  shot.floor.present = true, shot.floor.normal = {0, 1, 0}, shot.floor.height = 1, shot.floor.sky = {0.1F, 0.1F, 0.1F},
  shot.floor.key = {0.2F, 0.2F, 0.1F};
  if (lamp) shot.lighting.lamps[0] = {{0.5F, 1.5F, 3}, true, {0.8F, 0.8F, 0.7F}}, shot.lighting.lamp_radius = 0.1F;
  return shot;
}

TEST(Kernel, HasTheSameBytesInEveryWidth) {
  for (const int balls : {3, 40, 4000})
    for (const bool lamp : {false, true}) {
      const Shot shot = crowded(balls, lamp);
      const vector<TileKernel> kernels = tile_kernels();
      const vector<uint8_t> first = bytes_of(shot, kernels[0]);
      for (const TileKernel kernel : kernels) EXPECT_TRUE(bytes_of(shot, kernel) == first) << balls << ' ' << lamp;
    }
}

/// FNV-1a.
uint64_t hash_of(const vector<uint8_t>& bytes) {
  uint64_t hash = 14695981039346656037U;
  for (const uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211U;
  return hash;
}

TEST(Kernel, HasTheSameBytesByEveryCompiler) {
  EXPECT_EQ(hash_of(bytes_of(crowded(40, false), tile_kernels()[0], 4)), 4309339486549874026U);
  EXPECT_EQ(hash_of(bytes_of(crowded(4000, true), tile_kernels()[0], 4)), 11184119415032299788U);
}

/// The light of a byte.
double linear(uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(Edges, OfBallsAreThoseOfSixtyFourSamples) {
  // Balls that glow, on black: the light of a pixel is its covered share.
  Shot shot = shot_of(160, 120, 0.7);
  uint64_t seed = 5;

  for (int i = 0; i < 40; ++i) {
    const double z = 3 + 4 * noise(seed);
    shot.solids.push_back(ball({static_cast<float>((1.4 * noise(seed) - 0.7) * z),
                                static_cast<float>((noise(seed) - 0.5) * z), static_cast<float>(z)},
                               static_cast<float>(0.05 + 0.4 * noise(seed))));
    shot.solids.back().glow = 1;
  }

  const vector<uint8_t> pixels = bytes_of(shot, tile_kernels().back());
  double worst = 0, square = 0;
  int edges = 0;

  for (int y = 64; y < shot.lens.height; ++y)  // below the line that bytes_of() adds
    for (int x = 0; x < shot.lens.width; ++x) {
      int hits = 0;
      for (int k = 0; k < 64; ++k) {
        const double dx = double{shot.lens.left} + (x + (k % 8 + 0.5) / 8 - 0.5) * double{shot.lens.pixel};
        const double dy = double{shot.lens.top} - (y + (k / 8 + 0.5) / 8 - 0.5) * double{shot.lens.pixel};

        // A sample counts once, whichever ball its ray meets.
        for (const Solid& s : shot.solids) {
          const double dd = dx * dx + dy * dy + 1;
          const double dc = dx * double{s.center[0]} + dy * double{s.center[1]} + double{s.center[2]};
          const double cc =
              double{s.center[0]} * s.center[0] + double{s.center[1]} * s.center[1] + double{s.center[2]} * s.center[2];
          if (dc * dc - dd * (cc - double{s.radius} * s.radius) < 0) continue;
          ++hits;
          break;
        }
      }

      const double share =
          linear(pixels[3U * static_cast<unsigned>(y * shot.lens.width + x)]) / 0.85;  // by the tone curve
      const double error = share - hits / 64.0;
      if (hits > 0 && hits < 64) square += error * error, ++edges;
      worst = std::max(worst, std::abs(error));
    }

  EXPECT_GT(edges, 300);
  EXPECT_LT(std::sqrt(square / edges), 0.04);  // measured: 0.031
  EXPECT_LT(worst, 0.25);                      // measured: 0.215, where edges cross
}

}  // namespace
}  // namespace carom::raster
