#pragma once
// Prefetching for events. With more bodies than the processor's caches hold, an event waits for memory a dozen times in
// a row. Each wait is for an address that leads to the next. Memory for events due soon is therefore prefetched step by
// step.

#include "simulate/loop/event_queue.h"
#include "std.h"

namespace carom {

class EventPrefetch {
 public:
  EventPrefetch(const ExactBodies& bodies, const EventQueue& queue) : bodies_(bodies), queue_(queue) {}

  /// Call before each event. Changes no result.
  void look_ahead();

 private:
  void find_due(double now);
  Entity due_in(size_t steps) const;
  Entity partner_of(Entity i) const;
  void prefetch_body(Entity i) const;
  void prefetch_flights(Entity i) const;

  const ExactBodies& bodies_;
  const EventQueue& queue_;
  vector<EventQueue::Due> due_;  // events due next at the last search, in order
  size_t next_ = 0;              // index in due_
  size_t events_ = ~size_t{0};   // since that search; at first: there was none
  double from_ = 0, reach_ = 0;  // s: time of that search, and its range
};

}  // namespace carom
