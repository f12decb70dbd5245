#pragma once
// What happens at the events of a step: two things meet, or a contact ends. The paths of the bodies concerned end
// there, and others begin.
#include <vector>

#include "physics/touch.h"
#include "simulate/stepped_binding.h"
#include "simulate/stepped_events.h"
#include "simulate/stepped_impact_predictor.h"
#include "simulate/stepped_motion.h"
#include "simulate/stepped_shared.h"

namespace carom {

class StepImpacts {
 public:
  /// All must outlive this.
  StepImpacts(StepShared& shared, StepMotion& motion, StepImpactPredictor& predictor, ClusterBinding& binding,
              StepEvents& events)
      : shared_(shared), motion_(motion), predictor_(predictor), binding_(binding), events_(events) {}

  /// An event of the bodies' present paths happens.
  void process(const StepEvent& event);

 private:
  struct PointState {
    Vec3 x, v;  // m, m/s
  };
  struct ImpactOutcome {
    std::uint8_t feature;  // at which the two have met
    bool parts;            // they separate
  };

  void release(const StepEvent& event);
  void collide(const StepEvent& event);
  double refined_time(const StepEvent& event) const;
  PointState state_at(Entity e, double time) const;
  bool waits_for_step(Entity e) const;
  void stop_at_waiting(Entity a, Entity b, double time);
  void stop_at(Entity still, Entity comes, double time);
  void attach(Entity i, Entity carrier);
  ImpactOutcome resolve(const StepEvent& event, double time, const Vec3& relative_acceleration);
  void begin_paths(const std::vector<Entity>& bodies);

  StepShared& shared_;
  StepMotion& motion_;
  StepImpactPredictor& predictor_;
  ClusterBinding& binding_;
  StepEvents& events_;
};

}  // namespace carom
