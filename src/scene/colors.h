#pragma once
// Colours by name and colours for things that name none.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// sRGB as authors write it (not linear light), each 0 to 1.
struct Color {
  double r = 1, g = 1, b = 1;
};

/// A CSS name (any case), "#rgb" or "#rrggbb".
std::optional<Color> parse_color(std::string_view text);

/// All 148 CSS names, in alphabetical order.
std::vector<std::string_view> color_names();

/// The colour, as "#rrggbb", of the i-th ball or group that names none: neighbours differ clearly.
std::string_view body_color(std::size_t i);
inline constexpr std::string_view plane_color = "#b8bcc2";
inline constexpr std::string_view wall_color = "#9aa3ad";
inline constexpr std::string_view obstacle_color = "#a39a8c";
inline constexpr std::string_view room_color = "#c9ccd1";

}  // namespace carom
