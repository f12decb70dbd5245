#pragma once
// The shadows of meshes in parallel light. Bodies do not turn, so a mesh has one outline along the light, which is
// drawn once. In the light of a lamp the direction differs from body to body. A mesh then casts the shadow of its
// volume.
#include "render/lighting.h"
#include "render/shapes.h"

namespace carom {

class MeshShadows {
 public:
  /// `files`: number of the shapes that are meshes of files, one or more.
  MeshShadows(const Shapes& shapes, std::size_t files, const Eye& eye, const Lighting& lighting);

  /// For a fragment shader behind Lighting::shader():
  ///   float through_mesh(vec3 p, vec3 l, vec3 to_middle, float file, float reach).
  /// The part of the key light that a mesh lets through to p. `reach`: scale * reach().
  static const char* shader();
  void set(const gl::Program& program, GLuint unit) const;  // the program must be in use
  void bind(GLuint unit) const;

  /// Half the side of the outline's picture, in the file's units.
  static double reach(const Shapes& shapes, std::size_t file) { return 1.05 * shapes.half(Shapes::file(file)).norm(); }

 private:
  gl::Texture outlines_;  // a layer for each file, with mipmaps
  Vec3 across_u_, across_v_;
};

}  // namespace carom
