// Each map is 16 colours of its published table of 256, those with the numbers 0, 17, 34 and so on to 255. Between them
// sRGB components are linear. Against the whole tables they differ by at most 10 of 255, in red near the start of
// cividis, and by 7 elsewhere.
//
// viridis, magma, plasma and inferno: Nathaniel J. Smith, Stefan van der Walt and Eric Firing, colormaps.py of
// https://github.com/BIDS/colormap, released under CC0. cividis: Jamie R. Nunez, Christopher R. Anderton and Ryan S.
// Renslow, "Optimizing colormaps with consideration for color vision deficiency", PLoS ONE 13(7), 2018, e0199239,
// released under CC0.
//
// All of them begin nearly black, where bodies would not be seen on a dark ground: their first part is left out.
#include "scene/color_map.h"

#include "numerics/srgb.h"
#include "std.h"

namespace carom {
namespace {

using MapColors = array<uint32_t, 16>;

// In the order of ColorMap.
constexpr array<MapColors, 5> maps = {{
    {0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779,
     0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725},
    {0x00224e, 0x002e6c, 0x1e3a6f, 0x35456c, 0x47516c, 0x575d6d, 0x666970, 0x757575, 0x848279, 0x948e77, 0xa59c74,
     0xb7a96e, 0xc8b866, 0xdbc75a, 0xeed649, 0xfee838},
    {0x000004, 0x0b0924, 0x20114b, 0x3b0f70, 0x57157e, 0x721f81, 0x8c2981, 0xa8327d, 0xc43c75, 0xde4968, 0xf1605d,
     0xfa7f5e, 0xfe9f6d, 0xfebf84, 0xfddea0, 0xfcfdbf},
    {0x0d0887, 0x330597, 0x5002a2, 0x6a00a8, 0x8405a7, 0x9c179e, 0xb12a90, 0xc33d80, 0xd35171, 0xe16462, 0xed7953,
     0xf68f44, 0xfca636, 0xfec029, 0xf9dc24, 0xf0f921},
    {0x000004, 0x0c0826, 0x240c4f, 0x420a68, 0x5d126e, 0x781c6d, 0x932667, 0xae305c, 0xc73e4c, 0xdd513a, 0xed6925,
     0xf8850f, 0xfca50a, 0xfac62d, 0xf2e661, 0xfcffa4},
}};

/// A colour of the published map, at 0 to 1.
Color published(ColorMap map, double at) {
  const MapColors& points = maps[size_t(map)];
  const double place = at * double(points.size() - 1);
  const size_t below = min(size_t(place), points.size() - 2);
  const double part = place - double(below);
  const Color a = from_rgb(points[below]), b = from_rgb(points[below + 1]);
  const auto between = [part](double low, double high) { return (1 - part) * low + part * high; };
  return {between(a.r, b.r), between(a.g, b.g), between(a.b, b.b)};
}

/// The contrast of a map's start to black: that of graphics which must be told from what they lie on
/// (WCAG 2.2, 1.4.11).
constexpr double least_contrast = 3;

/// Where a map is bright enough. It becomes lighter from its start on.
double start_of(ColorMap map) {
  const auto contrast = [&](double at) {
    const Color c = published(map, at);
    return (0.2126 * light_of_srgb(c.r) + 0.7152 * light_of_srgb(c.g) + 0.0722 * light_of_srgb(c.b) + 0.05) / 0.05;
  };
  double dark = 0, bright = 1;
  for (int i = 0; i < 20; ++i) {
    const double middle = (dark + bright) / 2;
    (contrast(middle) < least_contrast ? dark : bright) = middle;
  }
  return bright;
}

}  // namespace

Color color_in(ColorMap map, double at) {
  static const auto starts = [] {
    array<double, maps.size()> all{};
    for (size_t i = 0; i < all.size(); ++i) all[i] = start_of(ColorMap(i));
    return all;
  }();
  const double start = starts[size_t(map)];
  return published(map, start + clamp(at, 0.0, 1.0) * (1 - start));
}

}  // namespace carom
