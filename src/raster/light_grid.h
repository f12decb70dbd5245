#pragma once
// The solids that may shade a point, by a grid of the directions across the key light.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/frame.h"

namespace carom::raster {

/// Parallel light has one plane grid, a lamp the six faces of a cube around it.
class LightGrid {
 public:
  void fill(const Frame& frame);

  bool empty() const { return members_.empty(); }
  std::size_t cells() const { return start_.size() - 1; }
  std::span<const std::uint32_t> cell(std::size_t i) const {
    return {members_.data() + start_[i], start_[i + 1] - start_[i]};
  }
  /// The balls of a cell: members `first` to `end` - 1 of the arrays below, from the farthest to the light to the
  /// nearest.
  std::size_t first(std::size_t i) const { return start_[i]; }
  std::size_t end(std::size_t i) const { return start_[i + 1]; }
  std::span<const std::uint32_t> members() const { return members_; }
  /// By member, and 16 more: centre, radius (not a ball: -1), place towards the light.
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
  struct Rect {
    int face;
    float u0, u1, v0, v1;
  };
  void measure(const Frame& frame);
  void footprint(const Frame& frame, std::size_t i, std::vector<Rect>& rects) const;

  std::vector<float> blur_;  // m, the most by solid
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> members_;
  std::vector<std::size_t> next_;
  std::vector<Rect> rects_;
  std::vector<std::uint32_t> order_;
};

}  // namespace carom::raster
