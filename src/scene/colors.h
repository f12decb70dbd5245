#pragma once
// Colours by name, and default colours.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// An sRGB colour as written in scene files, not linear light. Each component is from 0 to 1.
struct Color {
  double r = 1, g = 1, b = 1;
  friend bool operator==(const Color&, const Color&) = default;
};

/// Accepts a CSS name in any case, "#rgb" or "#rrggbb".
std::optional<Color> parse_color(std::string_view text);

/// All 148 CSS names, in alphabetical order.
std::vector<std::string_view> color_names();

/// The default colour, as "#rrggbb", of the i-th ball or group. Neighbours differ clearly.
std::string_view body_color(std::size_t i);
inline constexpr std::string_view plane_color = "#b8bcc2";
inline constexpr std::string_view wall_color = "#9aa3ad";
inline constexpr std::string_view obstacle_color = "#a39a8c";
inline constexpr std::string_view room_color = "#c9ccd1";

}  // namespace carom
