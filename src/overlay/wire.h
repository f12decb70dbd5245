#pragma once
// Strokes of one width through points, such as a spring or a string.

#include "numerics/vec3.h"
#include "render/drawing.h"
#include "scene/colors.h"
#include "std.h"

namespace carom {

inline constexpr double chord_error = 0.25;  // pixels: how far a stroke may be off its curve
inline const Color wire_steel = from_rgb(0xa7adb5);

/// Appends strokes through points.
class Wire {
 public:
  Wire(double radius, const Vec3& start, const Color& color, vector<Stroke>& strokes)
      : radius_(radius), at_(start), color_(color), strokes_(strokes) {}

  void go_to(const Vec3& point) {
    Stroke stroke;
    stroke.from = at_;
    stroke.to = point;
    stroke.from_radius = stroke.to_radius = radius_;
    stroke.color = color_;
    strokes_.push_back(stroke);
    at_ = point;
  }

 private:
  double radius_;  // m
  Vec3 at_;        // m
  Color color_;
  vector<Stroke>& strokes_;
};

}  // namespace carom
