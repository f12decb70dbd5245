#pragma once
// Finds the pairs that may come into contact in a step of the contact group. Each body has a
// bound of its speed, and is searched as far as it may go at that. Where a bound rises, it is searched again.
#include <vector>

#include "physics/contact_problem.h"
#include "physics/touch.h"
#include "simulate/neighbours.h"
#include "simulate/stepped_group_bodies.h"
#include "simulate/stepped_impact_predictor.h"
#include "simulate/stepped_places.h"
#include "simulate/stepped_shared.h"

namespace carom {

struct GroupContact {
  Entity a, b;
  std::uint32_t of_a, of_b;  // their places in the group; of_b ContactConstraint::fixed: not of it
  Vec3 normal;               // unit, from a to b
  double gap, approach;      // m, m/s, as the step begins
  double restitution = 0;
  double impulse = 0;  // N s, in the step
  bool impact = false;
};

class GroupContacts {
 public:
  /// others_fixed: bodies that are not of the group are fixed where their paths end; else they are left out. Both must
  /// outlive this.
  GroupContacts(const StepShared& shared, const StepImpactPredictor& predictor, bool others_fixed);

  /// Begins with none. Each body's bound is its speed, and so much (m/s) more,
  void start(const GroupBodies& bodies, double more);
  /// or this speed (m/s).
  void start_all(const GroupBodies& bodies, double speed);
  /// Raises body k's bound to this speed (m/s), if it is less.
  void raise(std::size_t k, double speed) { bound_[k] = std::max(bound_[k], speed); }
  double bound(std::size_t k) const { return bound_[k]; }                   // m/s
  bool searched(std::size_t k) const { return bound_[k] == searched_[k]; }  // up to its bound
  /// Adds what has come within the bounds.
  void find(const GroupBodies& bodies);

  void clear() { list_.clear(); }
  std::vector<GroupContact>& list() { return list_; }
  const std::vector<GroupContact>& list() const { return list_; }

 private:
  void find_near(const GroupBodies& bodies, std::size_t k, double drop);
  Touch touch_of(const GroupBodies& bodies, std::size_t k, Entity e, const Vec3& xe, double reach) const;

  const StepShared& shared_;
  const StepImpactPredictor& predictor_;
  const bool others_fixed_;
  BodyPlaces place_;              // in the group
  std::vector<double> bound_;     // m/s, by place: how fast a body may go, at least,
  std::vector<double> searched_;  // and for which it has been searched
  std::vector<GroupContact> list_;
};

}  // namespace carom
