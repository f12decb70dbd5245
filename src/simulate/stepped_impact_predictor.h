#pragma once
// Which bodies' paths meet in a step, and when. Each path lies in a ball. Bodies whose balls are apart do not meet. A
// body that is far from all others is not looked at again until bodies have travelled far enough.
#include <vector>

#include "simulate/neighbours.h"
#include "simulate/stepped_events.h"
#include "simulate/stepped_shared.h"

namespace carom {

class StepImpactPredictor {
 public:
  /// Both must outlive this.
  StepImpactPredictor(const StepShared& shared, StepEvents& events);

  /// A ball that a body's surface does not leave on its path.
  struct PathBall {
    Vec3 x;         // m
    double radius;  // m
  };
  const PathBall& ball(Entity i) const { return balls_[i]; }
  const Neighbours& neighbours() const { return neighbours_; }

  void begin_step();
  /// Sees to it that body i's neighbours are all that it can meet on its path.
  void cover_path(Entity i);

  /// All awake bodies' paths have begun with the step: schedules the first impact of each pair.
  void predict_step();
  /// Body i's path has begun within the step: schedules its first impact with each thing.
  void predict(Entity i) { predict(i, true); }
  /// Bodies may go farther than their paths, by so much (m).
  void add_travel(double distance) { step_travel_ += distance; }
  /// Between steps: gives memory back.
  void tidy() { neighbours_.tidy(); }

 private:
  void predict(Entity i, bool all);
  double predict_fixed(Entity i, Entity e, bool sleepers_only);
  void predict_pair(Entity a, Entity b);
  bool kept_apart(Entity a, Entity b) const;

  const StepShared& shared_;
  StepEvents& events_;
  Neighbours neighbours_;
  std::vector<PathBall> balls_;      // by body, of its present path
  std::vector<double> clear_until_;  // m, of travelled_: before that a body meets nothing
  double travelled_ = 0;             // m, at least as far as any body has gone until the step began,
  double step_travel_ = 0;           // and goes in it
  bool some_asleep_ = false;         // some cluster is
};

}  // namespace carom
