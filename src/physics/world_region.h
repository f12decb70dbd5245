#pragma once
// A region of space that the centres of bodies enter and leave. It is fixed, and it touches nothing.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/volume.h"
#include "std.h"

namespace carom {

struct WorldRegion {
  Vec3 position = Vec3::Zero();  // m, the centre of the volume, or a point of the plane
  Volume volume{};
  Vec3 normal = Vec3::Zero();  // unit: the region is the side of a plane to which it points; zero: a volume
  vector<Entity> on{};         // ascending; empty: all bodies
  bool removes = false;        // a body that enters leaves the world
  bool stops = false;          // a body that enters ends the run

  bool is_side() const { return !normal.isZero(0); }
};

/// Whether a point is inside, m.
bool holds(const WorldRegion& region, const Vec3& x);

/// A body's centre enters or leaves a region, or a body appears in the world.
struct RegionCrossing {
  static constexpr uint32_t world = ~uint32_t{0};  // as a region: the body appears

  double time = 0;  // s
  uint32_t region = 0;
  Entity body = no_entity;
  bool enters = true;
  void keep(auto& archive) { archive(time, region, body, enters); }

  friend bool operator==(const RegionCrossing&, const RegionCrossing&) = default;
};

}  // namespace carom
