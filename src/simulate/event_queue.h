#pragma once
// The bodies' next events in their total order: time, kind, the lower and the higher number of the bodies concerned.
// At one instant, bodies that leave their regions come first, because that is not a physical event.
#include <vector>

#include "simulate/exact_bodies.h"
#include "simulate/tournament.h"

namespace carom {

class EventQueue {
  struct Before {
    const EventQueue* queue;
    bool operator()(std::uint32_t i, std::uint32_t j) const { return queue->before(i, j); }
  };

 public:
  using Due = Tournament<Before>::Due;

  explicit EventQueue(const ExactBodies& bodies)
      : bodies_(bodies), queue_(static_cast<std::uint32_t>(bodies.body.size()), Before{this}) {}

  Entity first() const { return queue_.first(); }
  double first_time() const { return queue_.first_time(); }  // s; infinite: there is none
  /// Whether body i leaves its region before its event.
  bool leaves_first(Entity i) const { return queue_.time(i) < bodies_.body[i].event.time.hi; }

  /// Registers a change of body i's event. leave_time: when it leaves its region (s). Nothing after the duration is
  /// scheduled.
  void schedule(Entity i, double leave_time) {
    const double next = std::min(bodies_.body[i].event.time.hi, leave_time);
    queue_.update(i, next <= bodies_.options.duration ? next : never);
  }
  void remove(Entity i) { queue_.update(i, never); }

  /// Appends bodies with events up to `until` (s), in no order and not all of them (tournament.h).
  void due_until(double until, std::vector<Due>& due) const { queue_.due_until(until, due); }
  void prefetch(Entity i) const { queue_.prefetch(i); }

 private:
  bool before(Entity i, Entity j) const;

  const ExactBodies& bodies_;
  Tournament<Before> queue_;
};

}  // namespace carom
