#pragma once
// What can be seen of the stepped simulator at an instant within its present step.
#include <span>
#include <vector>

#include "physics/contact_force.h"
#include "physics/state.h"
#include "simulate/stepped_cluster_motion.h"
#include "simulate/stepped_group.h"
#include "simulate/stepped_shared.h"

namespace carom {

class StepView {
 public:
  /// All must outlive this.
  StepView(const StepShared& shared, const ClusterMotion& motion, const ContactGroup& group);

  /// The simulator has gone on: the state is found anew when it is asked for.
  void clear() { fresh_ = false; }
  /// At `time` (s): a body alone by the step as long as it takes until then, another one by its path.
  const State& state(double time);
  /// At `time` (s), by a, then b: in clusters the forces at that instant; in the contact group those of its step.
  std::span<const ContactForce> forces(double time);

 private:
  void look(const StepPiece& piece, double t);
  void add_forces(const Cluster& cluster, double since);

  const StepShared& shared_;
  const ClusterMotion& motion_;
  const ContactGroup& group_;
  State state_;
  bool fresh_ = false;  // state_ is at the simulator's time
  std::vector<ContactForce> forces_;
};

}  // namespace carom
