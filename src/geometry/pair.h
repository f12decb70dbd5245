#pragma once
// The table of pairs: which Minkowski sum two things make, and the frame in which it stands.
#include "geometry/round_prism.h"
#include "geometry/slab_sum.h"
#include "geometry/tilted_sum.h"
#include "geometry/touch.h"

namespace carom {

enum class PairKind : std::uint8_t {
  spheres,        // a ball
  half_space,     // anything and a plane
  sphere_wall,    // a rounded rectangle: contact_time.h, and its features
  prism,          // volumes, and walls that lie to the axes as these do
  box_wall,       // a wall at an angle: slabs
  cylinder_wall,  // a wall at an angle: slabs and oblique cylinders
};

PairKind pair_kind(const World& world, Entity a, Entity b);

/// Orthonormal axes; y is the world's except for a sphere and a wall.
struct Frame {
  Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  bool turned = false;
  Vec3 to(const Vec3& v) const { return turned ? Vec3(v.dot(x), v.dot(y), v.dot(z)) : v; }
  Vec3 from(const Vec3& v) const { return turned ? Vec3(v.x() * x + v.y() * y + v.z() * z) : v; }
};

/// The pair's prism: of two volumes, or of a volume and a wall in line with it, or (in the wall's frame: along right,
/// up, normal) of a sphere and a wall.
struct PairPrism {
  RoundPrism sum;
  Frame frame;
  Volume a, b;  // half extents in the frame; a wall is a box without thickness
};
PairPrism pair_prism(const World& world, Entity a, Entity b);

/// Features of a sphere and a wall, as the prism's. `p`: x_b - x_a in the wall's frame.
std::uint8_t prism_feature(std::uint8_t wall_feature, const Vec3& p);
std::uint8_t wall_feature(std::uint8_t prism_feature);

/// The points of a's and b's surface where the two are nearest, for walls at an angle to a box or a cylinder a; the
/// middle of all where there are several. Both in the world (m).
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
