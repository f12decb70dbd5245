#pragma once
// The solids that may shade a point, by a grid of the directions across the key light.

#include "raster/ball_packs.h"
#include "raster/radix_sort.h"
#include "raster/shot.h"
#include "std.h"

namespace carom::raster {

/// Where the cells of a face are.
struct LightExtent {
  int side = 1;                            // cells along a face
  Float3 u{}, v{};                         // parallel light: unit, across it
  float u0 = -1, v0 = -1, u1 = 1, v1 = 1;  // m, of all solids; of a lamp's face in tangents
  float per_u = 1, per_v = 1;              // cells per m, or per tangent
};

/// Parallel light has one plane grid, a lamp the six faces of a cube around it.
class LightGrid {
 public:
  /// Sorts the solids into the cells of the key light, the first of at least one lamp. The memory of the last picture
  /// is used again.
  void fill(const Shot& shot);

  bool empty() const { return balls.members.empty() && others.members.empty(); }
  size_t cells() const { return balls.start.size() - 1; }

  LightCells balls, others;
  BallPacks packs;
  LightExtent extent;
  /// The blur of a shadow is at most so many radii of its ball wide. In a crowd it is narrower, so that only so many
  /// balls shade a point as can be counted.
  float widest_blur = 1;
  /// By solid: m along parallel light, minus the squared distance from a lamp, m^2. Of two that shade a point, the
  /// nearer one to it has the smaller number.
  vector<float> towards_light;

 private:
  /// Cells of one face, ends included.
  struct CellRect {
    int16_t face, u0, u1, v0, v1;
  };
  void measure(const Shot& shot);
  double find_blurs(const Shot& shot);
  void find_rects(const Shot& shot);
  void sort_into_cells(const Shot& shot);

  vector<float> blur_;                     // m, the most by solid
  vector<CellRect> rects_;                 // of all solids
  vector<uint32_t> first_rect_;            // by solid, and one more
  vector<uint8_t> is_ball_;                // by solid
  vector<size_t> next_ball_, next_other_;  // by cell
  SortedNumbers order_;                    // by towards_light
};

}  // namespace carom::raster
