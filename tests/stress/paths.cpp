#include "stress/paths.h"

#include <cstdio>

#include "physics/world.h"
#include "std.h"
#include "stress/gaps.h"

namespace carom::stress {

namespace {

constexpr double relative_rounding = 2e-14;
constexpr int most_evaluations = 100;  // at a pair's gap between two outputs

double extent_of(const Vec3& x) {
  return x.cwiseAbs().sum();
}

Long3 on(const Long3& x, const Long3& v, const Long3& a, long double t) {
  return x + t * (v + 0.5L * t * a);
}

}  // namespace

Paths::Paths(const RandomScene& scene, const vector<double>& times, const Watched& seen,
             const vector<Collision>& records, double in_contact)
    : scene_(scene), times_(times), seen_(seen), in_contact_(in_contact), recorded_(scene.world.body_count()) {
  const World& world = scene.world;
  for (const Collision& c : records)
    for (Entity i : {c.a, c.b})
      if (world.is_body(i)) recorded_[i].push_back(c.time);

  for (Entity i = 0; i < world.body_count(); ++i) {
    double extent = extent_of(scene.initial.position[i]) + world.radius[i];
    for (const State& s : seen.seen) extent = std::max(extent, extent_of(s.position[i]) + world.radius[i]);
    extent_.push_back(extent);
  }

  const auto farthest = [&](Entity e) {
    double most = extent_of(world.fixed_position(e));
    for (const double t : times) most = std::max(most, extent_of(fixed_position(world, e, {t, 0})));
    return most;
  };

  Entity e = world.body_count();
  for (size_t k = 0; k < world.planes.size(); ++k) extent_.push_back(farthest(e++));
  for (const Wall& w : world.walls) extent_.push_back(farthest(e++) + w.half_width + w.half_height);
  for (const Obstacle& o : world.obstacles) extent_.push_back(farthest(e++) + o.volume.reach());
}

double Paths::rounding(Entity a, Entity b) const {
  return relative_rounding * (extent_[a] + extent_[b]);
}

double Paths::allowed(Entity a, Entity b) const {
  const World& world = scene_.world;
  const double smaller = world.is_body(b) ? std::min(world.radius[a], world.radius[b]) : world.radius[a];
  return rounding(a, b) + in_contact_ * smaller;
}

/// Whether body i drifts straight all the time.
bool Paths::drifts(Entity i, double from, double until) const {
  const vector<Piece>& pieces = seen_.pieces[i];
  const auto next =
      std::upper_bound(pieces.begin(), pieces.end(), from, [](double t, const Piece& p) { return t < p.from; });
  return next != pieces.begin() && std::prev(next)->drifts && (next == pieces.end() || next->from >= until);
}

/// The paths from sample k to the next.
vector<Paths::Path> Paths::between(size_t k) const {
  const World& world = scene_.world;
  const State &now = seen_.seen[k], &then = seen_.seen[k + 1];
  const double h = times_[k + 1] - times_[k];
  vector<Path> paths;
  for (Entity i = 0; i < world.body_count(); ++i) {
    Path path{now.position[i], now.velocity[i], Vec3::Zero(), true};
    path.a = (then.velocity[i] - now.velocity[i]) / h;
    const Vec3 end = path.x + h * (path.v + 0.5 * h * path.a);
    const double way = h * (now.velocity[i].norm() + then.velocity[i].norm());
    const auto next = std::upper_bound(recorded_[i].begin(), recorded_[i].end(), times_[k]);
    path.known = (next == recorded_[i].end() || *next >= times_[k + 1]) &&
                 (end - then.position[i]).norm() <= 1e-14 * (extent_[i] + way);
    // In a step of a crowd bodies drift straight, whatever their velocities are at its instants.
    if (drifts(i, times_[k], times_[k + 1])) {
      path.v = (then.position[i] - now.position[i]) / h;
      path.a.setZero();
      path.known = true;
    }
    paths.push_back(path);
  }
  return paths;
}

/// The least gap (m) of a pair on its paths: where the gap at two instants and the speeds leave room for less, between
/// them.
double Paths::deepest(const World& world, Entity a, const Path& pa, Entity b, const Path& pb, double length) const {
  const bool body = world.is_body(b);
  const Long3 xa = pa.x.cast<long double>(), va = pa.v.cast<long double>(), aa = pa.a.cast<long double>();
  const Long3 xb = pb.x.cast<long double>(), vb = pb.v.cast<long double>(), ab = pb.a.cast<long double>();

  const double speed =
      std::max((pa.v - pb.v).norm(), ((pa.v - pb.v) + length * (pa.a - pb.a)).norm());  // it is greatest at an end
  if (body || world.is_obstacle(b)) {
    const double reach = world.radius[a] + (body ? world.radius[b] : world.obstacle(b).volume.reach());
    if ((pa.x - pb.x).norm() - reach > speed * length) return 1;
  }

  const auto at = [&](double t) { return static_cast<double>(gap(world, a, on(xa, va, aa, t), b, on(xb, vb, ab, t))); };

  struct Span {
    double from, to, at_from, at_to, least;
    bool operator<(const Span& other) const { return least > other.least; }
  };

  const auto span = [&](double from, double to, double at_from, double at_to) {
    return Span{from, to, at_from, at_to, 0.5 * (at_from + at_to - speed * (to - from))};
  };

  const double tolerance = allowed(a, b);
  double least = at(0);
  vector<Span> spans;
  const double end = at(length);
  least = std::min(least, end);
  spans.push_back(span(0, length, least, end));
  spans.back().at_from = at(0);

  for (int evaluations = 0; evaluations < most_evaluations && !spans.empty() && spans.front().least < -tolerance;
       ++evaluations) {
    std::pop_heap(spans.begin(), spans.end());
    const Span s = spans.back();
    spans.pop_back();
    const double middle = 0.5 * (s.from + s.to), there = at(middle);
    least = std::min(least, there);

    if (least < -tolerance) break;
    // The span is cut in two.
    spans.push_back(span(s.from, middle, s.at_from, there));
    std::push_heap(spans.begin(), spans.end());
    spans.push_back(span(middle, s.to, there, s.at_to));
    std::push_heap(spans.begin(), spans.end());
  }
  return least;
}

vector<string> Paths::overlaps() const {
  vector<string> found;
  set<pair<Entity, Entity>> known;
  World world = scene_.world;
  const Entity bodies = world.body_count(), all = bodies + world.fixed_count();

  for (size_t k = 0; k + 1 < times_.size(); ++k) {
    const State& s = seen_.seen[k];
    if (!s.part_of.empty()) {
      world.mass = s.mass;
      world.radius = s.radius;
      if (!world.volume.empty()) world.volume = s.volume;
    }

    const auto gone = [&](Entity e) { return e < bodies && !s.part_of.empty() && s.part_of[e] != e; };
    const vector<Path> paths = between(k);
    const double length = times_[k + 1] - times_[k];

    for (Entity a = 0; a < bodies; ++a) {
      if (gone(a)) continue;
      for (Entity b = a + 1; b < all; ++b) {
        if (gone(b) || known.contains({a, b})) continue;
        const Path there = b < bodies ? paths[b]
                                      : Path{fixed_position(world, b, {times_[k], 0}),
                                             fixed_velocity(world, b, {times_[k], 0}), Vec3::Zero(), true};

        const bool dense = paths[a].known && there.known;
        double least;
        if (dense) {
          least = deepest(world, a, paths[a], b, there, length);
        } else {
          least = static_cast<double>(gap(world, a, paths[a].x.cast<long double>(), b, there.x.cast<long double>()));
        }
        if (least >= -allowed(a, b)) continue;

        known.insert({a, b});
        char text[200];
        std::snprintf(text, sizeof text, "%u and %u overlap by %.6g m (allowed: %.2g) %s t = %.17g and %.17g", a, b,
                      -least, allowed(a, b), dense ? "between" : "at the first of", times_[k], times_[k + 1]);
        found.emplace_back(text);
      }
    }
  }
  return found;
}

}  // namespace carom::stress
