#include <algorithm>
#include <cmath>
#include <iterator>

#include "physics/contact_time.h"
#include "physics/force.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

/// At least |v|.
double sum_of_speeds(const Vec3& v) {
  return v.cwiseAbs().sum();
}

}  // namespace

/// Finds body i's next event among its neighbours. Other bodies' events stay as they are: a pair's collision stands
/// with whichever of the two was predicted last, or with neither while one of them is taken before.
void ExactSimulator::predict(Entity i) {
  if (neighbours_.bodies(i).size() > 128 && neighbours_.room(i) > 0.05 * world_.radius[i])
    neighbours_.shrink(i, flight_[i].position(now_ - flight_[i].start));
  predict_among(i, neighbours_.bodies(i));
}

/// The same for all bodies at once. A pair is asked once, by the higher number; nobody asks for two that fall alike
/// from rest.
void ExactSimulator::predict_all() {
  std::vector<Entity> others;
  const auto together = [&](Entity i, Entity j) {
    const Flights::Core* const f = flight_.cores();
    return f[i].v.isZero(0) && f[j].v.isZero(0) && flight_.acceleration(i) == flight_.acceleration(j);
  };
  for (Entity i = 0; i < world_.body_count(); ++i) {
    if (!crowd_.empty()) {
      predict(i);
      continue;
    }
    others.clear();
    std::ranges::copy_if(neighbours_.bodies(i), std::back_inserter(others),
                         [&](Entity j) { return j < i && !together(i, j); });
    predict_among(i, others);
  }
}

/// The first of what may happen to body i with these bodies, with surfaces and by itself.
void ExactSimulator::predict_among(Entity i, std::span<const Entity> bodies) {
  Event best;
  meet_bodies(i, bodies, best);
  meet_each(i, neighbours_.surfaces(i), best);
  for (std::size_t k = 0; k < contacts_[i].count; ++k) {
    const Contact& contact = contacts_[i].at[k];
    if (contact.settling) offer(i, best, {contact.rest_time, contact.surface, 0, Kind::rest, contact.feature});
    if (world_.is_plane(contact.surface)) continue;
    const Flight& f = flight_[i];
    RelativeMotion m{world_.fixed_position(contact.surface) - f.x, -f.v, -f.a, sum_of_speeds(f.v), true};
    const Meeting rim =
        leave_feature(world_, i, contact.surface, contact.feature, m, Instant{options_.duration, 0} - f.start);
    if (rim.time < never) offer(i, best, {f.start + rim.time, contact.surface, 0, Kind::release, rim.feature});
  }
  if (!world_.forces.empty()) offer(i, best, {{next_force(i), 0}, no_entity, 0, Kind::force, no_feature});
  if (body_[i].place == Place::crowd) offer(i, best, {crowd_end_, no_entity, 0, Kind::step, no_feature});
  body_[i].event = best;
  enqueue(i);
}

/// Offers when body i meets each of the others.
void ExactSimulator::meet_each(Entity i, std::span<const Entity> others, Event& best) {
  const bool follows = body_[i].place == Place::crowd && following_;
  for (Entity e : others) {
    if (follows && followed(i, e)) continue;
    std::uint8_t feature = no_feature;
    if (world_.is_body(e)) {
      feature = 0;
      ++effort_.pair_tests;
      const Instant time = pair_time(i, e, feature);
      offer(i, best, {time, e, body_[e].version, Kind::body_body, feature});
    } else if (!in_contact(i, e)) {
      ++effort_.surface_tests;
      const Instant time = fixed_time(i, e, feature);
      offer(i, best, {time, e, 0, Kind::body_fixed, feature});
    }
  }
}

/// The same of bodies, many at a time where all are balls and fall alike.
void ExactSimulator::meet_bodies(Entity i, std::span<const Entity> others, Event& best) {
  if (!world_.volume.empty() || body_[i].place == Place::crowd) return meet_each(i, others, best);
  const Vec3& a = flight_.acceleration(i);
  if (!crowd_.empty() || !flight_.alike()) {
    alike_.clear();
    for (const Entity& e : others)
      if (body_[e].place == Place::crowd || flight_.acceleration(e) != a)
        meet_each(i, {&e, 1}, best);
      else
        alike_.push_back(e);
    others = alike_;
  }
  if (meets_.size() < others.size()) meets_.resize(2 * others.size());
  const bool latest = flight_.cores()[i].start == now_;
  effort_.pair_tests += others.size();
  const double* const radius = same_radius_ ? nullptr : world_.radius.data();
  std::size_t count = straight_times(
      {flight_.cores(), radius, world_.radius[i], i, others, a, latest, options_.duration}, meets_.data());
  for (Meet& meet : std::span(meets_.data(), count)) {
    std::uint8_t feature = 0;
    if (meet.time.hi == unsure) meet.time = pair_time(i, meet.with, feature);
  }
  // The earliest that the other one is free for: before it, what comes first has it look for body i itself.
  while (count > 0) {
    std::size_t first = 0;
    for (std::size_t k = 1; k < count; ++k)
      if (meets_[k].time < meets_[first].time) first = k;
    const Meet& meet = meets_[first];
    if (best.time.hi < meet.time.hi) return;
    const Event& other = body_[meet.with].event;
    const bool taken = other.kind == Kind::body_body && other.time.hi < meet.time.hi && now_.hi < other.time.hi;
    if (!taken) offer(i, best, {meet.time, meet.with, body_[meet.with].version, Kind::body_body, 0});
    meets_[first] = meets_[--count];
  }
}

/// Whom body i may meet in its region, and what, ascending: what is summed up in this order is the same for any lists.
std::vector<Entity> ExactSimulator::known_to(Entity i) const {
  const std::span<const Entity> near = neighbours_.near(i);
  std::vector<Entity> known(near.begin(), near.end());
  std::sort(known.begin(), known.end());
  return known;
}

/// Keeps the earlier of two events of body i, by the total order.
void ExactSimulator::offer(Entity i, Event& best, Event candidate) const {
  if (!(candidate.time.hi <= options_.duration)) return;
  if (candidate.time < now_) candidate.time = now_;  // by rounding only
  if (best.time < candidate.time) return;
  if (candidate.time == best.time) {
    if (best.kind < candidate.kind) return;
    if (best.kind == candidate.kind) {
      const auto key = [i](const Event& e) { return std::pair(std::min(i, e.partner), std::max(i, e.partner)); };
      if (key(best) < key(candidate)) return;
    }
  }
  best = candidate;
}

/// When a force on body i, or on a part of it, next sets in or ceases.
double ExactSimulator::next_force(Entity i) const {
  if (parts_.empty() || parts_[i].empty()) return next_switch(world_, i, now_.hi);
  double next = never;
  for (Entity part : parts_[i]) next = std::min(next, next_switch(world_, part, now_.hi));
  return next;
}

/// When bodies i and j collide: reckoned from the later of their own clocks, lower number first.
Instant ExactSimulator::pair_time(Entity i, Entity j, std::uint8_t& feature) const {
  const Entity a = std::min(i, j), b = std::max(i, j);
  const Flight &p = flight_[a], &q = flight_[b];
  const bool p_earlier = p.start < q.start;
  const Instant base = p_earlier ? q.start : p.start;
  const double tp = base - p.start, tq = base - q.start;  // one of them is zero
  RelativeMotion m;
  m.w = q.velocity(tq) - p.velocity(tp);
  m.d = q.position(tq) - p.position(tp);
  m.a = q.a - p.a;
  const bool balls = world_.volume.empty();
  if (balls && m.a.isZero(0) && m.d.dot(m.w) >= 0) return {never, 0};
  m.speeds = sum_of_speeds(p.v) + sum_of_speeds(q.v) + sum_of_speeds(tp * p.a) + sum_of_speeds(tq * q.a);
  m.just_separated = p.start == q.start && body_[a].origin == b && body_[b].origin == a;
  // A flight of the crowd lasts until its next step.
  const bool step = (body_[a].place == Place::crowd || body_[b].place == Place::crowd);
  const double horizon =
      (step && crowd_end_.hi < options_.duration ? crowd_end_ : Instant{options_.duration, 0}) - base;
  const double s = world_.radius[a] + world_.radius[b];
  if (step) {
    m.speeds += 512 * std::sqrt(std::max(pull_[a].norm(), pull_[b].norm()) * s);  // what steps round velocities by
    const double reach = s + horizon * (sum_of_speeds(m.w) + horizon * sum_of_speeds(m.a));
    if (m.d.squaredNorm() > reach * reach) return {never, 0};
  }
  double t;
  if (balls) {
    t = sphere_contact_time(m, s, horizon);
  } else {
    const Meeting first = meeting(world_, a, b, m, m.just_separated ? body_[a].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  }
  return t == never ? Instant{never, 0} : base + t;
}

/// When body i strikes a surface: reckoned from its flight's start.
Instant ExactSimulator::fixed_time(Entity i, Entity surface, std::uint8_t& feature) const {
  const Flight& f = flight_[i];
  const bool step = body_[i].place == Place::crowd && crowd_end_.hi < options_.duration;
  const double horizon = (step ? crowd_end_ : Instant{options_.duration, 0}) - f.start;
  const bool left = body_[i].origin == surface;
  double t;
  const bool ball = world_.volume.empty() || world_.volume[i].shape == Shape::sphere;
  const double steps = crowded(i) ? 512 * std::sqrt(pull_[i].norm() * world_.radius[i]) : 0;
  if (ball && world_.is_plane(surface)) {
    const Plane& plane = world_.plane(surface);
    const double noise = 0x1p-49 * (sum_of_speeds(f.v) + steps);
    t = plane_contact_time(plane_gap(f.x, plane.point, plane.normal, world_.radius[i]), plane.normal.dot(f.v),
                           plane.normal.dot(f.a), noise, left, horizon);
  } else if (ball && world_.is_wall(surface)) {
    const double reach = world_.radius[i] + horizon * (sum_of_speeds(f.v) + horizon * sum_of_speeds(f.a));
    if (step && (f.x - nearest_on_wall(world_.wall(surface), f.x)).squaredNorm() > reach * reach) return {never, 0};
    const WallContact contact = wall_contact_time(world_.wall(surface), f.x, f.v, f.a, world_.radius[i],
                                                  left ? body_[i].origin_feature : no_feature, horizon);
    t = contact.time;
    feature = contact.feature;
  } else {
    const RelativeMotion m{world_.fixed_position(surface) - f.x, -f.v, -f.a, sum_of_speeds(f.v) + steps, left};
    const Meeting first = meeting(world_, i, surface, m, left ? body_[i].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  }
  return t == never ? Instant{never, 0} : f.start + t;
}

/// A time (s) before which body i is surely within its region, or that is later than its event.
double ExactSimulator::leave_time(Entity i) const {
  const Flights::Core& f = flight_.cores()[i];
  const Vec3& a = flight_.acceleration(i);
  const double since = now_ - f.start, room = neighbours_.room(i);
  const Vec3 center = neighbours_.center(i);
  // From `since` on along a straight way, until it is `radius` away from the middle.
  const auto way_out = [](const Vec3& off, const Vec3& v, double radius) {
    const double speed2 = v.squaredNorm(), outward = off.dot(v), left = radius * radius - off.squaredNorm();
    if (!(left > 0)) return 0.0;
    const double root = std::sqrt(outward * outward + speed2 * left);
    return outward > 0 ? left / (root + outward) : speed2 > 0 ? (root - outward) / speed2 : never;
  };
  const auto start_of = [&](double t, Vec3& off, Vec3& v) {
    v = f.v + t * a;
    off = f.x + t * (f.v + (0.5 * t) * a) - center;
  };
  Vec3 off, v;
  start_of(since, off, v);
  double t = way_out(off, v, room);
  if (const double pull2 = a.squaredNorm(); pull2 > 0) {
    // As far as a straight way within what the acceleration does not take from the room until then, or by the greatest
    // possible haste; and on from there, while that leads on.
    const double pull = std::sqrt(pull2), end = body_[i].event.time.hi - now_.hi;
    const auto bound = [&](double straight) {
      const double narrowed = room - 0.5 * pull * straight * straight, left = room - off.norm();
      if (!(left > 0)) return 0.0;
      const double surely = 2 * left / (v.norm() + std::sqrt(v.squaredNorm() + 2 * pull * left));
      return narrowed > 0 ? std::max(surely, way_out(off, v, narrowed)) : surely;
    };
    const double straight = t;
    t = bound(straight);
    for (double step = t < 0.75 * straight ? t : 0; t < end && step > 0x1p-5 * t;) {
      start_of(since + t, off, v);
      step = bound(way_out(off, v, room));
      t += step;
    }
  }
  return (now_.hi + t) * (1 - 0x1p-52);  // rather too soon than too late
}

/// Body i leaves its region: a new one, and whom it may meet in that. One that leaves region after region on one and
/// the same flight tries wider ones: in company that flies along, they cost no more.
void ExactSimulator::rebuild_region(Entity i) {
  const Flight f = flight_[i];
  const double since = now_ - f.start, until = std::min(body_[i].event.time.hi, options_.duration);
  // Half way to what comes next, or to where what pulls has had its way with it.
  double half = 0.5 * std::max(until - now_.hi, 0.0);
  if (const double pull2 = f.a.squaredNorm(); pull2 > 0) {
    const Vec3 v = f.velocity(since);
    const double pull = std::sqrt(pull2);
    half = std::min(half, (v.norm() + std::sqrt(v.squaredNorm() + 2 * pull * neighbours_.room(i))) / pull);
  }
  const Vec3 ahead = half * (f.velocity(since) + (0.5 * half) * f.a), here = f.position(since);
  hold_to(bounds_, i, now_.hi, here, f.velocity(since), too_fast);
  const std::span<const Entity> came = neighbours_.renew(i, here, ahead);
  Event best = body_[i].event;
  meet_bodies(i, came, best);
  meet_each(i, neighbours_.surfaces(i), best);
  body_[i].event = best;
  enqueue(i);
}

}  // namespace carom
