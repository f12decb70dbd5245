#pragma once
// One picture as plain numbers: camera, light, surfaces and solids in the camera's frame. That is x to the right, y up,
// z ahead, the eye at the origin, lengths in m. A ray through a picture point is (x, y, 1), so that the place on it is
// its z. Colours and light are linear.

#include "raster/float3.h"
#include "std.h"

namespace carom::raster {

enum class SolidKind : int32_t { ball, box, cylinder, wall, mesh };

/// A shadow whose blur is so many radii of its ball wide is gone.
inline constexpr float faintest = 8;

/// A blur may be as wide as the part of the edge that a pixel shows, up to so many radii.
inline constexpr float narrowest = 0.25F;

inline constexpr float far_off = 1e30F;

/// The number of a solid in a picture is its index. Opaque solids are sorted by the picture, not by the caller.
struct Solid {
  Float3 center{};
  float radius = 0;  // m, of the ball, or of a ball around the solid
  Float3 half{};     // m, along the world's axes; walls: along their own
  SolidKind kind = SolidKind::ball;
  Float3 color{1, 1, 1};
  float glow = 0;            // 0 to 1: the share of its light that is its own, which is white
  uint32_t part = 0;         // walls, meshes: index into Shot::walls, Shot::meshes
  uint32_t finish = 0;       // index into Shot::finishes
  bool shadow_only = false;  // out of view
  bool shell = false;        // of a hollow thing: it takes no light from others
  // A hollow ball, or a cylinder without ends: its far side alone is seen, from within.
  bool hollow = false;
  float low = -far_off, high = far_off;  // m: heights above its centre between which a hollow solid extends
};

/// How a surface reflects light. Shares are of 1.
struct SurfaceLight {
  float matt = 1;                                  // of the light that it scatters
  float least_mirror = 0.04F, most_mirror = 0.5F;  // of an image, seen from the front and at grazing angles
  float glint = 0.35F;                             // of the lamps
  float tint = 0;                                  // by which image and glint have its colour
  float emission = 0;                              // light of its own colour
  float opacity = 1;                               // 0: what is behind it is seen, but for its mirror image
  friend bool operator==(const SurfaceLight&, const SurfaceLight&) = default;
};

/// What a mesh casts its shadow by.
struct MeshShadow {
  SolidKind volume = SolidKind::ball;  // whose shadow it casts without an outline
  int32_t outline = -1;                // in MeshOutlines::of_files; -1: none
  Float3 middle{};                     // m, of that outline
  float reach = 0;                     // m, half of its side
};

/// A visible plane with its pattern.
struct Ground {
  Float3 normal;                  // unit, towards the free side
  float height;                   // m, of the eye above it; negative: the eye is behind it
  Float3 right, up;               // unit, along it
  float right_offset, up_offset;  // m, of the eye in the pattern
  Float3 color;
  bool corners;       // others meet it
  float opacity = 1;  // over the backdrop
  // What it mirrors, as a picture of these pixels with their opacity (sRGB); null: nothing.
  const uint8_t* image = nullptr;
  float matt = 1, least_mirror = 0, most_mirror = 0, tint = 0, emission = 0;  // as of a solid
};

struct Lamp {
  Float3 vector;  // near: its place, m; otherwise the unit direction towards it
  bool near;
  Float3 radiance;
};

/// The coverage of a mesh's outline along the light, with all coarser levels, each half as wide.
struct OutlineLevels {
  int side = 0;                  // of level 0, a power of two
  vector<vector<float>> levels;  // rows of side / 2^level values, 0 to 1
};

struct MeshOutlines {
  Across across{};  // along rows and columns
  vector<OutlineLevels> of_files;
};

/// Meshes that were drawn elsewhere: by pixel.
struct MeshPixels {
  vector<float> depth;           // z; 0: nothing there
  vector<float> cover;           // share of the pixel
  vector<int32_t> solid;         // number
  vector<Float3> normal, color;  // of the nearest
};

/// The picture before the eye.
struct Lens {
  int width = 0, height = 0;  // pixels
  float pixel = 0;            // side of a pixel in the plane z = 1
  float left = 0, top = 0;    // x, y of the middle of the pixel in the corner
  float near = 0;             // m; what is nearer is cut off
  bool smooth = true;         // anti-aliased edges
  array<Float3, 3> axes{};    // the world's axes x, y, z
};

/// What rays show that meet nothing.
struct Backdrop {
  bool plain = false;  // of one colour; otherwise a sky
  bool none = false;   // transparent
  Float3 color{};
  Float3 above{}, horizon{}, below{};  // of the sky
};

struct Lighting {
  vector<Lamp> lamps;  // the first one, the key light, casts shadows
  Float3 ambient{};
  float softness = 0;     // tangent of half the angle of the key light
  float lamp_radius = 0;  // m, of a key light that is near
  float rim = 0;          // light from behind at the edges of solids
  float flat = 0;         // part of a colour that is shown without regard to light
};

/// Lines along the outlines and edges of solids.
struct Outlines {
  float width = 0;  // pixels; 0: none
  Float3 ink{};
};

/// The ground that lights bodies from below.
struct FloorLight {
  bool present = false;
  Float3 normal{};
  float height = 0;  // m, of the eye above it
  Float3 color{};
  Float3 sky{}, key{};  // what it sends up, of the sky and of the key light
};

/// Light that the lens scatters around a thing that glows.
struct Halo {
  float x, y, radius;  // pixels, of its outline
  float depth;         // 1 / z of its nearest point, 1 / m
  Float3 color;
};

enum class PatternKind : int32_t { none, squares, lines };

struct Pattern {
  float unit = 1;   // m, side of the squares
  float reach = 1;  // m, from the eye to the main content; grounds melt into the sky many times as far away
  PatternKind kind = PatternKind::squares;
  float contrast = 0.1F;
  Float3 ink{};          // of lines
  float spot = 0;        // part of its light that a ground loses far away
  Float3 middle{};       // m, from where the light falls off
  float spot_reach = 1;  // m, where half of that is lost
};

struct Shot {
  Lens lens;
  Backdrop backdrop;
  Lighting lighting;
  FloorLight floor;
  Pattern pattern;
  Outlines edges;
  vector<Ground> grounds;
  vector<SurfaceLight> finishes = vector<SurfaceLight>(1);
  vector<Halo> halos;
  vector<Solid> solids;
  vector<array<Float3, 3>> walls;  // unit axes: right, up, normal
  vector<MeshShadow> meshes;
  const MeshOutlines* outlines = nullptr;  // where a MeshShadow has one
  const MeshPixels* mesh_pixels = nullptr;
};

/// The unit axes along which a solid extends by its `half`.
inline const array<Float3, 3>& axes_of(const Shot& shot, const Solid& solid) {
  return solid.kind == SolidKind::wall ? shot.walls[solid.part] : shot.lens.axes;
}

}  // namespace carom::raster
