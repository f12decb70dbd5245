#pragma once
// Which balls lie where, for finding overlaps among a million balls of any radii without looking at all pairs.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics/world.h"

namespace carom {

/// How deep two things may overlap and still count as touching, m: 1e-12 of the sum of radii (of the radius, at a fixed
/// surface) plus 4 units in the last place of the largest coordinate, which is what rounding decimals can do.
double touch_tolerance(double radius_sum, const Vec3& a, const Vec3& b);

/// A hashed grid of unbounded space, one level for each power of two of the diameter. A ball is looked for on every
/// level that is in use; balls put in from the largest to the smallest find their neighbours in 27 cells a level.
class BallGrid {
 public:
  struct Ball {
    Vec3 center;    // m
    double radius;  // m
    Entity entity;
  };
  struct Overlap {
    Entity entity;
    double depth;  // m
  };

  void reserve(std::size_t balls);
  void insert(const Ball& ball);
  /// A ball that overlaps this one by more than touching, if there is any.
  std::optional<Overlap> find_overlap(const Vec3& center, double radius) const;

 private:
  struct Level {
    int exponent;
    double cell;  // m, 2^exponent >= the diameters on this level
    std::vector<std::uint32_t> balls;
  };
  std::size_t bucket(int exponent, std::int64_t x, std::int64_t y, std::int64_t z) const;
  void link(std::uint32_t ball);
  std::optional<Overlap> overlap_with(std::uint32_t ball, const Vec3& center, double radius) const;

  std::vector<Ball> balls_;
  std::vector<std::int32_t> exponents_;  // by ball
  std::vector<std::uint32_t> next_;      // by ball, the chain of its bucket
  std::vector<std::uint32_t> heads_;     // by bucket
  std::vector<Level> levels_;
};

/// How deep a ball overlaps a fixed surface beyond touching, m; none: it does not.
std::optional<double> overlap_depth(const Vec3& center, double radius, const Plane& plane);
std::optional<double> overlap_depth(const Vec3& center, double radius, const Wall& wall);
bool touches_nothing_fixed(const World& world, const Vec3& center, double radius);

}  // namespace carom
