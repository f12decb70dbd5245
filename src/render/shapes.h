#pragma once
// The triangles that things are drawn with: a box, a cylinder, and the scene's meshes, each read and uploaded once.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/gl.h"
#include "render/mesh.h"

namespace carom {

/// The cube from -1 to 1, and the upright cylinder of radius 1 and half height 1.
Mesh unit_box();
Mesh unit_cylinder(std::uint32_t sides);

class Shapes {
 public:
  /// Reads the files. Throws RenderError.
  explicit Shapes(const std::vector<std::string>& files);

  static constexpr std::size_t box = 0, small_cylinder = 1, large_cylinder = 2;
  static constexpr std::size_t file(std::size_t i) { return i + 3; }
  /// A cylinder's sides show by a tenth of a pixel from so many pixels of radius on.
  static constexpr double small_up_to = 40;

  /// Vertices stand relative to this point of the file, so that they fit into floats.
  const Vec3& middle(std::size_t shape) const { return shapes_[shape].middle; }
  /// Of the box around the vertices, about the middle.
  const Vec3& half(std::size_t shape) const { return shapes_[shape].half; }
  /// Of the ball about `center` that holds a file's vertices, in the file's units.
  double radius(std::size_t file, const Vec3& center) const;

  /// Rows of `row` floats, which the vertex shader reads as its attributes 2 and 3; 0 and 1 are a vertex's position and
  /// normal.
  void fill_instances(std::span<const float> rows) const;
  void draw(std::size_t shape, std::size_t first, std::size_t count) const;
  static constexpr std::size_t row = 8;

 private:
  struct Uploaded {
    gl::Vertices array;
    gl::Buffer vertices, triangles;
    GLsizei indices = 0;
    Vec3 middle, half;
  };
  void upload(const Mesh& mesh);

  std::vector<Uploaded> shapes_;
  std::vector<std::vector<Vec3>> points_;  // of the files
  gl::Buffer instances_;
};

}  // namespace carom
