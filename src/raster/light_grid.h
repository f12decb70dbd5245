#pragma once
// The solids that may shade a point, by a grid of the directions across the key light.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/frame.h"

namespace carom::raster {

/// Solids by cell.
struct Cells {
  std::vector<std::size_t> start;
  std::vector<std::uint32_t> members;
  std::size_t first(std::size_t cell) const { return start[cell]; }
  std::size_t end(std::size_t cell) const { return start[cell + 1]; }
  std::span<const std::uint32_t> of(std::size_t cell) const {
    return {members.data() + start[cell], start[cell + 1] - start[cell]};
  }
};

/// Parallel light has one plane grid, a lamp the six faces of a cube around it.
class LightGrid {
 public:
  void fill(const Frame& frame);

  bool empty() const { return balls.members.empty() && others.members.empty(); }
  std::size_t cells() const { return balls.start.size() - 1; }

  // In each cell from the farthest to the light to the nearest.
  Cells balls, others;
  /// By member of `balls`, and 16 more: centre, radius, place towards the light.
  std::vector<float> x, y, z, radius, place;

  int side = 1;                             // cells along a face
  Float3 u{}, v{};                          // parallel light: unit, across it
  float u0 = -1, v0 = -1, u1 = 1, v1 = 1;   // m, of all solids; of a lamp's face in tangents
  float per_u = 1, per_v = 1;               // cells per m
  /// The blur of a shadow is at most so many radii of its ball wide. In a crowd it is narrower, so that only so many
  /// balls shade a point as can be counted.
  float widest_blur = 1;
  /// By solid: of two that shade a point, the nearer one has the smaller number.
  std::vector<float> towards_light;

 private:
  /// Cells of one face, ends included.
  struct Rect {
    std::int16_t face, u0, u1, v0, v1;
  };
  void measure(const Frame& frame);
  void find_rects(const Frame& frame);
  void sort();

  std::vector<float> blur_;                // m, the most by solid
  std::vector<Rect> rects_;                // of all solids
  std::vector<std::uint32_t> first_rect_;  // by solid, and one more
  std::vector<std::size_t> next_;
  std::vector<std::uint32_t> keys_, order_, spare_;
};

}  // namespace carom::raster
