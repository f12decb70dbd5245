#pragma once
// Which balls and walls may stand between a ball and the key light.
#include <cstdint>
#include <span>
#include <vector>

#include "render/lighting.h"
#include "render/surfaces.h"

namespace carom {

/// A ball in the camera's frame.
struct Ball {
  Vec3 center;    // m
  double radius;  // m
};

/// Finds, by a grid over the directions across the light, the balls whose shadow may fall on a given ball.
class Occluders {
 public:
  Occluders(std::span<const Ball> balls, const Lighting& lighting);

  /// Appends the balls that may shade `balls[i]`, nearest first, at most `most` of them.
  void find(std::uint32_t i, std::vector<std::uint32_t>& found);
  static constexpr std::size_t most = 24;

 private:
  struct Rect {
    int face = 0;
    double u0, u1, v0, v1;
  };
  /// Where a ball is, as the light sees it: on one sheet across parallel light, or on the six faces of a cube around a
  /// lamp.
  void footprint(const Vec3& center, double radius, std::vector<Rect>& rects) const;
  template <typename Visit>
  void cells(const Rect& rect, Visit visit) const;

  std::span<const Ball> balls_;
  bool near_;
  double lamp_;  // m, the lamp's radius
  Vec3 key_, across_u_, across_v_;
  int side_ = 1;  // cells along a face
  double origin_u_ = -1, origin_v_ = -1, per_u_ = 1, per_v_ = 1;
  double extent_ = 0;                           // m, of the balls along parallel light
  std::vector<std::uint32_t> start_, members_;  // by cell
  std::vector<std::uint32_t> seen_;             // by ball: the last query that met it
  std::uint32_t query_ = 0;
  std::vector<Rect> rects_;
};

}  // namespace carom
