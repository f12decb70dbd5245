#pragma once
// Everything that stands still in front of a still camera: background, planes and walls.
// It is drawn once, with as many samples a pixel as its edges need. Every picture starts as a copy of it.
#include "render/gl.h"
#include "render/lighting.h"
#include "render/surfaces.h"

namespace carom {

struct Backdrop {
  /// `smooth`: edges are anti-aliased.
  Backdrop(const Scene& scene, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces,
           const gl::TexelBuffer& rows, bool smooth);

  // sRGB without the shadow of any ball. alpha: the mix that shade.cpp separates.
  gl::Texture lit;
  // near / z; 0: infinitely far. At a wall's edge it is that of the surface behind.
  gl::Texture depth;
  // Only with walls. At a wall's edge: sRGB, its colour and the part of the pixel that it covers.
  gl::Texture edge;
  // Only with walls. At a wall's edge: near / z of the wall; elsewhere 0.
  gl::Texture edge_depth;
};

/// A vertex shader that covers the picture. Depth is stored as near / z, which uses the precision of float well.
inline constexpr const char* picture_vertex_shader = R"(
void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1, 0, 1);
}
)";

}  // namespace carom
