// Paths as they are recorded. A path is final once all that happens at an instant has happened: it is looked at when
// the first change at a later one is about to come, or when somebody wants to see it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr std::size_t path_buffer = 4096;

/// The first double that is not before an instant.
double first_double(const Instant& at) {
  return at.lo > 0 ? std::nextafter(at.hi, std::numeric_limits<double>::infinity()) : at.hi;
}

}  // namespace

void ExactSimulator::note_path(Entity i) {
  if (changed_at_ != now_) record_paths();
  changed_at_ = now_;
  changed_.push_back(i);
}

void ExactSimulator::record_paths() {
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  const double from = first_double(changed_at_);
  for (const Entity i : changed_) {
    const Flight f = flight_[i];
    PathPiece piece{i, from, {f.start.hi, f.start.lo}, f.x, f.v, f.a};
    if (body_[i].place == Place::crowd && !following_) {
      piece.hastened = true;
      piece.until = {pulled_[i].hi, pulled_[i].lo};
      piece.haste = hastened_[i];
    }
    if (!part_of_.empty()) {
      if (part_of_[i] != i) piece.part_of = part_of_[i];
      piece.joint = world_.mass[i] != given_->mass[i] || world_.radius[i] != given_->radius[i];
      piece.mass = world_.mass[i];
      piece.radius = world_.radius[i];
      piece.half = world_.volume_of(i).half;
    }
    paths_.push_back(piece);
  }
  changed_.clear();
  full_ = full_ || paths_.size() >= path_buffer;
}

}  // namespace carom
