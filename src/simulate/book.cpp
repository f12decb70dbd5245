// The source chapter's program (ParticleBounce, listings 8.3 and 8.4). Each frame tests for overlap and handles every
// overlapping pair. Then it moves every body by semi-implicit Euler, v += a dt, x += v dt.
//
// By default it does what the text means: the average of the two coefficients (or the scene's rule) and the sum of both
// radii. The velocity changes once, and only for bodies that approach. `as_printed` does what the listings print
// instead:
//   e = (e1 e2) / 2, where the text has the average;
//   |d|^2 < (r0 + r0)^2, the first body's radius twice;
//   after v' is set, the acceleration becomes v'/dt, so that the same frame's update adds v' once more;
//   no test that the bodies approach, so that a pair still overlapping in the next frame is handled again.
#include "simulate/book.h"

#include <fmt/format.h>

#include "geometry/contact_time.h"
#include "physics/archive.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/event_log.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace {

constexpr int frames_at_a_time = 4096;
// Collisions. A frame may have more.
constexpr size_t room_for_frame = EventLog::capacity / 2;
constexpr size_t path_buffer = 4096;

class BookSimulator final : public Simulator {
 public:
  BookSimulator(const World& world, const State& initial, const BookOptions& options);

  void advance_to(double time) override;
  double time() const override { return time_; }
  const State& state() override;
  span<const Collision> collisions() const override { return log_.collisions(); }
  span<const PathPiece> paths() const override { return pieces_; }
  span<const RegionCrossing> crossings() const override { return crossings_; }
  const Tally& tally() const override { return log_.tally(); }
  vector<Extremes> extremes() const override;
  string save() override;
  void restore(string_view bytes) override;

 private:
  /// For save() and restore().
  template <typename Archive>
  void keep(Archive& archive);
  double frame_time(uint64_t frame) const { return double(frame) * options_.step; }
  void do_frame();
  void find_forces();
  void handle_pairs();
  void handle_surfaces();
  void move();
  void record_paths();
  void find_crossings();
  bool rests() const;
  void end_at(double time, EndReason reason, uint32_t region = 0);
  bool end_until(double time);
  void handle_pair(Entity a, Entity b);
  void handle_fixed(Entity i, Entity surface, const Vec3& point, const Vec3& normal);
  void record(const Collision& collision);
  void take_extremes();
  void integrate(size_t k, double from, double sign, Extremes& found) const;

  const World& world_;
  const BookOptions options_;
  const Bounds bounds_;
  const double rounding_;  // s: of the time of a frame
  // Frames done. The bodies are at frame_time(frames_).
  uint64_t frames_ = 0;
  double time_ = 0;     // s, requested time: within the last frame done
  vector<Vec3> x_;      // m
  vector<Vec3> v_;      // m/s
  vector<Vec3> force_;  // N
  State state_;
  EventLog log_;
  // By region and body: whether it is inside, as of the last frame.
  vector<uint8_t> inside_;
  vector<RegionCrossing> crossings_;
  vector<PathPiece> pieces_;   // since the last advance
  vector<uint8_t> lies_;       // by body: its last piece has no velocity
  optional<RunEnd> end_;       // in the last frame done
  vector<Extremes> extremes_;  // by options_.watch, at the frames
  // The same: the sums over bodies at the start and the end of the last frame.
  vector<array<double, 2>> sums_;
};

BookSimulator::BookSimulator(const World& world, const State& initial, const BookOptions& options)
    : world_(world),
      options_(options),
      bounds_(bounds_of(world)),
      rounding_(stepped_tolerance::frame_rounding * options.step),
      x_(initial.position),
      v_(initial.velocity),
      force_(world.body_count()),
      log_(options.max_collisions, options.record_collisions),
      // What is watched.
      inside_(world.regions.size() * world.body_count()),
      lies_(world.body_count()),
      extremes_(options.watch.size()),
      sums_(options.watch.size()) {
  // What it does not have.
  if (!world.appears.empty())
    throw SimulationError("the engine `book` has all bodies from the start: use `engine: exact`, or remove `appear`");
  if (!world.strings.empty())
    throw SimulationError("the engine `book` has no strings: use `engine: exact`, or remove `strings`");

  for (Entity i = 0; i < world.body_count(); ++i) log_.note_speed(i, v_[i].norm());
  take_extremes();
  record_paths();
}

void BookSimulator::take_extremes() {
  for (size_t k = 0; k < extremes_.size(); ++k) {
    const WatchedQuantity& watched = options_.watch[k];
    double sum = 0;
    for (Entity i = watched.first; i < watched.first + watched.count; ++i) {
      const double value = quantity_of(watched.quantity, x_[i], v_[i], world_.mass[i]);
      sum += value;
      if (watched.window.has(frame_time(frames_))) extremes_[k].take(value, frame_time(frames_));
    }

    sums_[k] = {sums_[k].back(), sum};
    if (frames_ > 0) integrate(k, frame_time(frames_ - 1), 1, extremes_[k]);
  }
}

/// Adds the integral of a watched quantity over the last frame, from a time (s) of it on, times `sign`. Between frames
/// it is a straight line.
void BookSimulator::integrate(size_t k, double from, double sign, Extremes& found) const {
  const WatchedQuantity& watched = options_.watch[k];
  const double begin = frame_time(frames_ - 1), length = frame_time(frames_) - begin;
  const double first = max(from, watched.window.from), last = min(frame_time(frames_), watched.window.until);
  if (!(first < last)) return;
  const double middle = (0.5 * (first + last) - begin) / length;
  found.integral.add(sign * (last - first) * (sums_[k].front() + middle * (sums_[k].back() - sums_[k].front())));
  found.seconds.add(sign * (last - first) * double(watched.count));
}

/// The last frame may end after the present time.
vector<Extremes> BookSimulator::extremes() const {
  vector<Extremes> all = extremes_;
  const optional<RunEnd>& end = log_.tally().end;
  const double time = end ? min(time_, end->time) : time_;
  for (size_t k = 0; k < all.size(); ++k)
    if (frames_ > 0 && frame_time(frames_) - time > rounding_) integrate(k, time, -1, all[k]);
  return all;
}

void BookSimulator::record(const Collision& collision) {
  log_.lose(collision.energy_lost);
  log_.record(collision);
}

/// Listing 8.4, HandleCollision.
void BookSimulator::handle_pair(Entity a, Entity b) {
  const Vec3 d = x_[b] - x_[a];
  const double distance = d.norm();
  if (distance == 0)
    throw SimulationError(
        fmt::format("at t = {} s two centres coincide and the line of centres, d/|d|, is undefined: use a smaller "
                    "simulate.step, or "
                    "engine: exact",
                    frame_time(frames_)));

  const Vec3 n = d / distance;
  const double ua = v_[a].dot(n);
  const double ub = v_[b].dot(n);
  log_.note_overlap(world_.radius[a] + world_.radius[b] - distance);
  if (ua <= ub && !options_.as_printed) return;

  // The speeds along the line of centres after the impact.
  const double ma = world_.mass[a];
  const double mb = world_.mass[b];
  const double e = options_.as_printed
                       ? combine_restitution(Combine::book, world_.restitution[a], ma, world_.restitution[b], mb)
                       : pair_restitution(world_, a, b);
  const double after_a = ((ma - e * mb) * ua + (1 + e) * mb * ub) / (ma + mb);
  const double after_b = ((mb - e * ma) * ub + (1 + e) * ma * ua) / (ma + mb);
  v_[a] += (after_a - ua) * n;
  v_[b] += (after_b - ub) * n;

  // As printed, the acceleration becomes v'/dt.
  if (options_.as_printed) {
    force_[a] = v_[a] / options_.step * ma;
    force_[b] = v_[b] / options_.step * mb;
  }

  const double approach = ua - ub;
  const double separation = after_b - after_a;
  record(with_effect(world_, {frame_time(frames_), CollisionKind::body_body, a, b, x_[a] + world_.radius[a] * n, n,
                              approach, separation, e}));
}

/// The plane test of the text: a body above the plane and nearer than its radius has collided. `normal` points to the
/// body's side.
void BookSimulator::handle_fixed(Entity i, Entity surface, const Vec3& point, const Vec3& normal) {
  const double height = (x_[i] - point).dot(normal);
  if (height < 0 || height >= world_.radius[i] || !may_meet(world_, i, surface)) return;
  log_.note_overlap(world_.radius[i] - height);
  const double approach = -v_[i].dot(normal);
  if (approach <= 0) return;
  const double e = pair_restitution(world_, i, surface);
  v_[i] += (1 + e) * approach * normal;
  record(with_effect(world_, {frame_time(frames_), CollisionKind::body_fixed, i, surface,
                              x_[i] - world_.radius[i] * normal, -normal, approach, e * approach, e}));
}

/// One frame of listing 8.3: forces, overlaps, update.
void BookSimulator::do_frame() {
  find_forces();
  handle_pairs();
  handle_surfaces();
  move();
  ++frames_;
  take_extremes();
  record_paths();
}

/// The straight lines of the last frame. Each holds from just after the time of the frame before.
void BookSimulator::record_paths() {
  if (!options_.record_paths) return;
  const double end = frame_time(frames_);
  const double from = frames_ == 0 ? 0 : std::nextafter(frame_time(frames_ - 1) + rounding_, end);
  for (Entity i = 0; i < world_.body_count(); ++i) {
    const bool lies = v_[i].isZero(0);
    if (!(lies && lies_[i] != 0)) {
      PathPiece& piece = pieces_.emplace_back(PathPiece{i, from, {end, 0}, x_[i], v_[i]});
      piece.law = PathLaw::frame;
      piece.rounding = rounding_;
    }
    lies_[i] = lies;
  }
}

/// The impulse of a scene is a force that lasts for the first frame only.
void BookSimulator::find_forces() {
  for (Entity i = 0; i < world_.body_count(); ++i) {
    force_[i] = world_.mass[i] * world_.gravity;
    if (frames_ == 0 && !world_.impulse.empty()) force_[i] += world_.impulse[i] / options_.step;
  }
}

void BookSimulator::handle_pairs() {
  const Entity n = world_.body_count();
  for (Entity a = 0; a + 1 < n; ++a)
    for (Entity b = a + 1; b < n; ++b) {
      const double reach = world_.radius[a] + (options_.as_printed ? world_.radius[a] : world_.radius[b]);
      if ((x_[a] - x_[b]).squaredNorm() < reach * reach && may_meet(world_, a, b)) handle_pair(a, b);
    }
}

void BookSimulator::handle_surfaces() {
  const Entity n = world_.body_count();
  for (Entity i = 0; i < n; ++i) {
    for (size_t k = 0; k < world_.planes.size(); ++k)
      handle_fixed(i, n + Entity(k), world_.planes[k].point, world_.planes[k].normal);
    for (size_t k = 0; k < world_.walls.size(); ++k) {
      // A wall acts as a plane over its extent. At its rim the direction is that from its closest point.
      const Vec3 nearest = nearest_on_wall(world_.walls[k], x_[i]);
      const Vec3 away = x_[i] - nearest;
      if (away.squaredNorm() > 0) handle_fixed(i, n + Entity(world_.planes.size() + k), nearest, away / away.norm());
    }
  }
}

/// Semi-implicit Euler. Also adds the work of every force except gravity: that of the impulse, and of the velocity that
/// the printed listing adds twice.
void BookSimulator::move() {
  const double dt = options_.step;
  for (Entity i = 0; i < world_.body_count(); ++i) {
    const Vec3 before = v_[i];
    v_[i] += force_[i] / world_.mass[i] * dt;
    x_[i] += v_[i] * dt;
    if (!bounds_.contain(x_[i], v_[i]))
      fail_out_of_bounds(bounds_, i, frame_time(frames_), x_[i], v_[i],
                         {.speed = "use a smaller simulate.step, or engine: exact"});
    log_.note_speed(i, v_[i].norm());
    const Vec3 other = force_[i] - world_.mass[i] * world_.gravity;
    if (!other.isZero(0)) log_.add_work(0.5 * other.dot(before + v_[i]) * dt);
  }
}

/// Regions see the bodies at frames only.
void BookSimulator::find_crossings() {
  size_t k = 0;
  for (uint32_t r = 0; r < world_.regions.size(); ++r) {
    const WorldRegion& region = world_.regions[r];
    for (Entity i = 0; i < world_.body_count(); ++i, ++k) {
      if (!region.on.empty() && !std::binary_search(region.on.begin(), region.on.end(), i)) continue;
      const bool now = holds(region, x_[i]);
      if (now == (inside_[k] != 0)) continue;
      inside_[k] = now;
      crossings_.push_back({frame_time(frames_), r, i, now});
      if (now && region.stops) end_at(frame_time(frames_), EndReason::region, r);
    }
  }
}

bool BookSimulator::rests() const {
  return world_.gravity.isZero(0) && (frames_ > 0 || world_.impulse.empty()) &&
         all_of(v_, [](const Vec3& v) { return v.isZero(0); });
}

void BookSimulator::end_at(double time, EndReason reason, uint32_t region) {
  if (!end_) end_ = RunEnd{time, reason, region};
}

/// Ends the run if its end is at `time` (s) at the latest.
bool BookSimulator::end_until(double time) {
  if (!end_ || time < end_->time) return false;
  log_.end(*end_);
  time_ = max(time_, end_->time);
  return true;
}

void BookSimulator::advance_to(double time) {
  log_.begin_advance();
  crossings_.clear();
  pieces_.clear();

  if (log_.tally().end) {
    time_ = max(time, time_);
    return;
  }

  // Bodies may be in regions, or rest, at the start.
  if (frames_ == 0 && time_ == 0) {
    find_crossings();
    if (options_.stop_at_rest && rests()) end_at(0, EndReason::rest);
  }
  if (end_until(time)) return;

  // A time within rounding of a frame's time belongs to that frame.
  for (int frames = 1; frame_time(frames_) + rounding_ < time; ++frames) {
    do_frame();
    find_crossings();
    if (options_.stop_collisions > 0 && log_.tally().collisions() >= options_.stop_collisions)
      end_ = RunEnd{log_.tally().last_collision, EndReason::collisions, 0};
    if (options_.stop_at_rest && rests()) end_at(frame_time(frames_), EndReason::rest);
    if (end_until(time)) return;

    if (!log_.has_room(room_for_frame) || frames == frames_at_a_time || pieces_.size() >= path_buffer) {
      time_ = min(frame_time(frames_), time);
      return;
    }
  }

  time_ = max(time, time_);
}

/// Forces are found anew in each frame.
template <typename Archive>
void BookSimulator::keep(Archive& archive) {
  archive.same(options_.step, options_.as_printed, options_.record_collisions, options_.record_paths);
  archive.sized(x_, v_, inside_, lies_, extremes_, sums_);
  archive(frames_, time_, log_, crossings_, pieces_, end_);
}

string BookSimulator::save() {
  StateWriter archive;
  keep(archive);
  return archive.take();
}

void BookSimulator::restore(string_view bytes) {
  StateReader archive(bytes, world_);
  keep(archive);
  archive.finish();
}

/// Between frames a body is on the straight line of the frame's update.
const State& BookSimulator::state() {
  const optional<RunEnd>& end = log_.tally().end;
  state_.time = end ? min(time_, end->time) : time_;
  state_.position = x_;
  state_.velocity = v_;
  const double ahead = frame_time(frames_) - state_.time;
  if (ahead > rounding_)
    for (Entity i = 0; i < world_.body_count(); ++i) state_.position[i] -= ahead * v_[i];
  return state_;
}

}  // namespace

unique_ptr<Simulator> make_book_simulator(const World& world, const State& initial, const BookOptions& options) {
  return make_unique<BookSimulator>(world, initial, options);
}

}  // namespace carom
