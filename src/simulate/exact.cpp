#include "simulate/exact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "physics/complementarity.h"
#include "physics/force.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr std::size_t of_an_event = 8;  // collisions that one event may bring, as a rule
constexpr std::uint32_t events_at_a_time = 65536;
constexpr Entity cached_bodies = 24576;  // that fit into a processor's own memory

}  // namespace

std::unique_ptr<Simulator> make_exact_simulator(const World& world, const State& initial, const ExactOptions& options) {
  return std::make_unique<ExactSimulator>(world, initial, options);
}

ExactSimulator::ExactSimulator(const World& world, const State& initial, const ExactOptions& options)
    : given_(&world),
      joint_world_(options.merge ? std::make_unique<World>(world) : nullptr),
      world_(options.merge ? *joint_world_ : world),
      options_(options),
      bounds_(bounds_of(world)),
      same_radius_(!options.merge && std::adjacent_find(world.radius.begin(), world.radius.end(),
                                                        std::not_equal_to{}) == world.radius.end()),
      pull_(world.body_count(), world.gravity),
      driven_(world.body_count(), Vec3::Zero()),
      flight_(world.body_count(), world.gravity),
      body_(world.body_count()),
      neighbours_(world_),
      contacts_(world.body_count()),
      burst_(world.body_count()),
      collapse_(world.body_count()),
      queue_(world.body_count(), Before{this}),
      pressed_(world.body_count()),
      local_(world.body_count(), PressedPair::none),
      pulled_(world.body_count()),
      jostled_(world.body_count()),
      idle_(world.body_count()),
      hastened_(world.body_count(), Vec3::Zero()),
      kept_apart_(world.body_count()),
      carried_(world.body_count()),
      needed_(world.body_count()),
      followed_(world.body_count()),
      arrival_(world.body_count(), Vec3::Zero()),
      arrival_version_(world.body_count()),
      log_(options.max_collisions, options.record_collisions) {
  start(initial);
}

void ExactSimulator::start(const State& initial) {
  const Entity n = world_.body_count();
  for (Entity i = 0; i < n; ++i) {
    Vec3 v = initial.velocity[i];
    if (!world_.impulse.empty()) v += world_.impulse[i] / world_.mass[i];
    if (!world_.forces.empty()) {
      const Pull pull = pull_on(i);
      pull_.write(i) = pull.all;
      driven_.write(i) = pull.working;
    }
    flight_.set(i, {{}, initial.position[i], v, pull_[i]});
    log_.note_speed(v.norm());
  }
  neighbours_.start(initial.position);
  if (!options_.merge) {
    for (Entity i = 0; i < n; ++i)
      if (!pull_[i].isZero(0)) touch_down(i);
    // Where nothing pulls, nothing presses.
    if (!(world_.gravity.isZero(0) && world_.forces.empty()))
      for (Entity i = 0; i < n; ++i) lean_together(i);
  }
  predict_all();
  if (!crowd_.empty()) step_crowd();
  if (options_.record_paths) {
    for (Entity i = 0; i < n; ++i) note_path(i);
    record_paths();
  }
}

/// Of events at the same time, but for what the clock's second double tells: their total order, time, kind, the lower
/// and the higher number of those concerned. Who leaves a region comes first, for there is no physics in it.
bool ExactSimulator::before(Entity i, Entity j) const {
  const bool leaves_i = leaves_first(i), leaves_j = leaves_first(j);
  if (leaves_i || leaves_j) return leaves_i && (!leaves_j || i < j);
  const Event &p = body_[i].event, &q = body_[j].event;
  if (p.time < q.time) return true;
  if (q.time < p.time) return false;
  if (p.kind != q.kind) return p.kind < q.kind;
  const Entity pa = std::min(i, p.partner), qa = std::min(j, q.partner);
  if (pa != qa) return pa < qa;
  return std::max(i, p.partner) < std::max(j, q.partner);
}

void ExactSimulator::advance_to(double time) {
  log_.begin_advance();
  paths_.clear();
  full_ = false;
  state_fresh_ = false;
  const Instant until{std::min(time, options_.duration), 0};
  std::uint32_t events = 0;
  while (queue_.first_time() <= until.hi) {
    const Entity i = queue_.first();
    if (world_.body_count() > cached_bodies) look_ahead();
    if (leaves_first(i)) {
      if (now_.hi < queue_.first_time()) now_ = {queue_.first_time(), 0};
      ++effort_.events;
      ++effort_.regions;
      rebuild_region(i);
      neighbours_.tidy();
      check_limits(Kind::none);
    } else if (body_[i].event.time <= until) {
      ++effort_.events;
      process(i);
    } else {
      break;
    }
    // After many events that no one has seen, the caller may want to look at the clock.
    if (++events % events_at_a_time == 0 && std::nextafter(now_.hi, 0) > time_) {
      time_ = std::nextafter(now_.hi, 0);
      return;
    }
    // A full buffer: stop short of the instant reached, for more may happen in it.
    if (full_ || !log_.has_room(of_an_event)) {
      time_ = std::max(time_, std::nextafter(now_.hi, 0));
      return;
    }
  }
  if (options_.record_paths) record_paths();
  time_ = std::max(time, time_);
}

void ExactSimulator::process(Entity i) {
  const Event event = body_[i].event;
  neighbours_.prefetch_list(i);
  if (event.kind == Kind::body_body) neighbours_.prefetch_list(event.partner);
  if (now_ < event.time) now_ = event.time;
  switch (event.kind) {
    case Kind::body_body:
      if (body_[event.partner].version == event.partner_version)
        collide_pair(std::min(i, event.partner), std::max(i, event.partner), event.feature);
      else
        predict(i);  // the other one has changed its path since
      break;
    case Kind::body_fixed:
      collide_fixed(i, event.partner, event.feature);
      break;
    case Kind::force:
      switch_forces(i);
      break;
    case Kind::rest:
      finish_rest(i);
      break;
    case Kind::release:
      release(i, event.partner, event.feature);
      break;
    case Kind::step:
      if (event.time == crowd_end_)
        step_crowd();
      else
        predict(i);  // there has been a step since
      break;
    case Kind::none:
      break;
  }
  check_limits(event.kind);
}

/// Begins a new flight of body i, here and now.
void ExactSimulator::restart(Entity i, const Vec3& x, const Vec3& v, Origin origin) {
  path_changes(i);
  const double speed = v.norm();
  hold_to(bounds_, i, now_.hi, x, v, too_fast);
  log_.note_speed(speed);
  book_flight(i, x);
  const bool flies =
      body_[i].place == Place::crowd && !following_ && flight_.acceleration(i) != Vec3::Zero();  // through a stride
  const double negligible = negligible_speed();
  const bool still =
      speed <= negligible || (contacts_[i].count > 0 && speed * speed < 0x1p-120 * pull_[i].norm() * world_.radius[i]);
  Vec3 kept = v;
  for (int k = 0; k < 3; ++k)
    if (still || std::abs(v[k]) <= negligible) kept[k] = 0;
  flight_.set(i, {now_, x, kept, flies ? pull_[i] : contact_acceleration(i)});
  body_[i].set_origin(origin);
  neighbours_.turned(i);
  new_version(i);
  if (following_ && body_[i].place == Place::crowd && now_ < crowd_end_) crowd_end_ = now_;
}

/// Events with body i are stale from now on. When its count of flights begins anew, old ones must not look fresh.
void ExactSimulator::new_version(Entity i) {
  if (++body_[i].version != 0) return;
  body_[i].version = 1;
  for (Body& body : body_)
    if (body.event.kind == Kind::body_body && body.event.partner == i) body.event.partner_version = 0;
}

/// Books what forces did to body i on the flight that ends at x (m): the World's, and those that held it against them.
void ExactSimulator::book_flight(Entity i, const Vec3& x) {
  if (flight_.acceleration(i) == world_.gravity && world_.forces.empty()) return;
  const Vec3 way = x - flight_[i].x;
  log_.lose(world_.mass[i] * (pull_[i] - flight_[i].a).dot(way));
  if (world_.forces.empty()) return;
  log_.add_work(world_.mass[i] * driven_[i].dot(way));
}

/// What the forces do to body i, or to the parts that it is made of, from now on.
ExactSimulator::Pull ExactSimulator::pull_on(Entity i) const {
  const Vec3 any = Vec3::Zero();  // where and how fast it is makes no difference
  const auto on = [&](const World& world, Entity body) {
    return Pull{carom::free_acceleration(world, body, now_.hi, any, any),
                working_acceleration(world, body, now_.hi, any, any)};
  };
  if (parts_.empty() || parts_[i].empty()) return on(world_, i);
  Pull sum{Vec3::Zero(), Vec3::Zero()};
  for (Entity part : parts_[i]) {
    const Pull its = on(*given_, part);
    sum.all += joint_share_[part] * its.all;
    sum.working += joint_share_[part] * its.working;
  }
  return sum;
}

/// A force on body i sets in or ceases, now.
void ExactSimulator::switch_forces(Entity i) {
  const double t = now_ - flight_[i].start;
  const Vec3 x = flight_[i].position(t);
  Vec3 v = flight_[i].velocity(t);
  path_changes(i);
  book_flight(i, x);
  flight_.set(i, {now_, x, v, flight_.acceleration(i)});
  const Pull pull = pull_on(i);
  if (body_[i].place == Place::asleep) join(i);
  if (body_[i].place == Place::crowd) {  // the last step had the old forces in it until its end
    const Vec3 slower = velocity_now(i, now_);
    log_.lose(0.5 * world_.mass[i] * (v - slower).dot(v + slower));
    v = slower;
    pulled_.write(i) = now_;
    crowd_end_ = now_;
  }
  pull_.write(i) = pull.all;
  driven_.write(i) = pull.working;
  restart(i, x, keep_contacts(i, v), {});
  predict(i);
}

/// A run that would never end is stopped: one in which events go on and on while the clock stands still. Elastic
/// impacts cannot collapse, and unequal masses have millions of them in an instant (Galperin's billiard): of these, and
/// of events without physics, it takes a thousand times as many, or that the clock moves by its rounding at most.
void ExactSimulator::check_limits(Kind kind) {
  const std::uint64_t many = 1'000'000 + 1000ull * world_.body_count();
  const bool impact = kind == Kind::body_body || kind == Kind::body_fixed;
  const bool patient = kind == Kind::none || (impact && struck_ == 1);
  if (impact) liveliest_ = std::max(liveliest_, struck_);
  Watch& watch = patient ? patient_ : impatient_;
  const bool full = ++watch.events >= (patient ? 1000 * many : many);
  if (!full && watch.events % many != 0) return;
  // At a billionth of the duration per million events a run would never end, nor at a clock's rounding in as many.
  if (now_.hi - watch.seen <= 0x1p-46 * now_.hi || (full && now_.hi - watch.since < 0x1p-30 * options_.duration)) {
    const char* advice =
        " (jammed, or inelastic collapse): give them room, raise their restitution, or simulate.rest_speed";
    if (patient) advice = " (jammed, or masses too unequal): give them room, or shorten simulate.duration";
    if (liveliest_ > 1)
      advice = " (restitution above 1 makes energy at every collision): lower it, or shorten simulate.duration";
    throw SimulationError(
        fmt::format("at t = {} s bodies collide so often that the clock stands still{}", now_.hi, advice));
  }
  watch.seen = now_.hi;
  if (!full) return;
  watch.events = 0;
  watch.since = now_.hi;
  liveliest_ = 0;
}

/// A body's velocity at an instant of its flight. A stride has what forces do until its end in it from the start.
Vec3 ExactSimulator::velocity_now(Entity i, const Instant& at) const {
  const Vec3 v = flight_[i].velocity(at - flight_[i].start);
  if (body_[i].place != Place::crowd || following_) return v;
  return without_haste(v, at, pulled_[i], hastened_[i]);
}

Effort ExactSimulator::effort() const {
  Effort effort = effort_;
  effort.next = queue_.first_time();
  return effort;
}

const State& ExactSimulator::state() {
  if (state_fresh_) return state_;
  state_.time = time_;
  state_.position.resize(world_.body_count());
  state_.velocity.resize(world_.body_count());
  const Instant at{time_, 0};
  for (Entity i = 0; i < world_.body_count(); ++i) {
    const double t = at - flight_[i].start;
    state_.position[i] = flight_[i].position(t);
    state_.velocity[i] = velocity_now(i, at);
  }
  // Between collisions a speed is greatest at a flight's ends: the last flights end here.
  if (time_ >= options_.duration && !ended_) {
    ended_ = true;
    for (Entity i = 0; i < world_.body_count(); ++i) {
      hold_to(bounds_, i, time_, state_.position[i], state_.velocity[i], too_fast);
      log_.note_speed(state_.velocity[i].norm());
      book_flight(i, state_.position[i]);
      const Vec3 v = flight_[i].velocity(at - flight_[i].start);
      if (v != state_.velocity[i])
        log_.lose(0.5 * world_.mass[i] * (v - state_.velocity[i]).dot(v + state_.velocity[i]));
    }
  }
  if (!part_of_.empty()) {
    state_.mass = world_.mass;
    state_.radius = world_.radius;
    state_.volume = world_.volume;
    state_.part_of = part_of_;
    state_.join_parts();
  }
  state_fresh_ = true;
  return state_;
}

}  // namespace carom
