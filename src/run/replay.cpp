// Evaluates the recorded pieces with the formulas of Flight, as the simulator does, so that states agree bit for bit.
// Pieces are read as time advances, so that the record never has to fit into memory.
#include "run/replay.h"

#include <numeric>

#include "export/flights_file.h"
#include "physics/force.h"
#include "physics/world.h"
#include "simulate/path/flight.h"
#include "std.h"

namespace carom {

namespace {

constexpr size_t path_buffer = 4096;

Instant instant(const DoubleDouble& time) {
  return {time.hi, time.lo};
}

}  // namespace

Replay::Replay(const World& world, NextRecorded next, const Tally& tally, bool counts)
    : known_(world),
      world_(known_.at(tally.changes.fired)),
      next_(std::move(next)),
      tally_(tally),
      end_(tally.end),
      now_(world.body_count()) {
  tally_.end.reset();
  if (tally.changes.fired.empty()) tally_.changes.fired.assign(world.triggers.all.size(), not_yet);
  if (counts) tally_.body_body = tally_.body_fixed = tally_.merges = tally_.tautened = 0;
  more_ = next_(coming_);

  // The state at time 0 is before whatever happens then: each body is on its first piece.
  for (size_t begun = 0; more_ && begun < now_.size();) {
    if (coming_.kind == Recorded::Kind::piece) ++begun;
    take_coming();
  }
}

void Replay::take_coming() {
  if (coming_.kind == Recorded::Kind::collision) {
    const CollisionMark& mark = coming_.collision;
    tally_.count(mark.kind);
    collisions_.push_back({mark.time, mark.kind, mark.a, mark.b, Vec3::Zero(), Vec3::Zero(), 0, 0, 0, mark.impulse, 0});
  } else if (coming_.kind == Recorded::Kind::event) {
    tally_.changes.fired[coming_.event.trigger] = coming_.event.fired;
    known_.at(tally_.changes.fired);
  } else {
    take(coming_.piece);
    passed_.push_back(coming_.piece);
  }
  more_ = next_(coming_);
}

void Replay::advance_to(double time) {
  fresh_ = false;
  passed_.clear();
  collisions_.clear();

  // The state at the run's end stays. It is after whatever happens then.
  const double end = end_ ? end_->time : infinity;
  const bool reaches_end = time >= end;
  if (time > end && time_ < end) time = end;

  while (more_ && (reaches_end || coming_.from() <= time)) {
    // Stop before the next part, possibly in the middle of an instant.
    if (passed_.size() + collisions_.size() >= path_buffer) {
      time_ = max(time_, std::nextafter(coming_.from(), 0));
      return;
    }
    take_coming();
  }
  time_ = max(time, time_);
  if (!more_ && time_ >= end) tally_.end = end_;
}

void Replay::take(const PathPiece& piece) {
  now_[piece.body] = piece;
  if (piece.law == PathLaw::closed) {
    if (closed_.empty()) closed_.resize(now_.size());
    const auto forces = closed_forces(world_, piece.body, piece.start.hi);
    const Vec3 at_rest = free_acceleration(world_, piece.body, piece.start.hi, piece.x, Vec3::Zero());
    closed_[piece.body].emplace(forces.value_or(ClosedForces{}), piece.x, piece.v, at_rest);
  }
  const bool out = piece.part_of != no_entity || piece.removed;
  if (piece.joint || out || (!part_of_.empty() && part_of_[piece.body] == no_entity)) take_joint(piece);
}

/// Takes what a merge, a removal or an appearance changes of the body itself.
void Replay::take_joint(const PathPiece& piece) {
  if (part_of_.empty()) {
    part_of_.resize(world_.body_count());
    std::iota(part_of_.begin(), part_of_.end(), Entity{0});
    mass_ = world_.mass;
    radius_ = world_.radius;
    volume_ = world_.volume;
  }

  const bool out = piece.part_of != no_entity || piece.removed;
  part_of_[piece.body] = out ? piece.part_of : piece.body;
  if (!piece.joint) return;
  mass_[piece.body] = piece.mass;
  radius_[piece.body] = piece.radius;
  if (!volume_.empty()) volume_[piece.body].half = piece.half;
}

/// The acceleration of a body by forces (m/s^2), as the simulator evaluates it.
Vec3 Replay::force_at(Entity body, double time, const Vec3& x, const Vec3& v) const {
  if (bends(world_, body, time)) return free_acceleration(world_, body, time, x, v);
  return free_acceleration(world_, body, time, x, Vec3::Zero()) - fade_of(world_, body, time) * v;
}

/// Computes the state of a body at an instant of its present piece.
void Replay::place(size_t body, const Instant& at) {
  const PathPiece& piece = now_[body];
  const Entity i = Entity(body);
  const Instant start = instant(piece.start);
  Vec3& x = state_.position[body];
  Vec3& v = state_.velocity[body];

  if (piece.law == PathLaw::closed) {
    const ClosedMotion& motion = *closed_[body];
    const ClosedMotion::Point there = motion.at(seconds(start, at));
    x = motion.origin() + there.place;
    v = there.velocity;
    return;
  }

  const PolynomialPath* const curve = piece.curve.get();
  const Flight flight{start, piece.x, piece.v, piece.a, curve != nullptr ? Flight::curved : piece.fade, curve};
  const double t = at - start;
  const bool is_at_start = piece.law == PathLaw::frame && t >= -piece.rounding;
  x = is_at_start ? piece.x : flight.position(t);
  v = is_at_start ? piece.v : flight.velocity(t);
  if (piece.kicked) v -= Kick{instant(piece.until), piece.kick}.rest(at);
  if (curve == nullptr) return;

  if (piece.law == PathLaw::verlet)
    v += (0.5 * t) * (force_at(i, piece.from, x, v) - piece.a);
  else if (!curve->ahead.isZero(0))
    v -= curve->ahead;
}

const State& Replay::state() {
  if (fresh_) return state_;

  state_.time = end_ ? min(time_, end_->time) : time_;
  state_.position.resize(now_.size());
  state_.velocity.resize(now_.size());
  const Instant at{state_.time, 0};
  for (size_t i = 0; i < now_.size(); ++i) place(i, at);

  state_.fired = fired_by(tally_.changes.fired, state_.time);

  if (!part_of_.empty()) {
    state_.mass = mass_;
    state_.radius = radius_;
    state_.volume = volume_;
    state_.part_of = part_of_;
    state_.join_parts();
  }

  fresh_ = true;
  return state_;
}

unique_ptr<Simulator> replay_from(unique_ptr<FlightsReader> reader, const World& world) {
  const shared_ptr<FlightsReader> shared = std::move(reader);
  return make_unique<Replay>(
      world, [shared](Recorded& recorded) { return shared->next(recorded); }, shared->tally(),
      shared->has_collisions());
}

}  // namespace carom
