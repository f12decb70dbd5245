#pragma once
// The things and walls that may be between a thing and the key light. Things count as the balls around them.
#include <cstdint>
#include <span>
#include <vector>

#include "render/lighting.h"
#include "render/surfaces.h"
#include "render/things.h"

namespace carom {

/// Finds the things with a shadow that may fall on a given one, by a grid over the directions across the light.
class Occluders {
 public:
  Occluders(std::span<const Thing> balls, const Lighting& lighting);

  /// Finds the balls that may shade `balls[i]`, nearest first, at most `most` of them.
  void find(std::uint32_t i, std::vector<std::uint32_t>& found);
  static constexpr std::size_t most = 24;

  /// Appends rows for the occluders of things[i] in the format of material.h's shader, four floats for each texel.
  void append_rows(std::uint32_t i, const Things& things, const Surfaces& surfaces, std::vector<float>& rows);

 private:
  struct Rect {
    int face = 0;
    double u0, u1, v0, v1;
  };
  /// The region of a ball across the light: on one plane for parallel light, or on the six faces of a cube around a
  /// lamp.
  void footprint(const Vec3& center, double radius, std::vector<Rect>& rects) const;
  template <typename Visit>
  void cells(const Rect& rect, Visit visit) const;

  bool may_shade(const Surface& wall, const Thing& thing) const;

  std::span<const Thing> balls_;
  bool near_;
  double lamp_;  // m, the lamp's radius
  Vec3 key_, across_u_, across_v_;
  int side_ = 1;  // cells along a face
  double origin_u_ = -1, origin_v_ = -1, per_u_ = 1, per_v_ = 1;
  double extent_ = 0;                           // m, of the balls along parallel light
  std::vector<std::uint32_t> start_, members_;  // by cell
  std::vector<std::uint32_t> seen_;             // by ball: the last query that visited it
  std::uint32_t query_ = 0;
  std::vector<Rect> rects_;
  std::vector<std::uint32_t> found_;
};

}  // namespace carom
