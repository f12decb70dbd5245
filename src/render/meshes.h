#pragma once
// The meshes of a picture, drawn as triangles by OSMesa: places, normals and colours by pixel, and outlines along the
// key light for their shadows. Bodies do not turn, so a mesh has one outline for all of them. In the light of a lamp
// the direction differs from body to body. A mesh then casts the shadow of its volume.

#include "raster/shot.h"
#include "render/gl.h"
#include "render/shapes.h"
#include "render/things.h"
#include "std.h"

namespace carom {

class Meshes {
 public:
  /// Reads the files. `smooth`: pixels are sampled at 4 x 4 places. Throws RenderError.
  Meshes(const vector<DrawnFile>& files, Size size, bool smooth);
  ~Meshes();
  Meshes(const Meshes&) = delete;
  Meshes& operator=(const Meshes&) = delete;

  /// Of a file as `use` draws it.
  MeshSize size_of(const MeshUse& use, size_t file) const;

  /// Draws meshes for the shot, which then points to the result. It is valid until the next draw. Throws RenderError.
  void draw(const vector<PlacedMesh>& meshes, const Eye& eye, raster::Shot& shot);

 private:
  struct Rect {
    int left, top, right, bottom;  // pixels, ends excluded
  };
  /// Rows of the instances that show one file.
  struct FileRows {
    size_t file, first, count;
  };
  /// What draws meshes in colours of their own. A run without them does not need it.
  struct Colored {
    gl::Program program, holes_program, outline_program;
    gl::Texture color;
    gl::Framebuffer buffer;
    vector<uint32_t> read;
    bool used = false;  // in the last tile
  };
  static constexpr int tile_side = 256;  // pixels

  void draw_outlines(raster::Shot& shot);
  void draw_outline(size_t file) const;
  void draw_tile(const Rect& tile, const vector<PlacedMesh>& meshes, const vector<Rect>& bounds);
  /// Draws the files in colours of their own, of `rows` by file.
  void draw_colored(const vector<FileRows>& rows, const array<float, 4>& to_tile);
  void resolve(const Rect& tile, const raster::Shot& shot);

  Size size_;
  int fine_;  // places across a pixel
  gl::Context context_;
  Shapes shapes_;
  gl::Program program_, outline_program_;
  gl::Texture what_, depth_;
  gl::Framebuffer buffer_;
  optional<Colored> colored_;
  raster::MeshPixels pixels_;
  raster::MeshOutlines outlines_;
  array<raster::Float3, 4> outlined_{};  // key light and axes of these outlines
  vector<uint32_t> what_read_;
  vector<float> depth_read_;
  Rect used_{};
};

}  // namespace carom
