#include "simulate/exact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/contact_time.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr std::size_t collision_buffer = 4096;
constexpr std::uint32_t events_at_a_time = 65536;
constexpr double least_speed = 0x1p-900;  // m/s; below, products underflow and a body is as good as still

}  // namespace

std::unique_ptr<Simulator> make_exact_simulator(const World& world, const State& initial, const ExactOptions& options) {
  return std::make_unique<ExactSimulator>(world, initial, options);
}

ExactSimulator::ExactSimulator(const World& world, const State& initial, const ExactOptions& options)
    : world_(world),
      options_(options),
      flight_(world.body_count()),
      origin_(world.body_count()),
      version_(world.body_count()),
      event_(world.body_count()),
      region_(world.body_count()),
      near_(world.body_count()),
      contacts_(world.fixed_count() > 0 && !world.gravity.isZero(0) ? world.body_count() : 0),
      burst_(contacts_.size()),
      grid_(world.body_count()),
      queue_(world.body_count(), Before{this}),
      place_(contacts_.size(), Place::outside),
      pressed_(contacts_.size()),
      pulled_(contacts_.size()),
      jostled_(contacts_.size()),
      idle_(contacts_.size()) {
  const Entity n = world.body_count();
  state_.position.resize(n);
  state_.velocity.resize(n);
  if (options.record_collisions) collisions_.reserve(collision_buffer);
  for (Entity i = 0; i < n; ++i) {
    Vec3 v = initial.velocity[i];
    if (!world.impulse.empty()) v += world.impulse[i] / world.mass[i];
    flight_[i] = {{}, initial.position[i], v, world.gravity};
    region_[i] = {initial.position[i], 0.5 * world.radius[i], 0};
    region_[i].half = region_[i].room + world.radius[i];
    grid_.put(i, region_[i].center, region_[i].half);
    tally_.max_speed = std::max(tally_.max_speed, v.norm());
  }
  for (Entity i = 0; i < n; ++i) {
    find_neighbours(i);
    if (!contacts_.empty()) touch_down(i);
  }
  for (Entity i = 0; i < n; ++i) predict(i);
}

/// Events in their total order: time, kind, the lower and the higher number of those concerned.
bool ExactSimulator::before(Entity i, Entity j) const {
  const Event &p = event_[i], &q = event_[j];
  if (p.time < q.time) return true;
  if (q.time < p.time) return false;
  if (p.kind != q.kind) return p.kind < q.kind;
  const Entity pa = std::min(i, p.partner), qa = std::min(j, q.partner);
  if (pa != qa) return pa < qa;
  return std::max(i, p.partner) < std::max(j, q.partner);
}

void ExactSimulator::advance_to(double time) {
  collisions_.clear();
  state_fresh_ = false;
  const Instant until{std::min(time, options_.duration), 0};
  std::uint32_t events = 0;
  for (Entity i = queue_.first(); i != no_entity && event_[i].time <= until; i = queue_.first()) {
    process(i);
    // After many events that no one has seen, the caller may want to look at the clock.
    if (++events % events_at_a_time == 0 && std::nextafter(now_.hi, 0) > time_) {
      time_ = std::nextafter(now_.hi, 0);
      return;
    }
    // A full buffer: stop short of the instant reached, for more may happen in it.
    if (collisions_.size() >= collision_buffer - 8) {
      time_ = std::max(time_, std::nextafter(now_.hi, 0));
      return;
    }
  }
  time_ = std::max(time, time_);
}

void ExactSimulator::process(Entity i) {
  const Event event = event_[i];
  if (getenv("EV") && event.time.hi > atof(getenv("EV"))) fprintf(stderr, "ev %.17g kind %d %u %u place %d %d jost %u crowdend %.17g u %g\n", event.time.hi, int(event.kind), i, event.partner, int(place_[i]), world_.is_body(event.partner)?int(place_[event.partner]):9, jostled_[i], crowd_end_.hi, world_.is_body(event.partner)?(flight_[i].v-flight_[event.partner].v).dot((flight_[event.partner].x-flight_[i].x).normalized()):0.);
  if (now_ < event.time) now_ = event.time;
  switch (event.kind) {
    case Kind::body_body:
      if (version_[event.partner] == event.partner_version)
        collide_pair(std::min(i, event.partner), std::max(i, event.partner));
      else
        predict(i);  // the other one has changed its path since
      break;
    case Kind::body_fixed:
      collide_fixed(i, event.partner, event.feature);
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
    case Kind::leave_region:
      rebuild_region(i);
      predict(i);
      break;
    case Kind::none:
      break;
  }
  check_limits();
}

/// Begins a new flight of body i, here and now.
void ExactSimulator::restart(Entity i, const Vec3& x, const Vec3& v, Origin origin) {
  const double speed = v.norm();
  if (!(speed < never))
    throw SimulationError(
        fmt::format("at t = {} s a body's speed is no longer finite: restitution above 1 makes energy at every "
                    "collision; lower it, or "
                    "shorten simulate.duration",
                    now_.hi));
  tally_.max_speed = std::max(tally_.max_speed, speed);
  // What holds a body against gravity does work where it yields.
  if (flight_[i].a != world_.gravity) lose(world_.mass[i] * (world_.gravity - flight_[i].a).dot(x - flight_[i].x));
  flight_[i].start = now_;
  flight_[i].x = x;
  flight_[i].v = speed < least_speed ? Vec3(Vec3::Zero()) : v;
  flight_[i].a = contact_acceleration(i);
  origin_[i] = origin;
  ++version_[i];
}

void ExactSimulator::record(const Collision& collision) {
  if (collision.kind != CollisionKind::rest) {
    ++(collision.kind == CollisionKind::body_body ? tally_.body_body : tally_.body_fixed);
    if (std::isnan(tally_.first_collision)) tally_.first_collision = collision.time;
    tally_.last_collision = collision.time;
  }
  if (options_.record_collisions) collisions_.push_back(collision);
}

/// Kinetic energy (J) that a collision or a contact took.
void ExactSimulator::lose(double energy) {
  energy_lost_.add(energy);
  tally_.energy_lost = energy_lost_.value();
}

void ExactSimulator::check_limits() {
  if (options_.max_collisions > 0 && tally_.collisions() > options_.max_collisions)
    throw SimulationError(fmt::format("more than simulate.max_collisions = {} collisions, reached at t = {} s",
                                      options_.max_collisions, now_.hi));
  // At a billionth of the duration per million events a run would never end.
  if (++events_ < 1'000'000 + 1000ull * world_.body_count()) return;
  if (now_ - looked_at_ < 0x1p-30 * options_.duration)
    throw SimulationError(
        fmt::format("at t = {} s bodies collide so often that the clock stands still (jammed, or inelastic collapse): "
                    "give them room, "
                    "raise their restitution, or simulate.rest_speed",
                    now_.hi));
  events_ = 0;
  looked_at_ = now_;
}

const State& ExactSimulator::state() {
  if (state_fresh_) return state_;
  state_.time = time_;
  const Instant at{time_, 0};
  for (Entity i = 0; i < world_.body_count(); ++i) {
    const double t = at - flight_[i].start;
    state_.position[i] = flight_[i].position(t);
    state_.velocity[i] = flight_[i].velocity(t);
  }
  // Between collisions a speed is greatest at a flight's ends: the last flights end here.
  if (time_ >= options_.duration)
    for (const Vec3& v : state_.velocity) tally_.max_speed = std::max(tally_.max_speed, v.norm());
  state_fresh_ = true;
  return state_;
}

}  // namespace carom
