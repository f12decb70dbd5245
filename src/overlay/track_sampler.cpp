// Between two states without a collision the path is Hermite's polynomial of degree 3 through positions and velocities.
// Its error is |x''''| h^4 / 384. Forces change at most at the rate r (force_rate), so |x''''| is about r^4 times the
// extent of the motion, and h = 1 / (4 r) leaves 1e-5 of that extent. A collision is a kink at a known time: the path
// before it is followed from the state before, and the path after it back from the state after.
#include "overlay/track_sampler.h"

#include "physics/body_now.h"
#include "physics/coupled_forces.h"
#include "physics/force.h"
#include "std.h"

namespace carom {
namespace {

// Of a track's length: the longest time between states, which limits what kinks leave out, and the shortest.
constexpr double longest_part = 1.0 / 64, shortest_part = 1.0 / 4096;

TrackPiece hermite(double from, double until, const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1) {
  const double h = until - from;
  const Vec3 mean = (x1 - x0) / h;
  return {.from = from,
          .until = until,
          .start = {from, 0},
          .x = x0,
          .v = v0,
          .a = (6 * mean - 4 * v0 - 2 * v1) / h,
          .jerk = 6 * (v0 + v1 - 2 * mean) / (h * h)};
}

TrackPiece parabola(double from, double until, double at, const Vec3& x, const Vec3& v, const Vec3& a) {
  return {.from = from, .until = until, .start = {at, 0}, .x = x, .v = v, .a = a};
}

}  // namespace

TrackSampler::TrackSampler(const World& world, Tracks& tracks, double seconds)
    : world_(world), tracks_(tracks), seconds_(seconds), known_(world.body_count()) {}

void TrackSampler::record(span<const Collision> collisions) {
  for (const Collision& collision : collisions) {
    for (const Entity e : {collision.a, world_.second_body(collision.b)})
      if (world_.is_body(e) && tracks_.has(e)) known_[e].impacts.push_back(collision.time);
  }
}

size_t TrackSampler::add_path(Entity body, const Known& known, double time, const Known& now, bool ends) {
  if (known.impacts.empty()) {
    tracks_.add(body, hermite(time_, time, known.x, known.v, now.x, now.v));
    return 1;
  }

  const double first = known.impacts.front(), last = known.impacts.back();
  const TrackPiece before = parabola(time_, first, time_, known.x, known.v, known.a);
  tracks_.add(body, before);
  if (ends) return 1;

  const TrackPiece after = parabola(last, time, time, now.x, now.v, now.a);
  if (last > first) {
    // Between kinks that are known by their times alone, the path is taken as straight.
    const Vec3 corner = before.position(first), way = after.position(last) - corner;
    tracks_.add(body, parabola(first, last, first, corner, way / (last - first), Vec3::Zero()));
  }
  tracks_.add(body, after);
  return last > first ? 3 : 2;
}

vector<TrackSampler::CouplingNow> TrackSampler::couplings_now(const State& state) const {
  vector<CouplingNow> all(world_.body_count());
  if (!has_couplings(world_)) return all;

  const vector<Vec3> a = coupled_accelerations(world_, state);
  vector<double> inverse_mass;
  for (Entity i = 0; i < world_.body_count(); ++i) inverse_mass.push_back(1 / world_.mass[i]);
  const vector<double> exact(world_.body_count(), 0);
  const auto scales = coupled_forces(world_, state).scales(inverse_mass, state.position, state.velocity, exact);
  for (size_t i = 0; i < all.size(); ++i) all[i] = {a[i], scales[i].rate};
  return all;
}

void TrackSampler::sample(const State& state) {
  const bool own = !(state.time < next_);
  double step = longest_part * seconds_;
  const vector<CouplingNow> coupled = couplings_now(state);
  for (const Entity body : tracks_.bodies()) {
    Known& known = known_[body];
    if (known.ended) continue;
    tracks_.remove(body, exchange(known.tip, 0));

    const bool ends = is_gone(state, body);
    Known now{state.position[body], state.velocity[body], Vec3::Zero(), {}, ends, 0};
    now.a = coupled[body].acceleration + free_acceleration(world_, body, state.time, now.x, now.v);
    const size_t pieces = started_ && state.time > time_ ? add_path(body, known, state.time, now, ends) : 0;

    // Between the instants of its own, only the tip is drawn on.
    if (!own) {
      known.tip = pieces;
      continue;
    }

    const double rate = force_rate(world_, body, now.x, now.v) + coupled[body].rate;
    if (rate > 0) step = min(step, 1 / (4 * rate));
    known = std::move(now);
  }

  if (!own) return;
  started_ = true;
  time_ = state.time;
  next_ = time_ + max(step, shortest_part * seconds_);
}

}  // namespace carom
