#pragma once
// All that stands still in front of a camera that stands still: background, planes and walls. Drawn once, with as many
// samples a pixel as its edges need; every picture then starts as a copy.
#include "render/gl.h"
#include "render/lighting.h"
#include "render/surfaces.h"

namespace carom {

struct Backdrop {
  /// `smooth`: edges are anti-aliased.
  Backdrop(const Scene& scene, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces,
           const gl::TexelBuffer& rows, bool smooth);

  gl::Texture lit;     // sRGB: without any ball's shadow
  gl::Texture shaded;  // sRGB: as if no key light came
  gl::Texture number;  // which surface, + 1; 0: background
  gl::Texture depth;   // near / z; 0: infinitely far. At a wall's edge: of what is behind it
  gl::Texture edge;    // only with walls. At a wall's edge: near / z of the wall, and how much of the pixel it covers
};

/// The depth as stored: near / z, so that float's precision is spent where it is needed.
inline constexpr const char* picture_vertex_shader = R"(
void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1, 0, 1);
}
)";

}  // namespace carom
