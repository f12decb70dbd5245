#pragma once
// The table of pairs: which Minkowski sum two things make, and in which frame.
#include "geometry/round_prism.h"
#include "geometry/slab_sum.h"
#include "geometry/tilted_sum.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

enum class PairKind : uint8_t {
  spheres,        // a ball
  half_space,     // anything and a plane
  sphere_wall,    // a rounded rectangle, with the features of contact_time.h
  prism,          // volumes, and walls along the same axes
  box_wall,       // a wall at an angle: slabs
  cylinder_wall,  // a wall at an angle: slabs and oblique cylinders
  shell,          // a ball inside or outside of a hollow thing
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

/// The point of a volume that lies farthest along n, from its centre (m), or the middle of an area of them.
Vec3 foremost(const Volume& volume, const Vec3& n);

/// The closest points on the surfaces of a and b in the world (m). Body a is a box or a cylinder, b a wall at an angle
/// to it. Where there are several, it is the middle of all.
struct ClosestPoints {
  Vec3 on_a, on_b;
};
ClosestPoints closest_points(const Volume& a, const Vec3& xa, const Wall& wall, const Vec3& xb);

/// Calls visit(sum, frame) with the Minkowski sum of a pair of this kind: of a volume and a wall or another volume.
auto with_sum(PairKind kind, const World& world, Entity a, Entity b, const auto& visit) {
  if (kind == PairKind::box_wall) return visit(SlabSum(world.volume_of(a).half, world.wall(b)), Frame{});
  if (kind == PairKind::cylinder_wall) return visit(TiltedSum(world.volume_of(a), world.wall(b)), Frame{});
  const PairPrism pair = pair_prism(world, a, b);
  return visit(pair.sum, pair.frame);
}

}  // namespace carom
