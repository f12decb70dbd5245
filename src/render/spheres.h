#pragma once
// Balls: each one quadrilateral around its outline, in which every pixel's ray meets the sphere exactly.
#include <cstdint>
#include <span>
#include <vector>

#include "render/backdrop.h"
#include "render/occluders.h"

namespace carom {

class Spheres {
 public:
  /// `smooth`: outlines are anti-aliased.
  Spheres(const Scene& scene, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces, bool smooth);

  /// Draws `balls[i]` for i in `seen` (back to front) onto the bound framebuffer.
  void draw(std::span<const Ball> balls, std::span<const std::uint32_t> seen, const Backdrop& backdrop,
            const gl::TexelBuffer& rows);

 private:
  const Eye& eye_;
  const Lighting& lighting_;
  const Surfaces& surfaces_;
  bool smooth_;
  std::vector<float> colors_;  // linear, 3 a ball
  gl::Program program_;
  gl::Instances instances_;
  gl::TexelBuffer occluders_;
  std::vector<float> row_, occluder_row_;
  std::vector<std::uint32_t> found_;
};

}  // namespace carom
