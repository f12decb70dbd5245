#pragma once
// Bounding volumes (chapter 8): a sphere, an upright cylinder (its axis along y), a box along the axes.
// Bodies move without turning, so a volume is its shape and its half extents about its centre.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

enum class Shape : uint8_t { sphere, cylinder, box };

struct Volume {
  Shape shape = Shape::sphere;
  Vec3 half = Vec3::Zero();  // m; a sphere: (r, r, r); a cylinder: (r, height / 2, r); a box: half its edges

  static Volume sphere(double radius) { return {Shape::sphere, Vec3::Constant(radius)}; }
  static Volume cylinder(double radius, double height) { return {Shape::cylinder, Vec3(radius, 0.5 * height, radius)}; }
  static Volume box(const Vec3& edges) { return {Shape::box, 0.5 * edges}; }

  void keep(auto& archive) { archive(shape, half); }

  /// Radius of the smallest sphere about the centre that holds the volume (m).
  double reach() const;
  /// m^3
  double size() const;
  /// The extent of the volume from its centre along the unit vector n (m): its support function.
  double support(const Vec3& n) const;
  friend bool operator==(const Volume&, const Volume&) = default;
};

}  // namespace carom
