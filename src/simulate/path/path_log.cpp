// Records the pieces of paths for a replay without simulation. A piece is written after all changes at its instant.
// Only bodies that changed get a new piece, so that the log grows with events and not with outputs.
#include "simulate/path/path_log.h"

#include "physics/world.h"
#include "simulate/path/crossings.h"
#include "std.h"

namespace carom {

namespace {

constexpr size_t path_buffer = 4096;

/// The first double that is not before an instant.
double first_double(const Instant& at) {
  return at.lo > 0 ? std::nextafter(at.hi, infinity) : at.hi;
}

}  // namespace

PathLog::PathLog(const BodyPaths& bodies, Crossings& crossings)
    : bodies_(bodies),
      extremes_(bodies),
      crossings_(crossings),
      followed_(bodies.options.record_paths || crossings.any() || bodies.options.stop_at_rest ||
                bodies.options.stop_collisions > 0),
      wanted_(followed_ || extremes_.any()),
      closed_(bodies.body.size()) {}

void PathLog::begin_advance() {
  pieces_.clear();
  full_ = false;
}

void PathLog::note(Entity i) {
  if (extremes_.any()) extremes_.note(i);
  if (!followed_) return;
  if (changed_at_ != bodies_.now) record_changes();
  changed_at_ = bodies_.now;
  changed_.push_back(i);
}

void PathLog::record_changes() {
  ranges::sort(changed_);
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  if (changed_.empty()) return;
  latest_ = max(min(first_double(max(changed_at_, delayed_)), end_), latest_);
  if (bodies_.options.record_paths)
    for (const Entity i : changed_)
      if (!goes_on(i)) pieces_.push_back(piece_of(i, latest_));
  if (crossings_.any())
    for (const Entity i : changed_) crossings_.follow(i, changed_at_);
  changed_.clear();
  full_ = full_ || pieces_.size() >= path_buffer;
}

void PathLog::end(double time) {
  end_ = time;
  record_changes();
}

/// Whether body i's path is a further step of the motion in closed form that its last piece began.
bool PathLog::goes_on(Entity i) {
  const bool closed = curved_->follows_closed_form(i);
  const bool goes_on = closed && closed_[i] != 0 && !curved_->begins_closed_form(i);
  if (closed != (closed_[i] != 0)) closed_.write(i) = closed;
  return goes_on;
}

PathPiece PathLog::piece_of(Entity i, double from) const {
  const Flight f = bodies_.flights[i];
  const World& world = bodies_.world;
  const World& given = bodies_.merged.given();
  PathPiece piece{i, from, {f.start.hi, f.start.lo}, f.x, f.v, f.a};
  if (f.curve == nullptr) piece.fade = f.fade;

  if (is_kicked(bodies_.mode(i))) {
    const Instant until = bodies_.kick[i].until;
    piece.kicked = true;
    piece.until = {until.hi, until.lo};
    piece.kick = bodies_.kick[i].a;
  }

  if (curved_->begins_closed_form(i)) {
    piece.law = PathLaw::closed;
  } else if (f.curve != nullptr) {
    // The velocities of contact are those of the path.
    const bool free = !in_lasting_contact(bodies_.mode(i));
    const bool verlet = bodies_.options.integrator == Integrator::verlet;
    if (free && verlet) piece.law = PathLaw::verlet;
    auto curve = make_shared<PolynomialPath>(*f.curve);
    if (!free || verlet) curve->ahead = Vec3::Zero();
    piece.curve = std::move(curve);
  }

  if (bodies_.merged.any()) {
    const Entity whole = bodies_.merged.whole_of()[i];
    piece.removed = whole == no_entity;
    if (whole != i && !piece.removed) piece.part_of = whole;

    piece.joint = world.mass[i] != given.mass[i] || world.radius[i] != given.radius[i];
    // Files hold these of joint bodies alone, and predict each from the piece before.
    if (piece.joint) {
      piece.mass = world.mass[i];
      piece.radius = world.radius[i];
      piece.half = world.volume_of(i).half;
    }
  }
  return piece;
}

}  // namespace carom
