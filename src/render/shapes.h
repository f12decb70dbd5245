#pragma once
// The triangles of the scene's meshes. Each file is read and uploaded once.
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/gl.h"
#include "render/mesh.h"
#include "render/mesh_colors.h"
#include "render/things.h"

namespace carom {

class Shapes {
 public:
  /// Reads the files. Throws RenderError.
  explicit Shapes(const std::vector<DrawnFile>& files);

  std::size_t count() const { return shapes_.size(); }
  /// The point of the file to which vertices are relative, so that they fit into floats.
  const Vec3& middle(std::size_t file) const { return shapes_[file].middle; }
  /// Half extents of the box around the vertices, about that point.
  const Vec3& half(std::size_t file) const { return shapes_[file].half; }
  /// Radius of the ball about `center` that contains a file's vertices, in the file's units.
  double radius(std::size_t file, const Vec3& center) const;

  /// The colours of the file itself, if it is drawn in them and has any.
  const MeshColors* colors(std::size_t file) const { return shapes_[file].colors ? &*shapes_[file].colors : nullptr; }
  /// The mean of these.
  std::optional<MeanColor> mean(std::size_t file) const { return shapes_[file].mean; }

  /// Fills rows of `row` floats, which are attributes 2 and 3 of the vertex shader. Attributes 0 and 1 are a vertex's
  /// position and normal.
  void fill_instances(std::span<const float> rows) const;
  void draw(std::size_t file, std::size_t first, std::size_t count) const;
  /// Calls `prepare` before each part is drawn.
  void draw_parts(std::size_t file, std::size_t first, std::size_t count,
                  const std::function<void(const MeshPart& part)>& prepare) const;
  static constexpr std::size_t row = 8;

 private:
  struct Uploaded {
    gl::Vertices array;
    gl::Buffer vertices, triangles;
    GLsizei indices = 0;
    Vec3 middle, half;
    std::optional<MeshColors> colors;
    std::optional<MeanColor> mean;
  };
  void upload(const Mesh& mesh);

  std::vector<Uploaded> shapes_;
  std::vector<std::vector<Vec3>> points_;  // vertices of the files
  gl::Buffer instances_;
};

}  // namespace carom
