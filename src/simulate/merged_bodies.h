#pragma once
// Bodies that have become one: which bodies each joint body is made of, and the World with the joint masses and
// volumes. Forces act on the parts.
#include <memory>
#include <span>
#include <vector>

#include "physics/world.h"

namespace carom {

/// What forces do to a body that stands. Where it moves at v, it is less by fade v.
struct AppliedAcceleration {
  Vec3 all;     // m/s^2
  double fade;  // 1/s
};

class MergedBodies {
 public:
  /// merge: whether bodies may merge; only then is `world`, which must outlive this, copied.
  MergedBodies(const World& world, bool merge);

  const World& given() const { return given_; }                     // before any merging
  const World& world() const { return joint_ ? *joint_ : given_; }  // the same object from first to last
  bool any() const { return !whole_of_.empty(); }
  const std::vector<Entity>& whole_of() const { return whole_of_; }  // by body: the one it is part of; empty: none

  /// What body i is made of; none: itself.
  std::span<const Entity> parts_of(Entity i) const {
    return parts_.empty() ? std::span<const Entity>() : std::span<const Entity>(parts_[i]);
  }
  /// The accelerations of body i by the forces at `time` (s).
  AppliedAcceleration applied(Entity i, double time) const;
  /// s, when a force on body i next sets in or ceases after `time`.
  double next_switch(Entity i, double time) const;
  /// J, of body i at x (m).
  double potential(Entity i, const Vec3& x) const;

  /// Body `part` becomes part of body `whole`: masses, volumes, restitution by mass.
  void join(Entity whole, Entity part);

 private:
  void begin();

  const World& given_;
  std::unique_ptr<World> joint_;            // none: bodies do not merge
  std::vector<Entity> whole_of_;            // empty: nothing has merged
  std::vector<std::vector<Entity>> parts_;  // by joint body: itself and what has become part of it
  std::vector<double> share_;               // by body: its own mass over its joint body's
};

}  // namespace carom
