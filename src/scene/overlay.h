#pragma once
// What pictures show besides the bodies: colours by a quantity, text, trails, arrows. Types only.

#include "physics/entity.h"
#include "scene/color_map.h"
#include "std.h"

namespace carom {

enum class ColorQuantity : uint8_t { speed, kinetic, collisions, mass, radius, group };

// In the order of ColorQuantity.
inline constexpr string_view quantity_names = "speed|kinetic|collisions|mass|radius|group";

/// Colours of bodies by a quantity, in its SI unit. Bodies with equal colourings share one scale and one legend.
struct Coloring {
  optional<ColorQuantity> by;  // none: a wrong value
  /// The ends of the map. None: from the scene at time 0 (color_scale.h).
  optional<double> min, max;
  ColorMap map = ColorMap::viridis;
  friend bool operator==(const Coloring&, const Coloring&) = default;
};

/// The paths of bodies during the last seconds.
struct Trails {
  double seconds = 1;
  optional<double> width;  // m; none: half a body's radius
  vector<Entity> on{};     // ascending; empty: all bodies
};

/// Values beside bodies, in this order.
struct Labels {
  bool name = false, speed = false, momentum = false;
  vector<Entity> on{};                                                  // ascending; empty: all bodies
  int count() const { return int(name) + int(speed) + int(momentum); }  // of values beside a body
};

struct Overlay {
  /// A template (caption.h) without paths into the scene. Empty: none.
  string caption;
  optional<Trails> trails;
  bool flash = false;  // of bodies that collide
  bool velocity_arrows = false, momentum_arrows = false, force_arrows = false;
  optional<Labels> labels;
  bool scale_bar = false;
  /// The part of the interval between pictures in which the shutter is open, 0 to 1.
  double shutter = 0;
  /// Numbers of forces in World::forces. Their springs are not drawn.
  vector<size_t> hidden_springs;
  // Numbers of springs between bodies that are not drawn, ascending.
  vector<size_t> hidden_body_springs;
  /// Numbers of strings in World::strings that are not drawn, ascending.
  vector<size_t> hidden_strings;
};

}  // namespace carom
