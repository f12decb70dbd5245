#pragma once
// The bodies' next events in their total order: time, kind, the lower and the higher number of the bodies concerned, or
// the number of the string.
// At one instant, bodies that leave their regions come first, because that is not a physical event. Time alone would
// leave ties to chance, and a run's bits would depend on the queue's structure.

#include "numerics/tournament.h"
#include "simulate/contact/exact_bodies.h"
#include "std.h"

namespace carom {

class EventQueue {
  struct Before {
    const EventQueue* queue;
    bool operator()(uint32_t i, uint32_t j) const { return queue->before(i, j); }
  };

 public:
  using Due = Tournament<Before>::Due;

  explicit EventQueue(const ExactBodies& bodies)
      : bodies_(bodies), queue_(uint32_t(bodies.body.size()), Before{this}) {}

  Entity first() const { return queue_.first(); }
  double first_time() const { return queue_.first_time(); }  // s; infinite: there is none
  /// Impacts that rounding may separate by no more than this (s) are close (tournament.h).
  void set_close(double span) { queue_.set_close(span); }
  bool close_at(double time) { return queue_.close_at(time); }
  /// Whether body i leaves its region before its event.
  bool leaves_first(Entity i) const { return queue_.time(i) < bodies_.body[i].event.time.hi; }

  /// Registers a change of body i's event. leave_time: when it leaves its region (s). Nothing after the duration is
  /// scheduled.
  void schedule(Entity i, double leave_time) {
    const double next = min(bodies_.body[i].event.time.hi, leave_time);
    queue_.update(i, next <= bodies_.options.duration ? next : never);
  }
  void remove(Entity i) { queue_.update(i, never); }

  /// Appends bodies with events up to `until` (s), in no order and not all of them (tournament.h).
  void due_until(double until, vector<Due>& due) const { queue_.due_until(until, due); }
  void prefetch(Entity i) const { queue_.prefetch(i); }

  void keep(auto& archive) { archive(queue_); }

 private:
  bool before(Entity i, Entity j) const;

  const ExactBodies& bodies_;
  Tournament<Before> queue_;
};

/// The order of two bodies with events at the same time, up to the second double of the clock.
inline bool EventQueue::before(Entity i, Entity j) const {
  const bool leaves_i = leaves_first(i), leaves_j = leaves_first(j);
  if (leaves_i || leaves_j) return leaves_i && (!leaves_j || i < j);
  const ExactEvent &p = bodies_.body[i].event, &q = bodies_.body[j].event;
  if (p.time < q.time) return true;
  if (q.time < p.time) return false;
  if (p.kind != q.kind) return p.kind < q.kind;
  // A string has one event for both of its bodies. They come in the order of strings.
  if (p.kind == ExactEvent::Kind::string && p.partner != q.partner) return p.partner < q.partner;
  const Entity pa = min(i, p.partner), qa = min(j, q.partner);
  if (pa != qa) return pa < qa;
  return max(i, p.partner) < max(j, q.partner);
}

}  // namespace carom
