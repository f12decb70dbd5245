#pragma once
// Balls. Each is one quadrilateral around its outline, in which the ray of every pixel is intersected with the sphere.
#include <vector>

#include "render/backdrop.h"
#include "render/mesh_shadows.h"
#include "render/occluders.h"
#include "render/things.h"

namespace carom {

class Spheres {
 public:
  /// `solids`: some things may not be balls, and cast shadows too. `smooth`: outlines are anti-aliased.
  Spheres(const Eye& eye, const Lighting& lighting, const Surfaces& surfaces, const MeshShadows* meshes, bool solids,
          bool smooth);

  /// Draws the balls among the things onto the bound framebuffer.
  void draw(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows);

 private:
  const Eye& eye_;
  const Lighting& lighting_;
  const Surfaces& surfaces_;
  const MeshShadows* meshes_;  // null: no mesh casts a shadow of its own
  bool smooth_;
  gl::Program program_;
  gl::Instances instances_;
  gl::TexelBuffer occluders_;
  std::vector<float> row_, occluder_row_;
};

}  // namespace carom
