#pragma once
// Colours of bodies by a quantity.

#include "overlay/history.h"
#include "physics/state.h"
#include "scene/color_scale.h"
#include "scene/overlay.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// A colouring, its scale, and the names of its balls, bodies and groups.
struct ColorRule {
  Coloring coloring;
  ColorScale scale;
  vector<string> names;

  /// The colour of a value in the quantity's unit; of `group` the number of the name.
  Color color_of(double value) const;
};

/// The different colourings of a scene, in the order of its bodies.
vector<ColorRule> color_rules(const Scene& scene);

class BodyColors {
 public:
  /// `scene` must outlive this object.
  explicit BodyColors(const Scene& scene);

  /// By body; empty: those of the scene.
  vector<Color> at(const State& state, const History& history) const;
  /// The colour that a body with this velocity (m/s) had at an earlier `time` (s), no older than the trails.
  Color of(Entity body, double time, const Vec3& velocity, const State& state, const History& history) const;

 private:
  static constexpr uint32_t plain = 0xffffffff;

  const Scene& scene_;
  vector<ColorRule> rules_;
  vector<uint32_t> rule_;  // by body; `plain`: its colour is constant; empty: of all bodies
  vector<Color> color_;    // by body, if it is constant
  vector<uint32_t> name_;  // by body, of its rule
};

}  // namespace carom
