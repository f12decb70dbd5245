#pragma once
// Which bodies are of the contact group, and for how many steps yet. A body that has met the group within the present
// step has a carrier: it goes along with that until the step ends.
#include <cstdint>
#include <vector>

#include "physics/world.h"
#include "simulate/tolerances.h"

namespace carom {

class GroupMembers {
 public:
  explicit GroupMembers(std::size_t bodies) : steps_left_(bodies), in_step_(bodies), carrier_(bodies, no_entity) {}

  /// Takes body i into the group, from the next step on.
  void join(Entity i) { steps_left_[i] = stepped_tolerance::group_steps; }
  /// Counts a step that body i was in without contact.
  void count_step(Entity i) { --steps_left_[i]; }
  void leave(Entity i) { steps_left_[i] = 0; }
  /// Takes body i into the group's present step.
  void enter_step(Entity i) { in_step_[i] = 1; }
  /// Body i is in the present step, and goes along with `carrier` to its end; with itself: it stands.
  void enter_step(Entity i, Entity carrier) {
    in_step_[i] = 1;
    carrier_[i] = carrier;
  }
  void end_step(Entity i) {
    in_step_[i] = 0;
    carrier_[i] = no_entity;
  }

  bool joined(Entity i) const { return steps_left_[i] > 0; }
  bool in_step(Entity i) const { return in_step_[i] != 0; }                // of a body
  bool has(Entity e) const { return e < in_step_.size() && in_step_[e]; }  // of a fixed thing: false
  Entity carrier(Entity i) const { return carrier_[i]; }  // no_entity: it was of the group from the step's start
  bool stands(Entity i) const { return carrier_[i] == i; }
  bool carried(Entity i) const { return carrier_[i] != no_entity && carrier_[i] != i; }
  /// Whether the group's step has moved body i, all through.
  bool from_start(Entity i) const { return in_step_[i] && carrier_[i] == no_entity; }

 private:
  std::vector<std::uint8_t> steps_left_;  // by body; 0: it is not of the group
  std::vector<std::uint8_t> in_step_;     // by body
  std::vector<Entity> carrier_;           // by body
};

}  // namespace carom
