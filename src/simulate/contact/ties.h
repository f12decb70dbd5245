#pragma once
// The strings and rods of each body. A string has one name for both of its ends: its own number.

#include "physics/world.h"
#include "std.h"

namespace carom {

class Ties {
 public:
  /// `world` must outlive this object.
  explicit Ties(const World& world);

  /// Whether there are any. Where there are none, no other function need be called.
  bool any() const { return any_; }
  /// The strings of body i, ascending.
  span<const Entity> of(Entity i) const { return any_ ? span<const Entity>(of_[i]) : span<const Entity>(); }
  /// The body at the end of a string that body i does not hold; no_entity: the anchor is there.
  Entity other(Entity string, Entity i) const;
  /// Removes the strings of body i.
  void untie(Entity i);
  /// The first time (s) after `time` at which a string of body i is cut; infinity: none is.
  double next_cut(Entity i, double time) const;
  /// Removes a string.
  void cut(Entity string);

  void keep(auto& archive) { archive.sized(of_); }

 private:
  const World& world_;
  const bool any_;
  vector<vector<Entity>> of_;  // by body; empty: there are none
};

}  // namespace carom
