#pragma once
// Finds which bodies are in lasting contact, takes the rest of their approach, and makes clusters of them.
#include <vector>

#include "physics/contact_problem.h"
#include "physics/touch.h"
#include "simulate/neighbours.h"
#include "simulate/stepped_events.h"
#include "simulate/stepped_motion.h"
#include "simulate/stepped_places.h"
#include "simulate/stepped_shared.h"

namespace carom {

class ClusterBinding {
 public:
  /// All must outlive this.
  ClusterBinding(StepShared& shared, StepMotion& motion, const Neighbours& neighbours);

  /// Makes clusters of the bodies that are in lasting contact with one another, with fixed things, or with others.
  /// Those join the bodies. All paths of the bodies begin at `time` (s, since the step's start). Velocities change so
  /// that no contact closes, as little as kinetic energy tells. Contacts that forces open are left out.
  void bind(std::vector<Entity>& bodies, double time);
  /// The same of bodies of which two have just met. parts: they separate now. Else they are in contact: paths may lead
  /// two into each other that neither their velocities nor their accelerations do.
  void bind_after(const StepEvent& met, bool parts, std::vector<Entity>& bodies, double time);

 private:
  bool touches(Entity a, const Vec3& xa, const Vec3& va, Entity b, const Vec3& xb, const Vec3& vb, Touch& there) const;
  void add_touching(std::vector<Entity>& bodies, double time);
  void find_clusters(std::vector<Entity>& bodies, double time, const StepEvent* met, bool parts);
  void find_contacts(const std::vector<Entity>& bodies, const StepEvent* met, bool parts);
  void stop_approach(const std::vector<Entity>& bodies);
  void find_forces();
  double opening(std::size_t c, const std::vector<Vec3>& u) const;
  template <typename Keeps>
  void keep_contacts(const Keeps& keeps);
  void make_clusters(const std::vector<Entity>& bodies);
  bool balanced(Entity i, const Vec3& acceleration) const;
  void finish(std::uint32_t c);
  void hand_over(std::uint32_t c);
  void fall_asleep(const Cluster& cluster);

  StepShared& shared_;
  StepMotion& motion_;
  const Neighbours& neighbours_;
  BodyPlaces place_;  // among the bodies
  // Of the bodies at hand, by place; contacts and pairs side by side.
  std::vector<ClusterContact> contacts_;
  std::vector<ContactConstraint> pairs_;
  std::vector<double> inverse_mass_;    // 1/kg
  std::vector<Vec3> v_, a_;             // m/s, m/s^2, what contact leaves of their velocities and accelerations
  double fastest_ = 0, strongest_ = 0;  // m/s, m/s^2, the greatest speed, the greatest free acceleration
};

}  // namespace carom
