#pragma once
// The visible fixed surfaces in the camera's frame, in the format of the shaders.
#include <vector>

#include "render/eye.h"
#include "render/gl.h"
#include "scene/scene.h"

namespace carom {

struct Surface {
  bool wall = false;
  Vec3 normal;  // unit; of a plane towards its free side, of a wall towards the eye
  // m, of the eye above it. For a plane it may be negative: the eye is behind it.
  double height = 0;
  Vec3 center = Vec3::Zero();              // walls: m
  Vec3 right, up;                          // unit, along the pattern; of a wall along its sides
  double half_width = 0, half_height = 0;  // walls: m
  /// A plane is visible from its free side only, a wall unless edge-on.
  bool seen() const { return height > 0; }
};

/// Name, colour and other properties of an obstacle, by its number among obstacles.
const FixedName& name_of_obstacle(const Scene& scene, std::size_t obstacle);
/// Whether an obstacle is drawn as six walls: a box that is not drawn as a mesh.
bool is_surface(const Scene& scene, std::size_t obstacle);

/// Planes come first, then walls and the sides of box obstacles. Shaders use number i + 1 for surface i, and 0 for the
/// background. Planes that are not visible are left out. They cut nothing off the others.
class Surfaces {
 public:
  Surfaces(const Scene& scene, const Eye& eye);
  const std::vector<Surface>& all() const { return all_; }
  std::size_t planes() const { return planes_; }
  std::size_t walls() const { return all_.size() - planes_; }

  /// Rows for a gl::TexelBuffer, `texels` each: normal, height; right, its offset; up, its offset; linear colour, -;
  /// half width, half height, -, -. A point p has the pattern coordinates (right.p + offset, up.p + offset).
  const std::vector<float>& rows() const { return rows_; }
  static constexpr int texels = 5;

  // m, side of the pattern's squares: a power of ten that suits the picture.
  double unit() const { return unit_; }
  double reach() const { return reach_; }  // m, from the eye to the main content of the picture

 private:
  void add_wall(const Wall& wall, const FixedName& name, const Eye& eye);
  void add_row(const Surface& s, double right_offset, double up_offset, const Color& color);
  std::vector<Surface> all_;
  std::size_t planes_ = 0;
  std::vector<float> rows_;
  double unit_ = 1, reach_ = 1;
};

}  // namespace carom
