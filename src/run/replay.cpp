// Evaluates the recorded pieces with the formulas of Flight, as the simulator does, so that states agree bit for bit.
// Pieces are read as time advances, so that the record never has to fit into memory.
#include "run/replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "physics/world.h"
#include "simulate/path/flight.h"

namespace carom {

namespace {

constexpr std::size_t path_buffer = 4096;

Instant instant(const DoubleDouble& time) {
  return {time.hi, time.lo};
}

}  // namespace

Replay::Replay(const World& world, NextPiece next, const Tally& tally)
    : world_(world), next_(std::move(next)), tally_(tally), now_(world.body_count()) {
  more_ = next_(coming_);
  std::vector<PathPiece> first;  // all pieces at time 0
  do {
    advance_to(0);
    first.insert(first.end(), passed_.begin(), passed_.end());
  } while (more_ && coming_.from <= 0);
  passed_ = std::move(first);
}

void Replay::advance_to(double time) {
  fresh_ = false;
  passed_.clear();
  // The state at the run's end stays.
  const double end = tally_.end ? tally_.end->time : std::numeric_limits<double>::infinity();
  if (time > end && time_ < end) time = end;
  while (more_ && coming_.from <= time) {
    // Stop before the next piece, possibly in the middle of an instant.
    if (passed_.size() >= path_buffer) {
      time_ = std::max(time_, std::nextafter(coming_.from, 0));
      return;
    }
    take(coming_);
    passed_.push_back(coming_);
    more_ = next_(coming_);
  }
  time_ = std::max(time, time_);
}

void Replay::take(const PathPiece& piece) {
  now_[piece.body] = piece;
  const bool merges = piece.joint || piece.part_of != no_entity || piece.removed;
  if (!merges) return;
  if (part_of_.empty()) {
    part_of_.resize(world_.body_count());
    std::iota(part_of_.begin(), part_of_.end(), Entity{0});
    mass_ = world_.mass;
    radius_ = world_.radius;
    volume_ = world_.volume;
  }
  if (piece.part_of != no_entity || piece.removed) part_of_[piece.body] = piece.part_of;
  if (!piece.joint) return;
  mass_[piece.body] = piece.mass;
  radius_[piece.body] = piece.radius;
  if (!volume_.empty()) volume_[piece.body].half = piece.half;
}

const State& Replay::state() {
  if (fresh_) return state_;
  state_.time = tally_.end ? std::min(time_, tally_.end->time) : time_;
  state_.position.resize(now_.size());
  state_.velocity.resize(now_.size());
  const Instant at{state_.time, 0};
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const PathPiece& piece = now_[i];
    const Flight flight{instant(piece.start), piece.x, piece.v, piece.a, piece.curve ? Flight::curved : 0,
                        piece.curve.get()};
    const double t = at - flight.start;
    state_.position[i] = flight.position(t);
    state_.velocity[i] = flight.velocity(t);
    if (piece.kicked) state_.velocity[i] -= Kick{instant(piece.until), piece.kick}.rest(at);
  }
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

}  // namespace carom
