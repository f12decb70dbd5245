#pragma once
// The fixed things that a picture shows, in the camera's frame, as the shaders read them.
#include <vector>

#include "render/eye.h"
#include "render/gl.h"
#include "scene/scene.h"

namespace carom {

struct Surface {
  bool wall = false;
  Vec3 normal;                             // unit; a plane's towards its free side, a wall's towards the eye
  double height = 0;                       // m, of the eye above it; a plane's may be negative: the eye is behind it
  Vec3 center = Vec3::Zero();              // walls: m
  Vec3 right, up;                          // unit, along the pattern; a wall's along its sides
  double half_width = 0, half_height = 0;  // walls: m
  /// A plane is seen from its free side only, a wall unless edge-on.
  bool seen() const { return height > 0; }
};

/// The name, colour and so on of an obstacle, by its number among them.
const FixedName& name_of_obstacle(const Scene& scene, std::size_t obstacle);
/// Whether an obstacle stands still as six walls: a box that is not drawn as a mesh.
bool is_surface(const Scene& scene, std::size_t obstacle);

/// Planes first, then walls and the sides of box obstacles. Number i is known to the shaders as i + 1; 0 is the
/// background. Planes that are not visible are left out: they are not there for the eye, and cut nothing off the
/// others.
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

  double unit() const { return unit_; }    // m, side of the pattern's squares: a power of ten that suits the picture
  double reach() const { return reach_; }  // m, from the eye to what the picture is about

 private:
  void add_wall(const Wall& wall, const FixedName& name, const Eye& eye);
  void add_row(const Surface& s, double right_offset, double up_offset, const Color& color);
  std::vector<Surface> all_;
  std::size_t planes_ = 0;
  std::vector<float> rows_;
  double unit_ = 1, reach_ = 1;
};

}  // namespace carom
