#pragma once
// The constrained motion of a cluster: its bodies take a step together, under contact forces that hold active contacts
// closed. The forces are found anew wherever the method asks for accelerations. At the step's end the bodies are
// projected on each other's surfaces, where the method has strayed from them.
#include <vector>

#include "physics/contact_problem.h"
#include "physics/path.h"
#include "physics/world.h"
#include "simulate/stepped_clusters.h"
#include "simulate/stepped_free_motion.h"
#include "simulate/stepped_paths.h"

namespace carom {

/// A cluster's bodies in numbers of their own: body k is bodies[k].
struct ClusterState {
  std::vector<double> inverse_mass;  // 1/kg
  std::vector<Vec3> x, v;            // m, m/s, where their paths begin
  std::vector<Vec3> end_x, end_v;    // m, m/s, where the motion has led
  std::vector<Path> path;            // between
  Certificate certificate;           // of the contact problems on the way
};

class ClusterMotion {
 public:
  /// All must outlive this.
  ClusterMotion(const World& world, const FreeMotion& free, const StepPaths& paths)
      : world_(world), free_(free), paths_(paths) {}

  /// A cluster where its paths begin.
  ClusterState start(const Cluster& cluster) const;
  /// Carries a cluster on for `length` (s) from state.x, state.v.
  void carry(const Cluster& cluster, double length, ClusterState& state) const;
  /// The same; inactive contacts that close on its path become active from the beginning on.
  void carry_and_activate(Cluster& cluster, double length, ClusterState& state) const;
  /// The accelerations (m/s^2) at x (m) and v (m/s), with the forces of active contacts. pairs: of these, in the
  /// contacts' order.
  Certificate accelerate(const Cluster& cluster, const ClusterState& state, const std::vector<Vec3>& x,
                         const std::vector<Vec3>& v, std::vector<Vec3>& a, std::vector<ContactConstraint>& pairs) const;

 private:
  void activate(Cluster& cluster, double length, ClusterState& state) const;
  void project(const Cluster& cluster, ClusterState& state) const;

  const World& world_;
  const FreeMotion& free_;
  const StepPaths& paths_;
};

}  // namespace carom
