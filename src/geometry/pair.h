#pragma once
// The table of pairs: which Minkowski sum two things make, and in which frame.
#include "geometry/round_prism.h"
#include "geometry/slab_sum.h"
#include "geometry/tilted_sum.h"
#include "geometry/touch.h"
#include "std.h"

namespace carom {

enum class PairKind : uint8_t {
  spheres,        // a ball
  half_space,     // anything and a plane
  sphere_wall,    // a rounded rectangle, with the features of contact_time.h
  prism,          // volumes, and walls along the same axes
  box_wall,       // a wall at an angle: slabs
  cylinder_wall,  // a wall at an angle: slabs and oblique cylinders
  string          // the inside of a sphere about the other end
};

PairKind pair_kind(const World& world, Entity a, Entity b);

/// Orthonormal axes. y is the world's, except for a sphere and a wall.
struct Frame {
  Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  bool turned = false;
  Vec3 to(const Vec3& v) const { return turned ? Vec3(v.dot(x), v.dot(y), v.dot(z)) : v; }
  Vec3 from(const Vec3& v) const { return turned ? Vec3(v.x() * x + v.y() * y + v.z() * z) : v; }
};

/// The prism of a pair: two volumes, a volume and a wall in line with it, or a sphere and a wall.
/// The last has the wall's frame: along right, up and normal.
struct PairPrism {
  RoundPrism sum;
  Frame frame;
  Volume a, b;  // half extents in the frame; a wall is a box without thickness
};
PairPrism pair_prism(const World& world, Entity a, Entity b);

/// Features of a sphere and a wall, as those of the prism. `p`: x_b - x_a in the wall's frame.
uint8_t prism_feature(uint8_t wall_feature, const Vec3& p);
uint8_t wall_feature(uint8_t prism_feature);

/// The closest points on the surfaces of a and b in the world (m). Body a is a box or a cylinder, b a wall at an angle
/// to it. Where there are several, it is the middle of all.
struct ClosestPoints {
  Vec3 on_a, on_b;
};
ClosestPoints closest_points(const Volume& a, const Vec3& xa, const Wall& wall, const Vec3& xb);

inline SlabSum slab_sum(const World& world, Entity a, Entity b) {
  return SlabSum(world.volume_of(a).half, world.wall(b));
}
inline TiltedSum tilted_sum(const World& world, Entity a, Entity b) {
  const Volume v = world.volume_of(a);
  return TiltedSum(v.half.x(), v.half.y(), world.wall(b));
}

}  // namespace carom
