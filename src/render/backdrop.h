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

  gl::Texture lit;         // sRGB: without any ball's shadow; alpha: the mix that shade.cpp takes apart
  gl::Texture depth;       // near / z; 0: infinitely far. At a wall's edge: of what is behind it
  gl::Texture edge;        // only with walls. At a wall's edge: sRGB, its colour and how much of the pixel it covers
  gl::Texture edge_depth;  // only with walls. At a wall's edge: near / z of the wall; else 0
};

/// The depth as stored: near / z, so that float's precision is spent where it is needed.
inline constexpr const char* picture_vertex_shader = R"(
void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1, 0, 1);
}
)";

}  // namespace carom
