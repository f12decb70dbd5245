#pragma once
// The contact group: many bodies that press on one another, or collide many times a step. All of them take each step at
// once (stepped_group_step.h), so that a pile of a thousand costs little more than its thousand balls do. A body that
// flies into the group stops where it meets it, and is of the group from the next step on. One that nothing has touched
// for a while leaves it.
#include <vector>

#include "physics/contact_force.h"
#include "simulate/stepped_group_bodies.h"
#include "simulate/stepped_group_contacts.h"
#include "simulate/stepped_group_rest.h"
#include "simulate/stepped_group_step.h"
#include "simulate/stepped_impact_predictor.h"
#include "simulate/stepped_motion.h"
#include "simulate/stepped_shared.h"

namespace carom {

class ContactGroup {
 public:
  /// All must outlive this.
  ContactGroup(StepShared& shared, StepMotion& motion, StepImpactPredictor& predictor);

  /// Takes the present step, if there are any bodies in the group. The other bodies have paths as if nothing met.
  void step();
  /// Books what contact took of energy on body i's path through the step, of which `work` (J) was done by forces.
  void book_energy(Entity i, double work);
  /// Adds the contact forces (N) of the present step.
  void add_forces(std::vector<ContactForce>& forces) const;

 private:
  std::vector<Entity> find_bodies();
  void add_reachable(std::vector<Entity>& bodies, std::size_t k);
  void cover_speed(Entity i, double speed);
  void find_contacts();
  void find_motion();
  void write_paths();
  void record_impacts();
  void count_resting();
  bool lasts(const GroupContact& c) const;

  StepShared& shared_;
  StepMotion& motion_;
  StepImpactPredictor& predictor_;
  GroupBodies bodies_;      // of the present step
  GroupContacts contacts_;  // of the present step
  GroupStep step_;
  GroupRest rest_;
  std::size_t resting_ = 0;  // bodies in lasting contact that do not sleep
};

}  // namespace carom
