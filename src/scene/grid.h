#pragma once
// A spatial grid that finds overlaps among a million bodies of any size without testing all pairs.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

/// The depth, in m, to which two things may overlap and still count as touching.
/// It is `relative` of the smaller reach plus 4 units in the last place of the largest coordinate.
/// The second term covers the rounding of decimals.
double touch_tolerance(double relative, double smaller_reach, const Vec3& a, const Vec3& b);

/// The relative tolerance of things placed by rule, as a share of the smaller one's reach.
inline constexpr double tight = 1e-12;

/// A hashed grid of unbounded space, with one level for each octave of diameters.
/// A query searches every level in use.
/// Bodies inserted from the largest to the smallest find their neighbours in 27 cells a level.
class BodyGrid {
 public:
  /// A body or an obstacle. The world of the grid holds the volumes that are not spheres.
  struct Member {
    Vec3 center;    // m
    double radius;  // m, its reach
    Entity entity;
  };
  struct Overlap {
    Entity entity;
    double depth;  // m
  };

  /// Without a world all members are balls that may meet.
  explicit BodyGrid(const World* world = nullptr) : world_(world) {}

  void reserve(size_t members);
  void insert(const Member& member);
  /// A member that overlaps this body beyond the tolerance of touching, if there is one.
  optional<Overlap> find_overlap(const Member& body, double relative = tight) const;
  /// All such members, some of them more than once.
  vector<Overlap> all_overlaps(const Member& body, double relative) const;
  /// Prefetches the memory that find_overlap will read: first the cells, later the members in them.
  enum class Prefetch { cells, members };
  void prefetch(const Member& body, Prefetch what) const;

 private:
  struct Level {
    /// Of the diameters, which lie from 2^(exponent-1) to below 2^exponent.
    int exponent;
    double cell;     // m, the diameter of the first member
    double largest;  // m, the largest diameter
    vector<uint32_t> members;
  };
  struct Cells {
    int64_t low[3], high[3];
    double count = 1;
  };
  Cells cells_about(const Level& level, const Member& body) const;
  template <typename Visit>
  void each_bucket(uint32_t level, const Cells& cells, Visit visit) const;
  size_t bucket(uint32_t level, int64_t x, int64_t y, int64_t z) const;
  size_t bucket(uint32_t level, const Vec3& center) const;
  void link(uint32_t member);
  optional<Overlap> overlap_with(const Member& member, const Member& body, double relative) const;
  optional<Overlap> overlap_in_chain(uint32_t head, const Member& body, double relative) const;
  bool is_ball(Entity entity) const {
    return world_ == nullptr || (world_->volume_of(entity).shape == Shape::sphere && !world_->is_shell(entity));
  }

  const World* world_;
  struct Link {
    Member member;
    /// Next in the chain of its bucket.
    uint32_t next;
  };
  vector<Link> members_;
  vector<uint32_t> level_;  // index into levels_, by member
  vector<uint32_t> heads_;  // by bucket
  vector<Level> levels_;
};

/// The depth, in m, to which a body at `center` overlaps a plane or wall (by number) beyond touching.
/// None: there is no overlap.
optional<double> overlap_depth(const World& world, Entity body, const Vec3& center, Entity surface,
                               double relative = tight);
bool touches_no_surface(const World& world, Entity body, const Vec3& center);

}  // namespace carom
