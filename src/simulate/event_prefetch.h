#pragma once
// Where there are more bodies than a processor's own memory holds, an event waits for memory a dozen times on end, each
// time for what says where to look next. What is due soon is asked for ahead of its time, step by step.
#include <vector>

#include "simulate/event_queue.h"

namespace carom {

class EventPrefetch {
 public:
  EventPrefetch(const ExactBodies& bodies, const EventQueue& queue) : bodies_(bodies), queue_(queue) {}

  /// Call before each event. Changes no result.
  void look_ahead();

 private:
  void find_due(double now);
  Entity due_in(std::size_t steps) const;
  Entity partner_of(Entity i) const;
  void prefetch_body(Entity i) const;
  void prefetch_flights(Entity i) const;

  const ExactBodies& bodies_;
  const EventQueue& queue_;
  std::vector<EventQueue::Due> due_;      // what was due next when it was last asked for, in order
  std::size_t next_ = 0;                  // in due_
  std::size_t events_ = ~std::size_t{0};  // since then; at first: it was never asked for
  double from_ = 0, reach_ = 0;           // s: when it was asked for, and how far ahead
};

}  // namespace carom
