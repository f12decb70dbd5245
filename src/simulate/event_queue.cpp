// The total order of events of one instant: kind first, then the lower and the higher number of the bodies concerned.
// Time alone would leave ties to chance, and a run's bits would depend on the queue's structure.
#include "simulate/event_queue.h"

#include <algorithm>

namespace carom {

/// The order of two bodies with events at the same time, up to the second double of the clock.
bool EventQueue::before(Entity i, Entity j) const {
  const bool leaves_i = leaves_first(i), leaves_j = leaves_first(j);
  if (leaves_i || leaves_j) return leaves_i && (!leaves_j || i < j);
  const ExactEvent &p = bodies_.body[i].event, &q = bodies_.body[j].event;
  if (p.time < q.time) return true;
  if (q.time < p.time) return false;
  if (p.kind != q.kind) return p.kind < q.kind;
  const Entity pa = std::min(i, p.partner), qa = std::min(j, q.partner);
  if (pa != qa) return pa < qa;
  return std::max(i, p.partner) < std::max(j, q.partner);
}

}  // namespace carom
