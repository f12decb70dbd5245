#pragma once
// The next step of an island by constrained motion: what contact does at its start, the forces, the motion and its
// length, and what becomes of each member. Nothing outside of the step changes.
#include "simulate/island/island_step.h"
#include "std.h"

namespace carom {

class ExactGroup;

class ConstrainedSteps {
 public:
  ConstrainedSteps(const ExactBodies& bodies, const ExactGroup& group) : bodies_(bodies), group_(group) {}

  /// Completes a step of an island with connected contacts, from its members and contacts. `next_length`: s, a good
  /// length for a step along a path, or 0. Throws SimulationError where the bodies are jammed, or have no room.
  void complete(IslandStep& step, double next_length) const;

 private:
  double share_of_errors() const;
  void close_overlaps(IslandStep& step) const;
  void take_approaches(IslandStep& step) const;
  vector<AbsorbedImpact> absorbed_impacts(const IslandStep& step, const vector<Vec3>& met) const;
  void record_fast(IslandStep& step, vector<AbsorbedImpact>& impacts) const;
  double parting_speed(const IslandStep& step) const;
  void drop_parting(IslandStep& step) const;
  ConstrainedSystem make_system(const IslandStep& step) const;
  static void accelerate(IslandStep& step, ConstrainedSystem& system);
  ConstrainedSystem find_forces(IslandStep& step) const;
  bool stop_parting(IslandStep& step) const;
  void check_digits(const IslandStep& step, double acceleration) const;
  double turn_by_rounding(const IslandStep& step, size_t pair) const;
  void check_directions(const IslandStep& step) const;
  double leverage(const IslandStep& step, size_t pair) const;
  [[noreturn]] void fail_jammed(Entity i, double force) const;
  void find_resting(IslandStep& step) const;
  void note_unbalanced(IslandStep& step) const;
  void find_pressed(IslandStep& step) const;
  double longest(IslandStep& step) const;
  void choose_motion(IslandStep& step, ConstrainedSystem& system, double next_length) const;
  void follow(IslandStep& step, ConstrainedSystem& system, double next_length) const;
  double rim_time(const IslandStep& step, size_t pair, double length) const;
  double away_time(const IslandStep& step, size_t pair) const;

  const ExactBodies& bodies_;
  const ExactGroup& group_;
};

}  // namespace carom
