#pragma once
// What comes next for a body: the first of the collisions with its neighbours and with fixed things, the end of its
// bounces, a rim that it slides over, a force that sets in or ceases, the contact group's next step.
#include <span>
#include <vector>

#include "simulate/exact_collision_times.h"
#include "simulate/straight_times.h"

namespace carom {

class EventQueue;
class ExactGroup;
class FlatContacts;

class EventPredictor {
 public:
  EventPredictor(ExactBodies& bodies, EventQueue& queue, const FlatContacts& flat, const ExactGroup& group)
      : bodies_(bodies), queue_(queue), flat_(flat), group_(group), times_(bodies) {}

  /// Finds body i's next event among its neighbours. Other bodies' events stay as they are: a pair's collision stands
  /// with that of the two that was predicted last, or with neither while one of them has an earlier one.
  void predict(Entity i);
  /// The same for all bodies at once. A pair is asked once, by the higher number, and not at all if the two fall alike
  /// from rest.
  void predict_all();
  /// Gives body i, which leaves its region, a new one, and finds what it may meet in that. One that leaves region after
  /// region on one and the same flight tries wider ones: among bodies that fly along they cost no more.
  void renew_region(Entity i);

  std::uint64_t pair_tests() const { return pair_tests_; }
  std::uint64_t surface_tests() const { return surface_tests_; }

 private:
  void predict_among(Entity i, std::span<const Entity> bodies);
  void offer(Entity i, ExactEvent& best, ExactEvent candidate) const;
  void offer_flat_contacts(Entity i, ExactEvent& best) const;
  void meet_each(Entity i, std::span<const Entity> others, ExactEvent& best);
  void meet_bodies(Entity i, std::span<const Entity> others, ExactEvent& best);

  ExactBodies& bodies_;
  EventQueue& queue_;
  const FlatContacts& flat_;
  const ExactGroup& group_;
  ExactCollisionTimes times_;
  std::vector<Entity> alike_;  // scratch
  std::vector<Meet> meets_;    // scratch
  std::uint64_t pair_tests_ = 0, surface_tests_ = 0;
};

}  // namespace carom
