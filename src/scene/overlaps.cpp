// Tests bodies from the largest to the smallest against those already in the grid, which keeps the searches cheap.
// Errors are sorted by the bodies' numbers afterwards, so that their order is that of the file.
#include "scene/overlaps.h"

#include <fmt/format.h>

#include <tuple>

#include "physics/world.h"
#include "scene/push.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// More overlaps are one error.
constexpr size_t most_shown_singly = 4;
// Then bodies that overlap leave the grid. A heap of bodies in one place must not cost n^2.
constexpr size_t max_overlaps_kept = 100'000;
// A share of the smaller reach. Places are decimals that were rounded by hand.
constexpr double rounding_of_places = 1e-9;

struct Found {
  Entity later, other;
  double depth;  // m
  Place place;   // of the later one's position
};

/// The overlaps of a scene, one for each body and thing.
class Overlaps {
 public:
  Overlaps(const Scene& scene, Diagnostics& diagnostics)
      : scene_(scene), world_(scene.world), diagnostics_(diagnostics) {}

  size_t size() const { return found_.size(); }
  void add(const Found& found) { found_.push_back(found); }

  void report() {
    ranges::stable_sort(found_,
                        [](const Found& a, const Found& b) { return tie(a.later, a.other) < tie(b.later, b.other); });
    if (found_.size() > most_shown_singly) return report_deepest();
    for (const Found& found : found_)
      diagnostics_.add(found.place, message(found),
                       is_behind(found) ? "expected it on the side that the normal points to"
                                        : "expected bodies apart, or just touching" + push_text(found));
  }

 private:
  bool is_behind(const Found& found) const {
    return world_.is_plane(found.other) &&
           found.depth > 2 * world_.volume_of(found.later).support(world_.plane(found.other).normal);
  }

  /// What may help a ball of a group that lists its balls.
  string push_text(const Found& found) const {
    const auto is_of_group = [&](Entity e) { return world_.is_body(e) && scene_.roster.range_of(e).group; };
    if (!is_of_group(found.later) && !is_of_group(found.other)) return "";
    return fmt::format("\n`overlap: push` of a group moves apart what overlaps by less than {} of the smaller radius",
                       most_pushed);
  }

  string message(const Found& found) const {
    const string a = in_backticks(scene_.roster.name(found.later));
    const string b = in_backticks(scene_.roster.name(found.other));
    return is_behind(found) ? fmt::format("{} is behind {} at the start", a, b)
                            : fmt::format("{} overlaps {} by {:.6g} m at the start", a, b, found.depth);
  }

  /// One error for all, at the deepest.
  void report_deepest() {
    const Found& deepest =
        *ranges::max_element(found_, [](const Found& a, const Found& b) { return a.depth < b.depth; });
    set<Entity> bodies;
    for (const Found& found : found_)
      for (const Entity entity : {found.later, found.other})
        if (entity < world_.body_count()) bodies.insert(entity);
    const bool some_left_out = found_.size() > max_overlaps_kept;
    string remedy =
        fmt::format("expected bodies apart, or just touching to {} of the smaller one", rounding_of_places) +
        push_text(deepest);
    if (const double share = common_share(); share < 1) {
      // Rounded up to two digits, so that radii with these digits do.
      const double digit = pow(10, floor(std::log10(share)) - 1);
      remedy += fmt::format("\nradii smaller by {:.2g} of their size leave none", ceil(share / digit) * digit);
    }
    diagnostics_.add(
        deepest.place,
        fmt::format("{}, the deepest of {} overlaps of {} bodies", message(deepest),
                    some_left_out ? fmt::format("more than {}", max_overlaps_kept) : to_string(found_.size()),
                    bodies.size()),
        remedy);
  }

  /// The share by which all radii must shrink. 1: a body is no ball, or lies behind a plane.
  double common_share() const {
    const auto is_ball = [&](Entity entity) { return world_.volume_of(entity).shape == Shape::sphere; };
    double share = 0;
    for (const Found& found : found_) {
      const bool both = found.other < world_.body_count();
      if (!is_ball(found.later) || (both && !is_ball(found.other))) return 1;
      share = max(share, found.depth / (world_.radius[found.later] + (both ? world_.radius[found.other] : 0)));
    }
    return share;
  }

  const Scene& scene_;
  const World& world_;
  Diagnostics& diagnostics_;
  vector<Found> found_;
};

}  // namespace

void check_overlaps(const Scene& scene, vector<SingleBody> singles, BodyGrid& grid, BodyGrid& obstacles,
                    Diagnostics& diagnostics) {
  const World& world = scene.world;
  const auto member = [&](Entity body) {
    return BodyGrid::Member{scene.initial.position[body], world.radius[body], body};
  };

  const vector<SingleBody> by_number = singles;
  const auto place_of = [&](Entity body) {
    return std::lower_bound(by_number.begin(), by_number.end(), body,
                            [](const SingleBody& single, Entity e) { return single.body < e; })
        ->position;
  };

  // Large bodies first, which makes the grid's searches cheap.
  ranges::stable_sort(
      singles, [&](const SingleBody& a, const SingleBody& b) { return world.radius[a.body] > world.radius[b.body]; });
  Overlaps found(scene, diagnostics);

  // Bodies against those before them.
  for (const SingleBody& single : singles) {
    if (world.comes_later(single.body)) continue;
    if (const auto first = grid.find_overlap(member(single.body), rounding_of_places)) {
      const bool too_many = found.size() > max_overlaps_kept;
      vector<BodyGrid::Overlap> all{*first};

      if (!too_many) all = grid.all_overlaps(member(single.body), rounding_of_places);

      set<Entity> others;
      for (const BodyGrid::Overlap& overlap : all) {
        if (!others.insert(overlap.entity).second) continue;
        const bool is_later = single.body > overlap.entity;
        const Entity later = max(overlap.entity, single.body), other = min(overlap.entity, single.body);
        found.add({later, other, overlap.depth, is_later ? single.position : place_of(later)});
      }

      if (too_many) continue;
    }

    grid.insert(member(single.body));
  }

  // Obstacles may stand in one another. One with an error has no volume.
  vector<BodyGrid::Member> members;
  const auto surfaces = Entity(world.planes.size() + world.walls.size());
  for (size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& obstacle = world.obstacles[i];
    if (!(obstacle.volume.reach() > 0)) continue;
    members.push_back({obstacle.center, obstacle.volume.reach(), world.body_count() + surfaces + Entity(i)});
  }

  ranges::stable_sort(members,
                      [](const BodyGrid::Member& a, const BodyGrid::Member& b) { return a.radius > b.radius; });
  for (const BodyGrid::Member& obstacle : members) obstacles.insert(obstacle);

  const auto may_leave = [&](const SingleBody& single, Entity e) {
    return world.comes_later(single.body) && world.moves(e);
  };

  for (const SingleBody& single : singles) {
    if (const auto overlap = obstacles.find_overlap(member(single.body), rounding_of_places)) {
      if (!may_leave(single, overlap->entity))
        found.add({single.body, overlap->entity, overlap->depth, single.position});
    }
    for (Entity surface = world.body_count(); surface < world.body_count() + surfaces; ++surface) {
      const Vec3& center = scene.initial.position[single.body];
      const auto depth = overlap_depth(world, single.body, center, surface, rounding_of_places);
      if (depth && !may_leave(single, surface)) {
        found.add({single.body, surface, *depth, single.position});
      }
    }
  }
  for (const BodyGrid::Member& obstacle : members) grid.insert(obstacle);

  found.report();
}

}  // namespace carom
