#pragma once
// A mesh with its colours, and how much of a file may become one.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// A picture on a mesh, sRGB with opacity.
struct MeshTexture {
  uint32_t width = 0, height = 0;  // pixels
  vector<uint8_t> rgba;            // four bytes a pixel, top row first
};

/// How a texture goes on beyond its sides.
enum class Wrap : uint32_t { repeat, clamp, mirror };

/// Triangles of one material. Colours are in linear light. They multiply: factor, texture, the vertices' colours.
struct MeshPart {
  uint32_t triangles = 0;                 // so many, after those of the part before
  uint32_t texture = 0;                   // counted from 1; 0: none
  array<Wrap, 2> wrap{};                  // along u and v
  uint32_t sharp = 0;                     // 1: no interpolation between the pixels of a texture that is near
  uint32_t colored = 0;                   // 0: the file gives no colour
  float cutoff = 0;                       // opacity below which nothing is drawn
  array<float, 4> factor = {1, 1, 1, 1};  // and opacity, 0 to 1
};

/// The colours of a file. It is empty if no part of the file has one.
struct MeshPaint {
  vector<MeshPart> parts;        // all triangles
  vector<array<float, 2>> uv;    // by vertex: place in the texture, from its left upper corner, 1: its size
  vector<array<float, 3>> tint;  // by vertex: colour in linear light, 0 to 1
  vector<MeshTexture> textures;
};

struct Mesh {
  vector<Vec3> vertices;       // in the file's own units and axes, placed by its nodes
  vector<Vec3> normals;        // by vertex, unit; zero: unknown
  vector<uint32_t> triangles;  // three vertices each
  MeshPaint paint = {};
};

struct MeshLimits {
  uint64_t file_bytes = uint64_t{256} << 20U;
  uint64_t memory_bytes = uint64_t{2} << 30U;
  unsigned seconds = 10;  // of processor time; three times as many on the clock
  uint32_t vertices = 2'000'000;
  uint32_t triangles = 2'000'000;
  uint32_t parts = 1000;
  uint64_t texture_pixels = uint64_t{1} << 26U;  // of each as stored
  uint64_t texture_bytes = uint64_t{64} << 20U;  // of all; larger ones are scaled down
};

/// The longest side of a texture in a Mesh, pixels. Larger ones are scaled down.
inline constexpr uint32_t longest_texture_side = 4096;

}  // namespace carom
