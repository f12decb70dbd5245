#pragma once
// The effect of things on the light of planes and walls: soft shadows of the key light, and the darkening where a ball
// is close.
#include <span>
#include <vector>

#include "render/backdrop.h"
#include "render/mesh_shadows.h"
#include "render/occluders.h"

namespace carom {

class Shade {
 public:
  /// `solids`: some things may not be balls.
  Shade(const Eye& eye, const Lighting& lighting, const Surfaces& surfaces, const MeshShadows* meshes, bool solids);

  /// Darkens the bound framebuffer, a copy of the backdrop, where things take light from its surfaces.
  void draw(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows);

 private:
  void add_shadow(const Thing& ball, std::size_t surface);
  void add_closeness(const Thing& ball, std::size_t surface);
  enum class Darkens { by_shadow, by_closeness };
  void add(Darkens darkens, const Thing& ball, std::size_t surface, const Vec3& origin, const Vec3& u, const Vec3& v);
  bool in_picture(const Vec3& center, double radius) const;

  const Eye& eye_;
  const Lighting& lighting_;
  const Surfaces& surfaces_;
  const MeshShadows* meshes_;  // null: no mesh casts a shadow of its own
  bool solids_;
  gl::Program program_;
  gl::Instances instances_;
  std::vector<float> rows_;
};

}  // namespace carom
