#pragma once
// Boxes, cylinders and meshes. Their triangles are drawn in tiles at four times the picture's width and height, no
// more than which thing a point shows and its normal; of these sixteen points every pixel is then shaded once, and
// knows how much of it is covered. Pixels that are wholly covered are drawn before the balls, the others after them: so
// both kinds' edges blend with what is behind them, whatever the order.
#include <array>
#include <cstdint>
#include <vector>

#include "render/backdrop.h"
#include "render/mesh_shadows.h"
#include "render/occluders.h"
#include "render/shapes.h"
#include "render/things.h"

namespace carom {

class Solids {
 public:
  Solids(const Shapes& shapes, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces,
         const MeshShadows* meshes, bool smooth);

  /// Shades the things that are no balls, aside from the picture. Leaves another framebuffer bound.
  void prepare(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows);
  /// Draws them onto the bound framebuffer, where they cover the whole of a pixel or a part of it.
  enum class Cover { whole, part };
  void draw(Cover cover);

 private:
  struct Rect {
    int left, top, right, bottom;  // pixels
  };
  struct Tile {
    Rect bounds;
    Rect used;                          // where something may show
    std::vector<std::uint32_t> solids;  // of placed_
  };
  struct Placed {
    std::size_t shape;
    double distance;                     // m
    bool cut;                            // may be, by the near plane
    std::array<float, Shapes::row> row;  // origin, number; scale, -
    Rect bounds;
  };
  Placed place(const Things& things, const Thing& thing, std::size_t number) const;
  Rect bounds_of(const Vec3& origin, const Vec3& half, bool& cut) const;
  void collect(const Things& things);
  void draw_points(const Tile& tile);
  void shade(const Tile& tile, const Backdrop& backdrop, const gl::TexelBuffer& rows);

  const Eye& eye_;
  const Lighting& lighting_;
  const Surfaces& surfaces_;
  const MeshShadows* meshes_;  // null: none casts a shadow of its own
  int fine_;                   // points along a pixel's side
  const Shapes& shapes_;
  std::array<Vec3, 3> axes_;  // the world's
  gl::Program closed_points_, open_points_, shade_, draw_;
  gl::Texture what_, what_depth_;    // of a tile, by points: number and normal; near / z
  gl::Texture color_, color_depth_;  // of the picture, by pixels: colour and cover; near / z
  gl::Framebuffer point_buffer_, color_buffer_;
  gl::TexelBuffer occluders_, looks_;
  gl::Instances rectangles_;
  std::vector<Tile> tiles_;
  std::vector<Placed> placed_;
  std::vector<float> occluder_row_, look_row_, instance_row_, rectangle_row_;
};

}  // namespace carom
