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

  int side = 1;                             // cells along a face
  Float3 u{}, v{};                          // parallel light: unit, across it
  float u0 = -1, v0 = -1, u1 = 1, v1 = 1;   // m, of all solids; of a lamp's face in tangents
  float per_u = 1, per_v = 1;               // cells per m
  /// A shadow whose blur is so many radii of its ball wide is gone. It is smaller in a crowd: there far balls take light
  /// evenly, and a point would have too many of them.
  float faint = 1;

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
};

}  // namespace carom::raster
