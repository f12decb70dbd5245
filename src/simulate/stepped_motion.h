#pragma once
// Begins and ends the bodies' paths in a step: of bodies alone and of clusters. Books the work of forces on them.
#include <vector>

#include "simulate/stepped_cluster_motion.h"
#include "simulate/stepped_shared.h"

namespace carom {

class StepMotion {
 public:
  /// `shared` must outlive this.
  explicit StepMotion(StepShared& shared);

  const ClusterMotion& of_clusters() const { return cluster_motion_; }
  /// m/s^2, of a body or a fixed thing where its path begins.
  Vec3 acceleration_of(Entity e) const;

  /// Body i flies on alone to the step's end from where its path begins,
  void begin(Entity i);
  /// or a cluster that moves.
  void begin(Cluster& cluster);

  /// Ends body i's path at x (m) and v (m/s), at `time` (s, since the step's start). J: the work on it.
  double end(Entity i, double time, const Vec3& x, const Vec3& v);
  /// Carries body i, which is alone, to `time`, and ends its path there.
  void end_alone(Entity i, double time);
  /// Takes a cluster apart at `time`, and adds its bodies to `bodies`.
  void dissolve(std::uint32_t c, double time, std::vector<Entity>& bodies);
  /// Ends the path of body i, or its cluster's, at `time`, and adds the bodies to `bodies`.
  void set_free(Entity i, double time, std::vector<Entity>& bodies);

  /// Books the work of forces on body i, from where its path begins to x and v, `length` (s) later. J: that work.
  double book_work(Entity i, const Vec3& x, const Vec3& v, double length);

 private:
  StepShared& shared_;
  ClusterMotion cluster_motion_;
};

}  // namespace carom
