#pragma once
// Which bodies lie where, for finding overlaps among a million of any size without looking at all pairs.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/world.h"

namespace carom {

/// How deep two things may overlap and still count as touching, m: `relative` of the smaller reach plus 4 units in the
/// last place of the largest coordinate, which is what rounding decimals can do.
double touch_tolerance(double relative, double smaller_reach, const Vec3& a, const Vec3& b);

/// Things made by rule lie as tight as this, relative to the smaller one's reach.
inline constexpr double tight = 1e-12;

/// A hashed grid of unbounded space, one level for each octave of diameters. A body is looked for on every level that
/// is in use; bodies put in from the largest to the smallest find their neighbours in 27 cells a level.
class BodyGrid {
 public:
  /// A body or an obstacle; volumes that are no spheres are those of the grid's world.
  struct Member {
    Vec3 center;    // m
    double radius;  // m, its reach
    Entity entity;
  };
  struct Overlap {
    Entity entity;
    double depth;  // m
  };

  /// Without a world all members are balls.
  explicit BodyGrid(const World* world = nullptr) : world_(world) {}

  void reserve(std::size_t members);
  void insert(const Member& member);
  /// A member that overlaps this body by more than touching, if there is any.
  std::optional<Overlap> find_overlap(const Member& body, double relative = tight) const;
  /// Asks memory for what find_overlap will look at: first for the cells, later for those in them.
  enum class Prefetch { cells, members };
  void prefetch(const Member& body, Prefetch what) const;

 private:
  struct Level {
    int exponent;    // of its diameters: from 2^(exponent-1) to below 2^exponent
    double cell;     // m, the first one's diameter
    double largest;  // m, of the diameters
    std::vector<std::uint32_t> members;
  };
  struct Cells {
    std::int64_t low[3], high[3];
    double count = 1;
  };
  Cells cells_about(const Level& level, const Member& body) const;
  template <typename Visit>
  void each_bucket(std::uint32_t level, const Cells& cells, Visit visit) const;
  std::size_t bucket(std::uint32_t level, std::int64_t x, std::int64_t y, std::int64_t z) const;
  std::size_t bucket(std::uint32_t level, const Vec3& center) const;
  void link(std::uint32_t member);
  std::optional<Overlap> overlap_with(const Member& member, const Member& body, double relative) const;
  std::optional<Overlap> overlap_in_chain(std::uint32_t head, const Member& body, double relative) const;
  bool is_ball(Entity entity) const { return world_ == nullptr || world_->volume_of(entity).shape == Shape::sphere; }

  const World* world_;
  struct Link {
    Member member;
    std::uint32_t next;  // in the chain of its bucket
  };
  std::vector<Link> members_;
  std::vector<std::uint32_t> level_;  // by member, of levels_
  std::vector<std::uint32_t> heads_;  // by bucket
  std::vector<Level> levels_;
};

/// How deep a body at `center` overlaps a plane or a wall (by number) beyond touching, m; none: it does not.
std::optional<double> overlap_depth(const World& world, Entity body, const Vec3& center, Entity surface,
                                    double relative = tight);
bool touches_no_surface(const World& world, Entity body, const Vec3& center);

}  // namespace carom
