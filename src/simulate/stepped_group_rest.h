#pragma once
// How the contact group comes to rest. A part of it that has been slow for a while is looked at. If forces hold it in
// balance close by, it is set on its surfaces there and falls asleep: a cluster that costs nothing.
#include <cstdint>
#include <vector>

#include "physics/contact_problem.h"
#include "simulate/stepped_group_bodies.h"
#include "simulate/stepped_group_contacts.h"
#include "simulate/stepped_shared.h"

namespace carom {

class GroupRest {
 public:
  /// Both must outlive this.
  GroupRest(StepShared& shared, const StepImpactPredictor& predictor);

  /// Notes body i's speed (m/s) at the end of this step, and whether contact forces act on it. `acceleration` (m/s^2):
  /// slow is what is slow by the speed of falling by a radius under it.
  void note(Entity i, bool pressed, double speed, double acceleration);
  /// The group's step is done, its contacts' impulses are known: parts of it come to rest.
  void put_to_rest(const GroupBodies& group, const std::vector<GroupContact>& contacts);

 private:
  using Places = std::vector<std::uint32_t>;

  std::vector<Places> parts_of(const GroupBodies& group, const std::vector<GroupContact>& contacts) const;
  bool due(const GroupBodies& group, const Places& part) const;
  void try_part(const GroupBodies& group, const Places& places);
  bool find_balance(GroupBodies& part);
  double sink(GroupBodies& part, double drive, std::vector<ContactConstraint>& pairs);
  void stand(const GroupBodies& part);
  void fall_asleep(const GroupBodies& part);

  StepShared& shared_;
  GroupContacts contacts_;                 // of the part at hand, the others fixed
  std::vector<std::uint32_t> slow_steps_;  // by body: for how many steps it has been slow
  std::vector<std::uint32_t> failures_;    // by a part's first body: how often the part was found in no balance
};

}  // namespace carom
