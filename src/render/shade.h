#pragma once
// What balls do to the light on planes and walls: soft shadows of the key light, and the darkness where a ball is
// close.
#include <span>
#include <vector>

#include "render/backdrop.h"
#include "render/occluders.h"

namespace carom {

class Shade {
 public:
  Shade(const Eye& eye, const Lighting& lighting, const Surfaces& surfaces);

  /// Darkens the bound framebuffer, a copy of the backdrop, where balls take light away from its surfaces.
  void draw(std::span<const Ball> balls, const Backdrop& backdrop);

 private:
  void add_shadow(const Ball& ball, std::size_t surface);
  void add_closeness(const Ball& ball, std::size_t surface);
  enum class Darkens { by_shadow, by_closeness };
  void add(Darkens darkens, const Ball& ball, std::size_t surface, const Vec3& origin, const Vec3& u, const Vec3& v);
  bool in_picture(const Vec3& center, double radius) const;

  const Eye& eye_;
  const Lighting& lighting_;
  const Surfaces& surfaces_;
  gl::Program program_;
  gl::Instances instances_;
  std::vector<float> rows_;
};

}  // namespace carom
