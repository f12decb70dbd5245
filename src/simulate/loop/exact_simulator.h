#pragma once
// The exact simulator: a list of parts, and the loop that takes one event after the other (exact.h).

#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/impact/body_merging.h"
#include "simulate/impact/body_removal.h"
#include "simulate/impact/impacts.h"
#include "simulate/impact/stall_guard.h"
#include "simulate/island/island_motion.h"
#include "simulate/loop/appearances.h"
#include "simulate/loop/event_predictor.h"
#include "simulate/loop/event_prefetch.h"
#include "simulate/loop/event_queue.h"
#include "simulate/path/crossings.h"
#include "simulate/path/path_log.h"
#include "std.h"

namespace carom {

class ExactSimulator final : public Simulator {
 public:
  ExactSimulator(const World& world, const State& initial, const ExactOptions& options);

  void advance_to(double time) override;
  double time() const override { return time_; }
  const State& state() override;
  span<const Collision> collisions() const override { return bodies_.log.collisions(); }
  span<const PathPiece> paths() const override { return paths_.pieces(); }
  span<const RegionCrossing> crossings() const override { return crossings_.recorded(); }
  const Tally& tally() const override { return bodies_.log.tally(); }
  vector<Extremes> extremes() const override {
    return paths_.extremes().up_to(tally().end ? min(time_, tally().end->time) : time_);
  }
  vector<double> impulses() const override {
    return bodies_.contact_work.impulses_up_to(tally().end ? min(time_, tally().end->time) : time_);
  }
  Effort effort() const override;
  span<const ContactForce> contacts() override;
  string save() override;
  void restore(string_view bytes) override;
  const ModeChanges& modes() const { return modes_; }

 private:
  /// What queries have found.
  struct Answers {
    State state;
    bool state_fresh = false;
    vector<ContactForce> contact_forces;
    Entity awake = 0;  // a body that moved when it was last looked for
  };

  /// For save() and restore().
  template <typename Archive>
  void keep(Archive& archive);
  void start(const State& initial);
  void hold_back(Entity i, const Vec3& x);
  void begin_island(Entity i);
  uint32_t take_event(Entity i);
  uint32_t process(Entity i);
  [[gnu::always_inline]] void predict_changed();
  void go_taut(Entity i, const ExactEvent& event);
  [[gnu::noinline]] void interrupt(Entity thing);
  bool strike_at_once(Entity i, const ExactEvent& event);
  [[gnu::noinline]] bool may_be_simultaneous(Entity i, const ExactEvent& event);
  void take_switch(Entity i);
  void switch_forces(Entity i);
  vector<Entity> couple(Entity i);
  void slide_off(Entity i, Entity surface, uint8_t edge);
  void end_flight(Entity i);
  bool watches() const;
  bool happens_before(const Instant& next, bool at_it);
  void take_crossing(const Crossings::Taken& taken);
  void set_off(const Instant& at);
  void cut_strings(Entity i);
  void take_appearances(const Instant& at);
  void admit(const Appearances::Admitted& admitted);
  void end_by(const Crossings::Taken& taken);
  void book_last(double time);
  void end_run(double time, EndReason reason, uint32_t region);
  bool is_over() const { return tally().end.has_value(); }
  bool rests(Entity i) const;
  bool all_rest();

  ExactBodies bodies_;
  Crossings crossings_;
  PathLog paths_;
  CollapseDetector collapses_;
  ModeChanges modes_;
  FlatContacts flat_;
  ExactGroup group_;
  FlightChanges flights_;
  EventQueue queue_;
  EventPrefetch prefetch_;
  EventPredictor predictor_;
  IslandMotion islands_;
  BodyMerging merging_;
  StallGuard guard_;
  Impacts impacts_;
  Appearances appearances_;
  Effort effort_;
  double time_ = 0;  // s: time that advance_to has reached
  // Whether regions or the run's end depend on the paths between events, or events are prefetched.
  const bool attends_;
  Answers answers_;
};

}  // namespace carom
