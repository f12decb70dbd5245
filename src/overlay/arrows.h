#pragma once
// Arrows of velocity, momentum and force at bodies.

#include "overlay/moment.h"
#include "render/drawing.h"
#include "std.h"

namespace carom {

/// A kind of arrows: its colour, and the quantity that is as long as a metre.
struct ArrowScale {
  enum class Kind : uint8_t { velocity, momentum, force };
  Kind kind = Kind::velocity;
  double typical = 1;  // in its unit: what an arrow of the length below shows
  double length = 1;   // m
  double size = 1;     // m: the median radius, to which an arrow's width is proportional

  Color color() const;
  string_view name() const;
  string_view unit() const;  // m/s, kg m/s or N
};

/// The arrows that the scene requests. The greatest speed or momentum to expect (color_scale.h), or the greatest
/// force at time 0, is six median radii long.
vector<ArrowScale> arrow_scales(const Scene& scene);

/// Arrows from the surfaces of the bodies, in the direction of the quantity and as long as its scale has it.
void add_arrows(const Moment& moment, const vector<ArrowScale>& scales, vector<Stroke>& strokes);

}  // namespace carom
