#pragma once
// What changes of a World: bodies merge, and events set times. Of merged bodies there are the parts of each joint body,
// and the World with the joint masses and volumes. Forces act on the parts. Bodies out of the world are marked too.

#include "physics/world.h"
#include "std.h"

namespace carom {

/// The acceleration of a body at rest by forces. At velocity v it is less by fade v.
struct AppliedAcceleration {
  Vec3 all;     // m/s^2
  double fade;  // 1/s
};

class MergedBodies {
 public:
  /// merge: whether bodies may merge. Only then, or where events set times, `world` is copied. It must outlive this
  /// object.
  MergedBodies(const World& world, bool merge);

  const World& given() const { return given_; }                     // before any merge, with times that events have set
  const World& world() const { return joint_ ? *joint_ : given_; }  // the same object throughout
  bool any() const { return !whole_of_.empty(); }
  const vector<Entity>& whole_of() const {
    return whole_of_;
  }  // by body: the body that it is part of; no_entity: it is out of the world; empty: there is neither

  /// The parts of body i; none: only itself.
  span<const Entity> parts_of(Entity i) const {
    return parts_.empty() ? span<const Entity>() : span<const Entity>(parts_[i]);
  }
  /// The accelerations of body i by the forces at `time` (s).
  AppliedAcceleration applied(Entity i, double time) const;
  /// Whether forces that bend paths act on body i at `time` (s), and the acceleration by all forces then, at x (m) and
  /// v (m/s), in m/s^2.
  bool bends(Entity i, double time) const;
  Vec3 acceleration(Entity i, double time, const Vec3& x, const Vec3& v) const;
  /// The part of one force's acceleration of body i at `time` (s) that does work, because it has no potential (m/s^2).
  Vec3 working_acceleration(const Force& force, Entity i, double time, const Vec3& x, const Vec3& v) const;
  /// A part of body i and its share of the mass. None: body i is not joint.
  vector<pair<Entity, double>> shares_of(Entity i) const;
  /// The first time (s) after `time` at which a force on body i starts or ends.
  double next_switch(Entity i, double time) const;
  /// The potential energy of body i at x (m), in J.
  double potential(Entity i, const Vec3& x) const;

  /// Makes body `part` a part of body `whole`. Masses and volumes add up, and restitution is weighted by mass.
  void join(Entity whole, Entity part);
  /// Takes body i, with its parts, out of the world.
  void remove(Entity i);
  /// Sets the times that wait for a trigger, which has happened at `time` (s).
  void set_off(uint32_t trigger, double time);
  /// Lets one that is out of the world come into it.
  void admit(Entity i) { whole_of_[i] = i; }

  void keep(auto& archive) {
    if (joint_) archive.sized(joint_->mass, joint_->radius, joint_->volume, joint_->restitution);
    archive(whole_of_, parts_, share_);
  }

 private:
  void begin();

  unique_ptr<World> timed_;  // none: no events set times
  const World& given_;
  unique_ptr<World> joint_;       // none: bodies do not merge
  vector<Entity> whole_of_;       // empty: nothing has merged
  vector<vector<Entity>> parts_;  // by joint body: itself and its parts
  vector<double> share_;          // by body: its own mass over that of its joint body
};

}  // namespace carom
