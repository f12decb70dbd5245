#pragma once
// What one picture shows besides the State: the camera at that time, colours that change, and lines in space.

#include "numerics/vec3.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// A straight round stroke with ends of two radii, such as a piece of a trail, a spring's wire or an arrow's head.
struct Stroke {
  Vec3 from, to;            // m
  double from_radius = 0;   // m
  double to_radius = 0;     // m
  double least_width = 1;   // pixels; a thinner stroke is drawn this wide
  Color color;              // sRGB
  double from_opacity = 1;  // 0: invisible
  double to_opacity = 1;
  friend bool operator==(const Stroke&, const Stroke&) = default;
};

struct Drawing {
  Camera camera;
  vector<Color> body_colors;  // by body; empty: those of the scene
  vector<float> glow;         // by body, 0 to 1: the share of white light that it sends out; empty: none does
  vector<Stroke> strokes;
  vector<uint32_t> faded;  // walls and obstacles that hide what happens, by number among all fixed things, ascending
  friend bool operator==(const Drawing&, const Drawing&) = default;
};

}  // namespace carom
