#pragma once
// The shadows of meshes in parallel light. Bodies do not turn, so that a mesh has one outline along the light, drawn
// once. (In a lamp's light, which sees each body from another side, a mesh casts the shadow of its volume.)
#include "render/lighting.h"
#include "render/shapes.h"

namespace carom {

class MeshShadows {
 public:
  /// `files`: how many of the shapes are meshes of files; one or more.
  MeshShadows(const Shapes& shapes, std::size_t files, const Eye& eye, const Lighting& lighting);

  /// For a fragment shader behind Lighting::shader():
  ///   float through_mesh(vec3 p, vec3 l, vec3 to_middle, float file, float reach)
  /// the part of the key light that a mesh lets through to p; `reach`: of what scale * reach() is.
  static const char* shader();
  void set(const gl::Program& program, GLuint unit) const;  // the program must be in use
  void bind(GLuint unit) const;

  /// Half the side of the outline's picture, in the file's units.
  static double reach(const Shapes& shapes, std::size_t file) { return 1.05 * shapes.half(Shapes::file(file)).norm(); }

 private:
  gl::Texture outlines_;  // a layer a file, by ever larger squares
  Vec3 across_u_, across_v_;
};

}  // namespace carom
