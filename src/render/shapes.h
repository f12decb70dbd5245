#pragma once
// The triangles of the scene's meshes. Each file is read and uploaded once.

#include "render/gl.h"
#include "render/mesh_colors.h"
#include "render/mesh_data.h"
#include "render/things.h"
#include "std.h"

namespace carom {

class Shapes {
 public:
  /// Reads the files. Throws RenderError.
  explicit Shapes(const vector<DrawnFile>& files);

  size_t count() const { return shapes_.size(); }
  /// The point of the file to which vertices are relative, so that they fit into floats.
  const Vec3& middle(size_t file) const { return shapes_[file].middle; }
  /// Half extents of the box around the vertices, about that point.
  const Vec3& half(size_t file) const { return shapes_[file].half; }
  /// Radius of the ball about `center` that contains a file's vertices, in the file's units.
  double radius(size_t file, const Vec3& center) const;

  /// The colours of the file itself, if it is drawn in them and has any.
  const MeshColors* colors(size_t file) const { return shapes_[file].colors ? &*shapes_[file].colors : nullptr; }
  /// The mean of these.
  optional<MeanColor> mean(size_t file) const { return shapes_[file].mean; }

  /// Fills rows of `row` floats, which are attributes 2 and 3 of the vertex shader. Attributes 0 and 1 are a vertex's
  /// position and normal.
  void fill_instances(span<const float> rows) const;
  void draw(size_t file, size_t first, size_t count) const;
  /// Calls `prepare` before each part is drawn.
  void draw_parts(size_t file, size_t first, size_t count, const function<void(const MeshPart& part)>& prepare) const;
  static constexpr size_t row = 8;

 private:
  struct Uploaded {
    gl::Vertices array;
    gl::Buffer vertices, triangles;
    GLsizei indices = 0;
    Vec3 middle, half;
    optional<MeshColors> colors;
    optional<MeanColor> mean;
  };
  void upload(const Mesh& mesh);

  vector<Uploaded> shapes_;
  vector<vector<Vec3>> points_;  // vertices of the files
  gl::Buffer instances_;
};

}  // namespace carom
