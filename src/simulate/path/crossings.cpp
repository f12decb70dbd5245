// Crossings along flights of every kind. A parabola is followed at once to its end. A path under drag is followed in
// spans for which a polynomial is accurate, and a step of a method is one.
// Rounding moves a boundary as seen from a path. Crossings by less than that are none, which no order of rounding
// errors can then double or lose: a ball that bounces with its lowest point on a boundary, or lies there, never crosses
// it.
#include "simulate/path/crossings.h"

#include <tuple>

#include "geometry/region_crossing.h"
#include "physics/world.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

Crossings::Crossings(const BodyPaths& bodies, function<Instant(Entity)> flight_end)
    : bodies_(bodies), flight_end_(std::move(flight_end)), next_(bodies.body.size()) {
  if (!any()) return;
  const size_t n = bodies.body.size();
  queue_.emplace(uint32_t(n), Before{this});
  const vector<WorldRegion>& regions = bodies.world.regions;
  standing_.assign(regions.size() * n, outside);
  for (uint32_t r = 0; r < regions.size(); ++r) {
    if (regions[r].on.empty()) continue;
    std::fill_n(standing_.begin() + ptrdiff_t(r * n), n, apart);
    for (const Entity i : regions[r].on) standing(r, i) = outside;
  }
}

void Crossings::begin_advance() {
  for (const RegionCrossing& crossing : recorded_) latest_ = max(latest_, crossing.time);
  recorded_.clear();
}

Instant Crossings::first_sure() const {
  if (!queue_ || !(queue_->first_time() < never)) return {never, 0};
  return next_[queue_->first()].back().sure;
}

bool Crossings::before(Entity i, Entity j) const {
  const Next &p = next_[i].back(), &q = next_[j].back();
  if (p.sure != q.sure) return p.sure < q.sure;
  return tie(p.region, i) < tie(q.region, j);
}

void Crossings::follow(Entity i, const Instant& from) {
  if (bodies_.mode(i) == Mode::awaited) return;
  if (!is_in_world(bodies_.mode(i))) return forget(i);
  if (!next_[i].empty()) next_.write(i).clear();
  for (uint32_t r = 0; r < bodies_.world.regions.size(); ++r)
    if (standing(r, i) != apart) find(i, r, from);
  schedule(i);
}

void Crossings::forget(Entity i) {
  if (!next_[i].empty()) next_.write(i).clear();
  for (uint32_t r = 0; r < bodies_.world.regions.size(); ++r) standing(r, i) = apart;
  schedule(i);
}

/// Finds body i's next crossing of a region from an instant of its flight on.
void Crossings::find(Entity i, uint32_t region, const Instant& from) {
  namespace tol = exact_tolerance;
  const WorldRegion& where = bodies_.world.regions[region];
  const Flight f = bodies_.flights[i];
  const Instant end = min(flight_end_(i), Instant{bodies_.options.duration, 0});
  const double horizon = end - f.start;
  const double margin =
      tol::position_rounding * (f.x.cwiseAbs().sum() + where.position.cwiseAbs().sum() + where.volume.half.maxCoeff());

  // Follows the flight in spans for which one polynomial is accurate, or at once to its end.
  double t = max(from - f.start, 0.0);
  while (t < horizon) {
    optional<CrossingTime> found;
    double start = 0;
    double length = horizon;
    if (f.is_straight()) {
      found = next_crossing(where, CenterPath::along(f.x, f.v, f.a, horizon), t, standing(region, i) == inside, margin);
    } else {
      start = t;
      length = min(f.span_of_fade(t), horizon - t);
      found = next_crossing(where, CenterPath::along(f.position(t), f.displacement_from(t, length), length), 0,
                            standing(region, i) == inside, margin);
    }

    if (found) {
      // The clock rounds too.
      const double sure = (start + found->sure) * (1 + tol::crossing_rounding);
      if (sure > horizon) return;
      next_.write(i).push_back({region, f.start + (start + found->at), f.start + sure});
      return;
    }

    t = start + length;
  }
}

/// Sorts body i's crossings, and enters the first into the queue.
void Crossings::schedule(Entity i) {
  if (next_[i].empty()) return queue_->update(i, never);
  vector<Next>& next = next_.write(i);
  ranges::sort(
      next, [](const Next& p, const Next& q) { return q.sure < p.sure || (p.sure == q.sure && q.region < p.region); });
  queue_->update(i, next.back().sure.hi);
}

Crossings::Taken Crossings::take(Entity i) {
  const Next next = next_[i].back();
  next_.write(i).pop_back();
  Standing& now = standing(next.region, i);
  now = now == inside ? outside : inside;
  const RegionCrossing crossing{max(next.at.hi, latest_), next.region, i, now == inside};
  recorded_.push_back(crossing);
  find(i, next.region, next.sure);
  schedule(i);
  return {crossing, next.at, next.sure};
}

optional<Crossings::Taken> Crossings::take_until(double time) {
  for (Entity i = 0; i < bodies_.body.size(); ++i)
    if (optional<Taken> taken = take_of(i, {time, never})) return taken;
  return nullopt;
}

optional<Crossings::Taken> Crossings::take_of(Entity i, const Instant& last) {
  const vector<Next>& next = next_[i];
  const auto due = ranges::find_if(next, [&](const Next& one) { return one.at <= last; });
  if (due == next.end()) return nullopt;
  vector<Next>& all = next_.write(i);
  std::rotate(all.begin() + (due - next.begin()), all.begin() + (due - next.begin()) + 1, all.end());
  return take(i);
}

void Crossings::sort() {
  // A body appears before it enters regions.
  const auto key = [](const RegionCrossing& c) {
    return std::tuple(c.time, c.region != RegionCrossing::world, c.region, c.body);
  };
  ranges::sort(recorded_, [&](const RegionCrossing& p, const RegionCrossing& q) { return key(p) < key(q); });
}

}  // namespace carom
