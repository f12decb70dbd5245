// Jacobi's method: in each round every ball moves by the mean of what its overlaps ask of it. One pair after the other
// (Gauss and Seidel) would take fewer rounds, but its result depends on the order of the balls.
#include "scene/push.h"

#include "geometry/touch.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "scene/grid.h"
#include "std.h"

namespace carom {
namespace {

/// The gap that a pair aims at, as a share of the smaller radius. The rounds approach it, and end at a gap above 0.
constexpr double aimed_gap = 1e-6;
/// Pairs with a gap below this share of the ball's radius are watched.
constexpr double watched_gap = 0.02;
constexpr double most_rounds = 20'000;
/// Pairs in all rounds. A second takes 4e7.
constexpr double most_pairs = 2e9;
/// Of the step of a ball with several overlaps. From 2 on, balls in a row would swing to and fro.
constexpr double relaxation = 1.8;

class Pusher {
 public:
  Pusher(const World& world, span<const Entity> movable, span<const Entity> others, vector<Vec3>& position)
      : world_(world), movable_(movable), others_(others), position_(position) {
    for (const Entity ball : movable_) least_ = min(least_, world_.radius[ball]);
  }

  optional<PushedPair> run() {
    watch();
    for (const Watched& pair : pairs_)
      if (depth_of(pair).depth >= most_pushed * smaller_radius(pair)) return nullopt;

    double pairs = 0;
    for (int round = 0; round < most_rounds && pairs < most_pairs; ++round, pairs += double(pairs_.size()))
      if (!move()) return nullopt;
    return deepest();
  }

 private:
  /// A movable ball and something near it, which moves too if it is another of the movable balls.
  struct Watched {
    Entity ball, other;
    bool both, two_balls;
  };

  bool is_movable(Entity body) const { return ranges::binary_search(movable_, body); }
  const Vec3& place(Entity e) const { return world_.is_body(e) ? position_[e] : world_.fixed_position(e); }

  double smaller_radius(const Watched& pair) const {
    const double own = world_.radius[pair.ball];
    return world_.is_body(pair.other) ? min(own, world_.radius[pair.other]) : own;
  }

  /// How deep a pair overlaps, and the unit vector from the ball to the other.
  struct Depth {
    double depth;  // m; 0: not beyond the rounding of the coordinates
    Vec3 normal;
  };

  Depth depth_of(const Watched& pair) const {
    const Vec3 &a = position_[pair.ball], &b = place(pair.other);
    Depth found{0, Vec3::Zero()};
    if (pair.two_balls) {
      const double sum = world_.radius[pair.ball] + world_.radius[pair.other], distance2 = (b - a).squaredNorm();
      if (distance2 >= sum * sum) return found;
      const double distance = sqrt(distance2);
      found = {sum - distance, distance > 0 ? Vec3((b - a) / distance) : Vec3(0, 1, 0)};
    } else {
      const Touch now = touch(world_, pair.ball, a, pair.other, b);
      found = {-now.gap, now.normal};
    }

    if (found.depth <= touch_tolerance(0, 0, a, b)) found.depth = 0;
    return found;
  }

  /// Finds the pairs that are near one another, each once.
  void watch() {
    pairs_.clear();
    travelled_ = 0;

    // Volumes count as the balls around them. The larger of two balls sees farther, so it is the one that watches.
    vector<Entity> all(movable_.begin(), movable_.end());
    all.insert(all.end(), others_.begin(), others_.end());
    ranges::stable_sort(all, [&](Entity a, Entity b) { return world_.radius[a] > world_.radius[b]; });
    BodyGrid grid;
    grid.reserve(all.size());
    for (const Entity e : all) grid.insert({position_[e], world_.radius[e], e});

    const auto end = Entity(world_.body_count() + world_.planes.size() + world_.walls.size() + world_.obstacles.size());
    for (const Entity ball : movable_) {
      const double radius = world_.radius[ball];
      set<Entity> near;
      for (const auto& overlap : grid.all_overlaps({position_[ball], radius * (1 + watched_gap), ball}, 0))
        if (may_meet(world_, ball, overlap.entity)) near.insert(overlap.entity);
      for (const Entity other : near) {
        const bool both = is_movable(other), is_watcher = tie(radius, ball) > tie(world_.radius[other], other);
        const bool is_ball = world_.volume_of(other).shape == Shape::sphere;
        if (other != ball && (!both || is_watcher)) pairs_.push_back({ball, other, both, is_ball});
      }

      for (Entity fixed = world_.body_count(); fixed < end; ++fixed)
        if (may_meet(world_, ball, fixed) &&
            touch(world_, ball, position_[ball], fixed, world_.fixed_position(fixed)).gap < watched_gap * radius)
          pairs_.push_back({ball, fixed, false, false});
    }
  }

  /// One round. False: nothing overlaps, and nothing has moved.
  bool move() {
    shift_.assign(position_.size(), Vec3::Zero());
    asked_.assign(position_.size(), 0);
    bool any = false;
    for (const Watched& pair : pairs_) {
      const auto [depth, normal] = depth_of(pair);
      if (depth == 0) continue;

      any = true;
      const Vec3 way = (depth + aimed_gap * smaller_radius(pair)) * (pair.both ? 0.5 : 1.0) * normal;
      shift_[pair.ball] -= way;
      ++asked_[pair.ball];
      if (!pair.both) continue;
      shift_[pair.other] += way;
      ++asked_[pair.other];
    }

    double farthest = 0;
    for (const Entity ball : movable_) {
      if (asked_[ball] == 0) continue;
      const Vec3 step = (asked_[ball] > 1 ? relaxation : 1.0) / asked_[ball] * shift_[ball];
      position_[ball] += step;
      farthest = max(farthest, step.norm());
    }

    // Two balls that approach are watched before they meet.
    travelled_ += farthest;
    if (2 * travelled_ > watched_gap * least_) watch();
    return any;
  }

  optional<PushedPair> deepest() const {
    optional<PushedPair> worst;
    for (const Watched& pair : pairs_) {
      const double depth = depth_of(pair).depth;
      if (depth > (worst ? worst->depth : 0)) worst = {pair.ball, pair.other, depth};
    }
    return worst;
  }

  const World& world_;
  const span<const Entity> movable_, others_;
  vector<Vec3>& position_;
  vector<Watched> pairs_;
  vector<Vec3> shift_;       // m, by body
  vector<int> asked_;        // by how many overlaps, by body
  double least_ = infinity;  // m, the least radius
  double travelled_ = 0;     // m, at most, since the pairs were found
};

}  // namespace

optional<PushedPair> push_apart(const World& world, span<const Entity> movable, span<const Entity> others,
                                vector<Vec3>& position) {
  return Pusher(world, movable, others, position).run();
}

}  // namespace carom
