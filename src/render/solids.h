#pragma once
// Boxes, cylinders and meshes. Their triangles are drawn in tiles at four times the picture's width and height. Each
// point records only the visible thing and its normal. A pixel is then shaded once from its sixteen points, which also
// give its coverage. Pixels that are wholly covered are drawn before the balls, the others after them. The edges of
// both kinds then blend with what is behind them, in any order.
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

  /// Shades the things that are not balls, apart from the picture. Leaves another framebuffer bound.
  void prepare(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows);
  /// Draws them onto the bound framebuffer, either where they cover whole pixels or where they cover a part.
  enum class Cover { whole, part };
  void draw(Cover cover);

 private:
  struct Rect {
    int left, top, right, bottom;  // pixels
  };
  struct Tile {
    Rect bounds;
    Rect used;                          // where things may be visible
    std::vector<std::uint32_t> solids;  // indices in placed_
  };
  struct Placed {
    std::size_t shape;
    double distance;                     // m
    bool cut;                            // whether the near plane may cut it
    std::array<float, Shapes::row> row;  // origin, number; scale, -
    Rect bounds;
  };
  struct Programs {
    Programs(const Lighting& lighting, bool walls, bool meshes, int fine);
    gl::Program closed_points, open_points, shade, draw;
  };
  /// The content of the points of one tile.
  struct Points {
    Points(int width, int height);
    gl::Texture what, depth;  // number and normal; near / z
    gl::Framebuffer buffer;
  };
  /// The content of the picture's pixels.
  struct Pixels {
    Pixels(int width, int height);
    gl::Texture color, depth;  // colour and cover; near / z
    gl::Framebuffer buffer;
  };
  /// Buffers of floats for the shaders.
  struct Rows {
    std::vector<float> occluders, looks, instances, rectangles;
  };
  void set_constants(const Lighting& lighting, const MeshShadows* meshes);
  Placed place(const Things& things, const Thing& thing, std::size_t number) const;
  Rect bounds_of(const Vec3& origin, const Vec3& half, bool& cut) const;
  void collect(const Things& things);
  void draw_points(const Tile& tile);
  void shade(const Tile& tile, const Backdrop& backdrop, const gl::TexelBuffer& rows);

  const Eye& eye_;
  const Lighting& lighting_;
  const Surfaces& surfaces_;
  const MeshShadows* meshes_;  // null: no mesh casts a shadow of its own
  int fine_;                   // points along a pixel's side
  const Shapes& shapes_;
  std::array<Vec3, 3> axes_;  // the world's axes
  Programs programs_;
  Points points_;
  Pixels pixels_;
  gl::TexelBuffer occluders_, looks_;
  gl::Instances rectangles_;
  std::vector<Tile> tiles_;
  std::vector<Placed> placed_;
  Rows rows_;
};

}  // namespace carom
