// Palettes keep neighbours apart in print: each colour differs from the next in lightness too.
#include "scene/look.h"

#include "scene/field.h"
#include "std.h"

namespace carom {
namespace {

// In the order of SceneLook.
constexpr array<LookStyle, 6> styles = {{
    {.bodies = {0xc8413f, 0x2f6fae, 0xe7a52f, 0x3f8f57, 0x7d55a0, 0xe2703a, 0x1b8f8f, 0xd86f9c, 0x7a5a41, 0x4d5bd0},
     .plane = 0xe3e4e6,
     .room = 0xc9d3de,
     .wall = 0x8d98a5,
     .obstacle = 0xa8a196,
     .above = 0xa3adba,
     .horizon = 0xdfe2e6,
     .below = 0xb9bec6,
     .seamless = true,
     .pattern = FloorPattern::none,
     .contrast = 0,
     .spot = 0.3,
     .key = 0xfff4e2,
     .key_strength = 0.86,
     .ambient = 0x8b929c,
     .rim = 0.35,
     .flat = 0,
     .outline = 0,
     .ink = 0x1f2226},
    {.bodies = {0xd1495b, 0x2e86ab, 0xedae49, 0x5b8e3e, 0x8d5fb0, 0xef7b45, 0x1b998b, 0xe38fb0, 0x7c5c3f, 0x5c7cfa},
     .plane = 0x9c6b43,
     .room = 0xc9b9a3,
     .wall = 0x6d4a2f,
     .obstacle = 0x8a6a4a,
     .above = 0x2c211b,
     .horizon = 0x5d4636,
     .below = 0x33251c,
     .seamless = false,
     .pattern = FloorPattern::squares,
     .contrast = 0.16,
     .spot = 0.6,
     .key = 0xffe2b5,
     .key_strength = 0.95,
     .ambient = 0x776b60,
     .rim = 0.3,
     .flat = 0,
     .outline = 0,
     .ink = 0x1d1510},
    {.bodies = {0xff6b5e, 0x59b4ff, 0xffc857, 0x7ddf8a, 0xb58cff, 0xff9a52, 0x4fd8cf, 0xff94c2, 0xc9a27e, 0x8c9bff},
     .plane = 0x23283a,
     .room = 0x39425c,
     .wall = 0x3d4660,
     .obstacle = 0x4a5068,
     .above = 0x05070d,
     .horizon = 0x141a2b,
     .below = 0x07090f,
     .seamless = true,
     .pattern = FloorPattern::none,
     .contrast = 0,
     .spot = 0.85,
     .key = 0xf3f6ff,
     .key_strength = 0.95,
     .ambient = 0x4b5570,
     .rim = 0.8,
     .flat = 0,
     .outline = 0,
     .ink = 0x9fb0d8},
    {.bodies = {0xe8a3a0, 0x9cc3e6, 0xf0dd9a, 0xa9d6a5, 0xcbb5e6, 0xf0bd93, 0x9adbd3, 0xefb8d2, 0xd3bfa6, 0xb3bcf2},
     .plane = 0x2f4a3f,
     .room = 0x2f4a3f,
     .wall = 0x54705f,
     .obstacle = 0x5f7a69,
     .above = 0x263d34,
     .horizon = 0x2f4a3f,
     .below = 0x263d34,
     .seamless = true,
     .pattern = FloorPattern::none,
     .contrast = 0,
     .spot = 0.25,
     .key = 0xffffff,
     .key_strength = 0.45,
     .ambient = 0xb0b0b0,
     .rim = 0,
     .flat = 0.75,
     .outline = 2.2,
     .ink = 0xf2f0e6},
    {.bodies = {0x7fb2e8, 0xa7c9ef, 0x6ba3df, 0xbcd7f4, 0x8fbdea, 0xd0e3f8, 0x5f98d6, 0xb2d0f1, 0x9ac4ec, 0xc6ddf6},
     .plane = 0x174a86,
     .room = 0x174a86,
     .wall = 0x3a70b0,
     .obstacle = 0x3f77b8,
     .above = 0x133f74,
     .horizon = 0x174a86,
     .below = 0x133f74,
     .seamless = true,
     .pattern = FloorPattern::lines,
     .contrast = 0.35,
     .spot = 0.2,
     .key = 0xffffff,
     .key_strength = 0.35,
     .ambient = 0xc0c0c0,
     .rim = 0,
     .flat = 0.85,
     .outline = 1.8,
     .ink = 0xe9f2ff},
    {.bodies = {0xd1495b, 0x2e86ab, 0xedae49, 0x5b8e3e, 0x8d5fb0, 0xef7b45, 0x1b998b, 0xe38fb0, 0x7c5c3f, 0x5c7cfa},
     .plane = 0xffffff,
     .room = 0xffffff,
     .wall = 0xc4cad1,
     .obstacle = 0xcfcac0,
     .above = 0xffffff,
     .horizon = 0xffffff,
     .below = 0xffffff,
     .seamless = true,
     .pattern = FloorPattern::none,
     .contrast = 0,
     .spot = 0,
     .key = 0xffffff,
     .key_strength = 0.4,
     .ambient = 0xe0e0e0,
     .rim = 0,
     .flat = 0.7,
     .outline = 1.4,
     .ink = 0x202020},
}};

}  // namespace

const LookStyle& style_of(SceneLook look) {
  return styles[size_t(look)];
}

Color body_color(SceneLook look, size_t i) {
  const auto& palette = style_of(look).bodies;
  return from_rgb(palette[i % palette.size()]);
}

string_view name_of(Finish finish) {
  return parts_of(finish_names)[size_t(finish)];
}

}  // namespace carom
