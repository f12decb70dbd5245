// Predicts a body's next event: the first of all that may happen to it. Each body keeps one event only. A pair's
// collision may be found from either side. Both sides give the same bits, so that the order of predictions has no
// effect. Balls under equal accelerations, the common case, are tested several at a time (straight_times.h).
#include "simulate/loop/event_predictor.h"

#include <iterator>

#include "geometry/path_time_of_impact.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/mode_changes.h"
#include "simulate/contact/region_exit.h"
#include "simulate/loop/event_queue.h"
#include "std.h"

namespace carom {

EventPredictor::EventPredictor(ExactBodies& bodies, EventQueue& queue, const ModeChanges& modes,
                               const FlatContacts& flat, const ExactGroup& group)
    : bodies_(bodies),
      queue_(queue),
      modes_(modes),
      flat_(flat),
      group_(group),
      times_(bodies),
      plain_(!bodies.ties.any() && !bodies.forced && !bodies.moving.any()) {}

void EventPredictor::predict(Entity i) {
  if (bodies_.mode(i) == Mode::stepped) [[unlikely]]
    return predict_crowd(i);
  if (bodies_.neighbours.bodies(i).size() > 128 && bodies_.neighbours.room(i) > 0.05 * bodies_.world.radius[i])
    bodies_.neighbours.shrink(i, bodies_.position(i));
  predict_among(i, bodies_.neighbours.bodies(i));
}

/// Predicts the next step of body i's crowd, which the first of its members has. The others have no events, but for
/// strings that go taut.
void EventPredictor::predict_crowd(Entity i) {
  const Island& island = bodies_.islands.of(i);
  for (const Entity k : {i, island.members.front()}) {
    ExactEvent best;
    if (bodies_.ties.any()) offer_strings(k, best);
    if (k == island.members.front())
      offer(k, best, ExactEvent{island.end, no_entity, 0, no_feature, ExactEvent::Kind::step});
    bodies_.body[k].event = best;
    queue_.schedule(k, never);
  }
}

/// Lets the crowds near body i, which has a new path or a new region, look whether it comes near.
void EventPredictor::be_watched(Entity i) {
  for (const Entity e : bodies_.neighbours.bodies(i))
    if (bodies_.mode(e) == Mode::stepped) {
      vector<Entity>& watched = bodies_.islands.of(e).watched;
      if (watched.empty() || watched.back() != i) watched.push_back(i);
    }
}

void EventPredictor::predict_all() {
  vector<Entity> others;

  // Never on curves, which may part later: their fade equals nothing.
  const auto together = [&](Entity i, Entity j) {
    const Flights::Core* const f = bodies_.flights.cores();
    return f[i].v.isZero(0) && f[j].v.isZero(0) && bodies_.flights.acceleration(i) == bodies_.flights.acceleration(j) &&
           bodies_.flights.fade(i) == bodies_.flights.fade(j);
  };

  for (Entity i = 0; i < bodies_.world.body_count(); ++i) {
    if (!is_in_world(bodies_.mode(i))) continue;
    if (bodies_.islands.any()) {
      predict(i);
      continue;
    }

    others.clear();
    ranges::copy_if(bodies_.neighbours.bodies(i), std::back_inserter(others),
                    [&](Entity j) { return j < i && !together(i, j); });
    predict_among(i, others);
  }
}

/// Predicts the first event of body i with these bodies, with surfaces and by itself.
void EventPredictor::predict_among(Entity i, span<const Entity> bodies) {
  ExactEvent best;
  meet_each(i, bodies_.neighbours.surfaces(i), best);
  meet_bodies(i, bodies, best);
  if (lies_on_flat(bodies_.mode(i))) offer_flat_contacts(i, best);
  if (!plain_) offer_beside_contacts(i, best);
  if (is_member(bodies_.mode(i)) || bodies_.flights.curve(i) != nullptr)
    offer(i, best, ExactEvent{bodies_.flight_end(i), no_entity, 0, no_feature, ExactEvent::Kind::step});
  bodies_.body[i].event = best;
  queue_.schedule(i, region_exit(bodies_, i));
  if (bodies_.islands.any()) be_watched(i);
}

/// Offers what neither a contact nor a region is: strings, and switches of forces.
void EventPredictor::offer_beside_contacts(Entity i, ExactEvent& best) {
  if (bodies_.ties.any()) offer_strings(i, best);
  if (bodies_.forced)
    offer(i, best,
          ExactEvent{
              {bodies_.next_switch(i, bodies_.now.floor()), 0}, no_entity, 0, no_feature, ExactEvent::Kind::force});
}

/// Offers the instants at which strings of body i go taut. Those that constrained motion holds, and rods, do not.
void EventPredictor::offer_strings(Entity i, ExactEvent& best) {
  const bool constrained = bodies_.mode(i) == Mode::held;
  for (const Entity string : bodies_.ties.of(i)) {
    if (bodies_.world.string(string).rod || (constrained && modes_.are_partners(i, string))) continue;
    ++surface_tests_;
    const Entity other = bodies_.ties.other(string, i);
    const uint16_t version = other == no_entity ? uint16_t{0} : bodies_.body[other].version;
    offer(i, best, ExactEvent{times_.of_string(string), string, version, 0, ExactEvent::Kind::string});
  }
}

/// Offers the end of bounces on flat surfaces, and the instant at which body i slides off them.
void EventPredictor::offer_flat_contacts(Entity i, ExactEvent& best) const {
  for (size_t k = 0; k < flat_.of(i).count; ++k) {
    const FlatContact& contact = flat_.of(i).at[k];
    if (contact.settling)
      offer(i, best, ExactEvent{contact.rest_time, contact.surface, 0, contact.feature, ExactEvent::Kind::rest});
    if (bodies_.world.is_plane(contact.surface)) continue;

    const Flight& f = bodies_.flights[i];
    const FadingPath fixed = flat_.path_of(contact.surface, f.start);
    const FeatureTime rim = leave_feature(bodies_.world, i, f.path(), contact.surface, fixed, contact.feature,
                                          Instant{bodies_.options.duration, 0} - f.start);
    if (rim.time < never)
      offer(i, best, ExactEvent{f.start + rim.time, contact.surface, 0, rim.feature, ExactEvent::Kind::release});
  }
}

/// Offers the collisions of body i with each of the others.
void EventPredictor::meet_each(Entity i, span<const Entity> others, ExactEvent& best) {
  const bool constrained = bodies_.mode(i) == Mode::held;
  const bool carried = lies_on_flat(bodies_.mode(i));

  for (const Entity e : others) {
    // Partners cannot meet.
    if (constrained && modes_.are_partners(i, e)) {
      offer_switch(i, e, best);
      continue;
    }

    uint8_t feature = no_feature;
    if (bodies_.world.is_body(e)) {
      feature = 0;
      ++pair_tests_;
      const Instant time = times_.of_pair(i, e, feature, latest_tie(best));
      offer(i, best, ExactEvent{time, e, bodies_.body[e].version, feature, ExactEvent::Kind::body_body});

      // Fixed things.
    } else if (bodies_.moving.any() && bodies_.world.moves(e)) [[unlikely]] {
      meet_moving(i, e, best);
    } else if (!(carried && (flat_.carries(i, e) || flat_.hides(i, e))) && !(constrained && group_.hides(i, e))) {
      ++surface_tests_;
      const Instant time = times_.of_surface(i, e, feature);
      offer(i, best, ExactEvent{time, e, 0, feature, ExactEvent::Kind::body_fixed});
    }
  }
}

/// The same for a fixed thing that moves. Its present leg alone counts, and what comes after is predicted where it
/// ends.
void EventPredictor::meet_moving(Entity i, Entity thing, ExactEvent& best) {
  offer_switch(i, thing, best);
  if (lies_on_flat(bodies_.mode(i)) && (flat_.carries(i, thing) || flat_.hides(i, thing))) return;
  if (bodies_.mode(i) == Mode::held && group_.hides(i, thing)) return;
  ++surface_tests_;
  uint8_t feature = no_feature;
  const Instant time = times_.of_moving(i, thing, feature, latest_exit(i));
  offer(i, best, ExactEvent{time, thing, 0, feature, ExactEvent::Kind::body_fixed});
}

/// The latest time (s) at which body i leaves its region, whatever its event is. Its events are predicted anew then.
double EventPredictor::latest_exit(Entity i) {
  const ExactEvent kept = exchange(bodies_.body[i].event, ExactEvent{});
  const double exit = region_exit(bodies_, i);
  bodies_.body[i].event = kept;
  return exit;
}

/// Offers the next instant at which the velocity of a thing near body i jumps.
void EventPredictor::offer_switch(Entity i, Entity thing, ExactEvent& best) const {
  if (bodies_.world.moves(thing))
    offer(
        i, best,
        ExactEvent{bodies_.moving.next_switch(thing, bodies_.now), no_entity, 0, no_feature, ExactEvent::Kind::force});
}

/// The same for bodies. Where all are balls with equal accelerations, several are tested at a time.
void EventPredictor::meet_bodies(Entity i, span<const Entity> others, ExactEvent& best) {
  if (!bodies_.world.volume.empty() || is_member(bodies_.mode(i)) || bodies_.flights.fade(i) != 0)
    return meet_each(i, others, best);

  const Vec3& a = bodies_.flights.acceleration(i);

  if (!bodies_.islands.any() && bodies_.flights.alike() && !bodies_.flights.any_fades())
    return meet_alike(i, others, best);

  // Bodies that move in another way are tested one at a time.
  alike_.clear();
  unlike_.clear();
  for (const Entity e : others) {
    const bool unlike =
        is_member(bodies_.mode(e)) || bodies_.flights.acceleration(e) != a || bodies_.flights.fade(e) != 0;
    (unlike ? unlike_ : alike_).push_back(e);
  }
  meet_alike(i, alike_, best);
  meet_each(i, unlike_, best);
}

/// The same for balls with equal accelerations.
void EventPredictor::meet_alike(Entity i, span<const Entity> others, ExactEvent& best) {
  if (meets_.size() < others.size()) meets_.resize(2 * others.size());
  const bool latest = bodies_.flights.cores()[i].start == bodies_.now;
  pair_tests_ += others.size();
  const double* const radius = bodies_.same_radius ? nullptr : bodies_.world.radius.data();
  size_t count = straight_times({bodies_.flights.cores(), radius, bodies_.world.radius[i], i, others,
                                 bodies_.flights.acceleration(i), latest, bodies_.options.duration},
                                meets_.data());

  // Pairs that touch or graze need a test of their own.
  for (Meet& meet : span(meets_.data(), count)) {
    uint8_t feature = 0;
    if (meet.time.hi == unsure) meet.time = times_.of_pair(i, meet.with, feature);
  }

  // The earliest collision for which the other body is free. If that body has an event before, it then predicts its
  // collision with body i anew.
  while (count > 0) {
    size_t first = 0;
    for (size_t k = 1; k < count; ++k)
      if (meets_[k].time < meets_[first].time) first = k;
    const Meet& meet = meets_[first];
    if (best.time.hi < meet.time.hi) {
      if (is_tie(best, meet.time) && best.partner != meet.with) best.tied = true;
      return;
    }

    ExactEvent& other = bodies_.body[meet.with].event;
    const bool taken =
        other.kind == ExactEvent::Kind::body_body && other.time.hi < meet.time.hi && bodies_.now.hi < other.time.hi;
    if (taken && is_tie(other, meet.time) && other.partner != i) other.tied = true;
    if (!taken)
      offer(i, best, ExactEvent{meet.time, meet.with, bodies_.body[meet.with].version, 0, ExactEvent::Kind::body_body});
    meets_[first] = meets_[--count];
  }
}

/// Whether an event and another impact, at a later time, may fall on one instant. Rounding makes their difference a
/// small share of the time until then. Where that is itself rounding, both are at present.
inline bool EventPredictor::is_tie(const ExactEvent& first, const Instant& later) const {
  return later.hi <= latest_tie(first);
}

/// The latest time of an impact that may fall on one instant with this event (s).
inline double EventPredictor::latest_tie(const ExactEvent& first) const {
  using namespace exact_tolerance;
  return (1 + tie_of_flight) * first.time.hi + (tie_of_clock - tie_of_flight) * bodies_.now.hi;
}

/// Keeps the earlier of two events of body i, by the total order.
inline void EventPredictor::offer(Entity i, ExactEvent& best, ExactEvent candidate) const {
  if (!(candidate.time.hi <= bodies_.options.duration)) return;

  // This happens by rounding only.
  if (candidate.time < bodies_.now) candidate.time = bodies_.now;
  const bool other = candidate.partner != best.partner && ExactEvent::is_impact(candidate.kind);
  if (best.time < candidate.time) {
    if (is_tie(best, candidate.time) && other) best.tied = true;
    return;
  }
  if (is_tie(candidate, best.time) && other && ExactEvent::is_impact(best.kind)) best.tied = candidate.tied = true;

  // At one instant the kind decides, then the numbers of the bodies.
  if (candidate.time == best.time) {
    if (best.kind < candidate.kind) return;
    if (best.kind == candidate.kind) {
      // A string has one event for both of its bodies.
      const auto key = [i](const ExactEvent& e) {
        const Entity body = e.kind == ExactEvent::Kind::string ? e.partner : i;
        return pair(min(body, e.partner), max(body, e.partner));
      };
      if (key(best) < key(candidate)) return;
    }
  }

  best = candidate;
}

void EventPredictor::renew_region(Entity i) {
  const span<const Entity> came = carom::renew_region(bodies_, i, bodies_.body[i].event.time.hi);
  ExactEvent best = bodies_.body[i].event;
  meet_each(i, bodies_.neighbours.surfaces(i), best);
  meet_bodies(i, came, best);
  bodies_.body[i].event = best;
  queue_.schedule(i, region_exit(bodies_, i));
  if (bodies_.islands.any()) be_watched(i);
}

}  // namespace carom
