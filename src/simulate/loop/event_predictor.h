#pragma once
// The next event of a body, the first of these:
// - a collision with a neighbour or a fixed thing
// - a string that goes taut
// - the end of its bounces
// - a rim that it slides over
// - a force that starts or ends, or a thing nearby whose velocity jumps
// - the next step of its island

#include "simulate/loop/exact_collision_times.h"
#include "simulate/loop/straight_times.h"
#include "std.h"

namespace carom {

class EventQueue;
class ExactGroup;
class ModeChanges;
class FlatContacts;

class EventPredictor {
 public:
  EventPredictor(ExactBodies& bodies, EventQueue& queue, const ModeChanges& modes, const FlatContacts& flat,
                 const ExactGroup& group);

  /// Predicts body i's next event among its neighbours. The events of other bodies stay.
  /// The body of a pair that was predicted last holds the pair's collision. Neither holds it while one of them has an
  /// earlier event.
  void predict(Entity i);
  /// The same for all bodies at once. A pair is tested once, from the higher number.
  /// It is not tested at all if the two fall alike from rest, without a curve.
  void predict_all();
  /// Gives body i, which leaves its region, a new region, and predicts collisions with the bodies in it.
  /// A body that leaves several regions on one flight tries wider ones. Among bodies with the same motion they cost no
  /// more.
  void renew_region(Entity i);

  uint64_t pair_tests() const { return pair_tests_; }
  uint64_t surface_tests() const { return surface_tests_; }

  void keep(auto& archive) { archive(pair_tests_, surface_tests_); }

 private:
  [[gnu::noinline]] void predict_crowd(Entity i);
  [[gnu::noinline]] void be_watched(Entity i);
  void predict_among(Entity i, span<const Entity> bodies);
  [[gnu::always_inline]] void offer(Entity i, ExactEvent& best, ExactEvent candidate) const;
  bool is_tie(const ExactEvent& first, const Instant& later) const;
  double latest_tie(const ExactEvent& first) const;
  [[gnu::noinline]] void offer_beside_contacts(Entity i, ExactEvent& best);
  void offer_strings(Entity i, ExactEvent& best);
  void offer_flat_contacts(Entity i, ExactEvent& best) const;
  void meet_each(Entity i, span<const Entity> others, ExactEvent& best);
  [[gnu::noinline]] void meet_moving(Entity i, Entity thing, ExactEvent& best);
  double latest_exit(Entity i);
  void offer_switch(Entity i, Entity thing, ExactEvent& best) const;
  void meet_bodies(Entity i, span<const Entity> others, ExactEvent& best);
  void meet_alike(Entity i, span<const Entity> others, ExactEvent& best);

  ExactBodies& bodies_;
  EventQueue& queue_;
  const ModeChanges& modes_;
  const FlatContacts& flat_;
  const ExactGroup& group_;
  ExactCollisionTimes times_;
  const bool plain_;       // there are neither strings nor forces, and nothing moves
  vector<Entity> alike_;   // scratch
  vector<Entity> unlike_;  // scratch
  vector<Meet> meets_;     // scratch
  uint64_t pair_tests_ = 0;
  uint64_t surface_tests_ = 0;
};

}  // namespace carom
