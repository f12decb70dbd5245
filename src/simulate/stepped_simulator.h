#pragma once
// The stepped simulator: its parts, and the loop over its steps.
//
// A step integrates every body from one instant to the next as if it were alone, which gives a path. The first impact
// of two paths is found (path_time_of_impact.h). Both bodies take their step again, shorter, up to there, collide, and
// take another for what is left of it. So it goes on until no paths meet. No impact is moved to a step's end, so the
// order of the method outlasts it. Bodies that nothing touches do not depend on the others' impacts.
//
// Bodies in lasting contact make a cluster (stepped_clusters.h): they take their steps together, under contact forces.
// A contact ends inside the step where its force turns to zero. Bounces shorter than a step are none: there contact
// begins. A cluster that nothing moves sleeps and costs nothing. Many bodies in contact are a group (stepped_group.h),
// whose step is one problem.
#include "simulate/simulator.h"
#include "simulate/stepped.h"
#include "simulate/stepped_binding.h"
#include "simulate/stepped_events.h"
#include "simulate/stepped_group.h"
#include "simulate/stepped_impact_predictor.h"
#include "simulate/stepped_impacts.h"
#include "simulate/stepped_motion.h"
#include "simulate/stepped_shared.h"
#include "simulate/stepped_view.h"

namespace carom {

class SteppedSimulator final : public Simulator {
 public:
  SteppedSimulator(const World& world, const State& initial, const SteppedOptions& options);

  void advance_to(double time) override;
  double time() const override { return time_; }
  const State& state() override { return view_.state(time_); }
  std::span<const Collision> collisions() const override { return shared_.log.collisions(); }
  const Tally& tally() const override { return shared_.log.tally(); }
  std::span<const ContactForce> contacts() override { return view_.forces(time_); }

 private:
  void do_step();
  void begin_step();
  void bind_clusters();
  bool joins_group(const std::vector<Entity>& bodies) const;
  void begin_paths();
  void predict_events();
  void end_step();

  StepShared shared_;
  StepMotion motion_;
  StepEvents events_;
  StepImpactPredictor predictor_;
  ClusterBinding binding_;
  StepImpacts impacts_;
  ContactGroup group_;
  StepView view_;
  double time_ = 0;  // s, asked for
};

}  // namespace carom
