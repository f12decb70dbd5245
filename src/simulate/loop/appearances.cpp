// A body is placed among the neighbours for a try, and taken out again where there is no room.
// The time at which a thing leaves a place is approached from before, by steps in which it cannot have left: a path
// covers the depth of the overlap at the earliest at its present speed and greatest acceleration.
#include "simulate/loop/appearances.h"

#include <fmt/format.h>

#include "geometry/touch.h"
#include "numerics/random.h"
#include "std.h"

namespace carom {

namespace {

/// A share of a body's radius: a thing that overlaps it by less has left its place.
constexpr double exit_rounding = 0x1p-40;
/// Places that a ball of a pour tries at one tick.
constexpr int tries_of_tick = 100;

/// A place in a volume about its centre (m), uniformly.
Vec3 place_in(const Volume& volume, Random& random) {
  for (;;) {
    Vec3 share;
    for (int k = 0; k < 3; ++k) share[k] = 2 * random.uniform() - 1;
    const double flat = share.x() * share.x() + share.z() * share.z();
    const double beyond = volume.shape == Shape::box ? 0 : volume.shape == Shape::cylinder ? flat : share.squaredNorm();
    if (beyond <= 1) return share.cwiseProduct(volume.half);
  }
}

}  // namespace

Appearances::Appearances(ExactBodies& bodies, const State& initial)
    : bodies_(bodies), lines_(bodies.world.pours.size()) {
  const World& world = bodies.world;
  if (world.appears.empty()) return;
  x_ = initial.position;
  v_ = initial.velocity;
  for (Entity i = 0; i < world.impulse.size(); ++i) v_[i] += world.impulse[i] / world.mass[i];

  vector<uint8_t> poured(world.appears.size());
  for (size_t k = 0; k < lines_.size(); ++k) {
    const Pour& pour = world.pours[k];
    std::fill_n(poured.begin() + pour.first, pour.count, 1);
    lines_[k].due = pour.count > 0 ? world.appears[pour.first] : never;
  }

  for (Entity i = 0; i < world.appears.size(); ++i)
    if (world.comes_later(i) && poured[i] == 0) coming_.push_back(i);
  ranges::sort(coming_, [&](Entity i, Entity j) { return pair(world.appears[j], j) < pair(world.appears[i], i); });
}

bool Appearances::any() const {
  return !coming_.empty() || !blocked_.empty() || any_of(lines_, [](const Line& line) { return line.due < never; });
}

/// When a blocked body may try again: at once where the path of what leaves last has changed.
Instant Appearances::due_of(const Blocked& one) const {
  const bool changed = bodies_.world.is_body(one.last) && bodies_.body[one.last].version != one.last_version;
  return changed ? bodies_.now : max(one.due, bodies_.now);
}

Instant Appearances::next() {
  Instant next{never, 0};
  if (!coming_.empty()) next = {bodies_.world.appears[coming_.back()], 0};
  for (const Blocked& one : blocked_) next = min(next, due_of(one));
  for (const Line& line : lines_) next = min(next, {line.due, 0});
  return max(next, bodies_.now);
}

/// How deep body i at x (m) overlaps a thing at an instant (m).
double Appearances::overlap(Entity i, const Vec3& x, Entity e, const Instant& at) const {
  const World& world = bodies_.world;
  const Vec3 xe =
      world.is_body(e) ? bodies_.flights[e].position(at - bodies_.flights[e].start) : bodies_.fixed_position(e, at);
  return -touch(world, i, x, e, xe).gap;
}

/// Whether body i at x (m) overlaps a thing at present by more than what counts as touching.
bool Appearances::blocks(Entity e, Entity i, const Vec3& x) const {
  return overlap(i, x, e, bodies_.now) > bodies_.contact_gap(i, x, bodies_.position_of(e));
}

/// Whether body i has room at x (m). Then it is among the neighbours.
bool Appearances::has_room(Entity i, const Vec3& x) {
  bodies_.neighbours.admit(i, x);
  const span<const Entity> near = bodies_.neighbours.near(i);
  if (ranges::none_of(near, [&](Entity e) { return blocks(e, i, x); })) return true;
  bodies_.neighbours.remove(i);
  return false;
}

/// When a thing leaves the place x (m) of body i on its present path. Infinite: it does not.
Instant Appearances::exit_of(Entity e, Entity i, const Vec3& x) const {
  const bool body = bodies_.world.is_body(e);
  if (!body && !bodies_.world.moves(e)) return {never, 0};
  const Instant end =
      min(body ? bodies_.flight_end(e) : bodies_.moving.next_switch(bodies_.now), Instant{bodies_.options.duration, 0});

  // Each step ends before it may have left.
  Instant at = bodies_.now;
  while (at < end) {
    const double depth = overlap(i, x, e, at);
    if (depth <= exit_rounding * bodies_.world.radius[i]) return at;
    const Flight f = body ? bodies_.flights[e] : Flight{};
    const double speed = body ? f.velocity(at - f.start).norm() : bodies_.fixed_velocity(e, at).norm();
    const Swing* const swing = bodies_.world.swing(e);
    const double acceleration = body ? f.greatest_acceleration() : swing != nullptr ? greatest_acceleration(*swing) : 0;

    const double step = 2 * depth / (speed + sqrt(speed * speed + 2 * acceleration * depth));
    const Instant later = at + step;
    if (!(later < end)) break;
    if (later == at) return at;
    at = later;
  }
  return end.hi < bodies_.options.duration ? end : Instant{never, 0};
}

/// Body i, with the thing that leaves its place x (m) last.
Appearances::Blocked Appearances::blocked(Entity i, const Vec3& x) {
  bodies_.neighbours.admit(i, x);
  Blocked one{i, bodies_.now, no_entity, 0};
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (!blocks(e, i, x)) continue;
    const Instant exit = exit_of(e, i, x);
    if (one.last != no_entity && exit <= one.due) continue;
    one.due = exit;
    one.last = e;
    one.last_version = bodies_.world.is_body(e) ? bodies_.body[e].version : 0;
  }
  bodies_.neighbours.remove(i);
  return one;
}

optional<Appearances::Admitted> Appearances::take() {
  // Those that are due now.
  while (!coming_.empty() && bodies_.world.appears[coming_.back()] <= bodies_.now.hi) {
    blocked_.push_back({coming_.back(), bodies_.now, no_entity, 0});
    coming_.pop_back();
  }

  for (auto one = blocked_.begin(); one != blocked_.end(); ++one) {
    if (bodies_.now < due_of(*one)) continue;
    const Entity i = one->body;
    if (has_room(i, x_[i])) {
      blocked_.erase(one);
      return Admitted{i, x_[i], v_[i]};
    }
    *one = blocked(i, x_[i]);
  }

  for (size_t k = 0; k < lines_.size(); ++k)
    if (lines_[k].due <= bodies_.now.hi)
      if (const optional<Admitted> one = take_of_line(k)) return one;
  return nullopt;
}

/// The next ball of pour k, if it finds room. Otherwise it tries again at the pour's next tick.
optional<Appearances::Admitted> Appearances::take_of_line(size_t k) {
  const Pour& pour = bodies_.world.pours[k];
  Line& line = lines_[k];
  const Entity i = pour.first + line.next;
  const double from = bodies_.world.appears[pour.first];
  const double now = bodies_.now.hi;

  double tick = floor((now - from) * pour.rate);
  Random random(pour.seed, fmt::format("{}/{}", line.next, tick));
  const Volume within{pour.within.shape, pour.within.half - Vec3::Constant(bodies_.world.radius[i])};
  for (int n = 0; n < tries_of_tick; ++n) {
    const Vec3 x = pour.center + place_in(within, random);
    if (!has_room(i, x)) continue;
    ++line.next;
    line.due = line.next < pour.count ? max(bodies_.world.appears[i + 1], now) : never;
    return Admitted{i, x, v_[i]};
  }

  do line.due = from + ++tick / pour.rate;
  while (line.due <= now);
  return nullopt;
}

}  // namespace carom
