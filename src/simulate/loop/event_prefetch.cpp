// Prefetches memory for the events that are due soon. The queue gives an estimate of the next events, and each is
// prefetched in four steps. Each step loads the addresses that the next one follows. The results of the simulation do
// not depend on it.
#include "simulate/loop/event_prefetch.h"

#include "numerics/prefetch.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

constexpr size_t far_ahead = 32;      // events
constexpr size_t events_of_step = 2;  // from one step to the next

}  // namespace

/// Finds the events due within the time that so many events took before, or within a longer one.
void EventPrefetch::find_due(double now) {
  const auto earlier = [](const auto& p, const auto& q) { return p.time < q.time; };
  if (!due_.empty()) reach_ = (now - from_) * double(far_ahead) / double(events_);
  from_ = now;
  events_ = 0;
  next_ = 0;

  // The time is extended, a few times at most, until enough events are due in it.
  for (int attempt = 0; attempt < 8; ++attempt) {
    due_.clear();
    queue_.due_until(now + reach_, due_);
    if (due_.size() >= far_ahead) break;
    reach_ = 2 * reach_ + 0x1p-40 * now;
  }

  // Of many events only the earliest are kept.
  if (due_.size() > 4 * far_ahead) {
    std::nth_element(due_.begin(), due_.begin() + 4 * far_ahead, due_.end(), earlier);
    due_.resize(4 * far_ahead);
  }

  ranges::sort(due_, earlier);
}

Entity EventPrefetch::due_in(size_t steps) const {
  const size_t k = next_ + steps * events_of_step;
  return k < due_.size() ? due_[k].entry : no_entity;
}

/// The partner of body i's event, or i.
Entity EventPrefetch::partner_of(Entity i) const {
  const ExactEvent& event = bodies_.body[i].event;
  return event.kind == ExactEvent::Kind::body_body && !queue_.leaves_first(i) ? event.partner : i;
}

void EventPrefetch::prefetch_body(Entity i) const {
  prefetch(&bodies_.body[i]);
  prefetch(bodies_.flights.cores() + i);
  bodies_.neighbours.prefetch_header(i);
  bodies_.neighbours.prefetch_region(i);
  queue_.prefetch(i);
  prefetch(&bodies_.world.radius[i]);
  prefetch(&bodies_.world.mass[i]);
  prefetch(&bodies_.world.restitution[i]);
}

void EventPrefetch::prefetch_flights(Entity i) const {
  for (const Entity j : bodies_.neighbours.bodies(i)) {
    prefetch(bodies_.flights.cores() + j);
    if (!bodies_.same_radius) prefetch(&bodies_.world.radius[j]);
    prefetch(&bodies_.body[j]);
  }
}

void EventPrefetch::look_ahead() {
  const double now = queue_.first_time();
  while (next_ < due_.size() && due_[next_].time <= now) ++next_;

  // The search is repeated after many events only. Where few are due at all, it never finds that many.
  if (events_ >= far_ahead / 2 && next_ + far_ahead / 2 >= due_.size()) find_due(now);
  ++events_;

  // One step for each of the events that are four, three, two and one steps ahead.
  if (const Entity i = due_in(4); i != no_entity) prefetch_body(i);
  if (const Entity i = due_in(3); i != no_entity) {
    bodies_.neighbours.prefetch_list(i);
    prefetch_body(partner_of(i));
  }

  if (const Entity i = due_in(2); i != no_entity) {
    if (queue_.leaves_first(i)) {
      for (const Entity k : bodies_.neighbours.bodies(i)) {
        bodies_.neighbours.prefetch_region(k);
        bodies_.neighbours.prefetch_header(k);
      }
    } else {
      prefetch_flights(i);
      bodies_.neighbours.prefetch_list(partner_of(i));
    }
  }

  if (const Entity i = due_in(1); i != no_entity && partner_of(i) != i) prefetch_flights(partner_of(i));
}

}  // namespace carom
