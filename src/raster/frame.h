#pragma once
// One picture as plain numbers: camera, light, surfaces and solids in the camera's frame. That is x to the right, y up,
// z ahead, the eye at the origin, lengths in m. A ray through a picture point is (x, y, 1), so that the place on it is
// its z. Colours and light are linear.
#include <array>
#include <cstdint>
#include <vector>

namespace carom::raster {

using Float3 = std::array<float, 3>;

enum class Kind : std::int32_t { ball, wide_ball, box, cylinder, wall, mesh };

/// A shadow whose blur is so many radii of its ball wide is gone.
inline constexpr float faintest = 8;

/// The number of a solid in a picture is its index. Opaque solids are sorted by the picture, not by the caller.
struct Solid {
  Float3 center{};
  float radius = 0;  // m, of the ball, or of a ball around the solid
  Float3 half{};     // m, along the world's axes; walls: half width, half height, 0
  Kind kind = Kind::ball;
  Float3 color{1, 1, 1};
  float glow = 0;                 // 0 to 1: the share of its colour that it sends out
  Float3 right{}, up{}, normal{};  // walls: unit; the normal to the eye's side
  Kind volume = Kind::ball;       // of Kind::mesh: that of its volume, whose shadow it casts without an outline
  std::int32_t mesh = -1;         // of Kind::mesh: the outline of its shadow in Frame::outlines, or -1
  Float3 mesh_middle{};           // m, of that outline
  float mesh_reach = 0;           // m, half of its side
  bool shadow_only = false;       // out of view
  bool matt = false;              // walls: no reflection, a fine pattern
  // Filled by prepare(): outline, bounds, edges.
  Float3 world_center{};           // m, from the eye along the world's axes
  float x = 0, y = 0;              // ball: the outline's centre in the plane z = 1
  float xx = 0, xy = 0, yx = 0, yy = 0;  // ball: to units of the outline's half axes
  float per_a = 0, per_b = 0;      // ball: one over these
  float depth2 = 0;                // ball: square of half the chord through the outline's centre, times |ray|^2
  float opacity = 1;               // ball: of one that is smaller than a pixel
  std::int32_t first_edge = 0, edge_pairs = 0;  // others: of the outline
  float nearest = 0;               // m, least z
};

/// A line in the plane z = 1: x, y to pixels inside of it.
struct Edge {
  float a, b, c;
};

/// A visible plane with its pattern, as in surfaces.h.
struct Ground {
  Float3 normal;   // unit, towards the free side
  float height;    // m, of the eye above it; negative: the eye is behind it
  Float3 right, up;
  float right_offset, up_offset;
  Float3 color;
  bool corners;    // others meet it
};

struct Lamp {
  Float3 vector;   // near: its place, m; otherwise the unit direction towards it
  bool near;
  Float3 radiance;
};

/// The coverage of a mesh's outline along the light, with all coarser levels, each half as wide.
struct OutlineLevels {
  int side = 0;                             // of level 0, a power of two
  std::vector<std::vector<float>> levels;  // rows of side / 2^level values, 0 to 1
};

/// Meshes that were drawn elsewhere: by pixel, at `fine` x `fine` places each.
struct MeshPixels {
  std::vector<float> depth;           // z; 0: nothing there
  std::vector<float> cover;           // share of the pixel
  std::vector<std::int32_t> solid;    // number
  std::vector<Float3> normal, color;  // of the nearest
};

struct Frame {
  int width = 0, height = 0;     // pixels
  float pixel = 0;               // side of a pixel in the plane z = 1
  float left = 0, top = 0;       // x, y of the middle of the pixel in the corner
  float near = 0;                // m
  bool smooth = true;            // anti-aliased edges
  std::array<Float3, 3> axes{};  // the world's axes x, y, z
  float unit = 1, reach = 1;     // m, side of the pattern's squares; to the main content
  bool plain_background = false, no_background = false;
  Float3 background{};
  Float3 ambient{};
  float softness = 0;     // tangent of half the angle of the key light
  float lamp_radius = 0;  // m, of a key light that is near
  bool has_floor = false;
  Float3 floor_normal{}, floor_light{};  // what the floor sends up
  float floor_height = 0;                // m, of the eye above the floor
  Float3 across_u{}, across_v{};         // of OutlineLevels
  std::vector<Lamp> lamps;               // the first one casts shadows
  std::vector<Ground> grounds;
  std::vector<Solid> solids;
  std::vector<Edge> edges;
  std::vector<OutlineLevels> outlines;
  const MeshPixels* meshes = nullptr;
};

}  // namespace carom::raster
