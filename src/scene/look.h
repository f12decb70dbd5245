#pragma once
// The looks of pictures: floor, backdrop, lights, palette and outline in one word.

#include "scene/colors.h"
#include "std.h"

namespace carom {

enum class SceneLook : uint8_t { studio, table, night, chalkboard, blueprint, plain };

// In the order of SceneLook.
inline constexpr string_view look_names = "studio|table|night|chalkboard|blueprint|plain";

/// What planes show besides their colour.
enum class FloorPattern : uint8_t { none, squares, lines };

/// What a look gives to all that the scene says nothing of. Colours are sRGB, as 0xrrggbb.
struct LookStyle {
  array<uint32_t, 10> bodies;  // by number of the ball, body or group; neighbours differ clearly
  uint32_t plane, room, wall, obstacle;
  uint32_t above, horizon, below;  // of the backdrop
  bool seamless;                   // the backdrop begins at the horizon as the floor ends there
  FloorPattern pattern;
  double contrast;      // of the pattern, 0 to 1
  double spot;          // part of its light that a floor loses far away from the motion
  uint32_t key;         // colour of the key light
  double key_strength;  // of 1
  uint32_t ambient;
  double rim;      // light from behind that shows at the edges of things, 0 to 1
  double flat;     // part of its colour that a thing shows without regard to light
  double outline;  // pixels of a picture 720 pixels high; 0: none
  uint32_t ink;    // of outlines, of lines on planes and of a room's edges
};
const LookStyle& style_of(SceneLook look);
/// The colour of the i-th ball, body or group, where the scene gives none.
Color body_color(SceneLook look, size_t i);

/// How a surface reflects light.
enum class Finish : uint8_t { matte, plastic, metal, glass, glow };

// In the order of Finish.
inline constexpr string_view finish_names = "matte|plastic|metal|glass|glow";

string_view name_of(Finish finish);

/// The surface of a thing in pictures.
struct Surface {
  optional<Finish> finish;   // none: plastic; of a plane matte; of a room's sides glass, its floor matte
  optional<double> opacity;  // 0 to 1; none: 1, of glass 0.2
  friend bool operator==(const Surface&, const Surface&) = default;
};

}  // namespace carom
