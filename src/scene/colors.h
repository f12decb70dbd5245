#pragma once
// Colours by name.

#include "std.h"

namespace carom {

/// An sRGB colour as written in scene files, not linear light. Each component is from 0 to 1.
struct Color {
  double r = 1, g = 1, b = 1;
  friend bool operator==(const Color&, const Color&) = default;
};

/// 0xrrggbb
constexpr Color from_rgb(uint32_t rgb) {
  return {((rgb >> 16) & 0xFF) / 255.0, ((rgb >> 8) & 0xFF) / 255.0, (rgb & 0xFF) / 255.0};
}

/// Accepts a CSS name in any case, "#rgb" or "#rrggbb".
optional<Color> parse_color(string_view text);

/// All 148 CSS names, in alphabetical order.
vector<string_view> color_names();

/// "#rrggbb"
string hex_text(const Color& color);

}  // namespace carom
