// Of a view in one direction a motion leaves four numbers for each instant (frustum.h), and four for each body that may
// be flying away. Only the motion's end shows which of these return.
#include "render/motion_view.h"

#include "physics/body_now.h"
#include "std.h"

namespace carom {
namespace {

/// A body is a dot if it is lower than this part of the picture.
constexpr double dot = 0.01;
/// The free view around a body that a camera goes along with, in its own radii. It then has a tenth of the picture.
constexpr double room_alongside = 8;
/// The time after a collision that is in view, in that before it.
constexpr double time_after = 0.75;

bool meet(const Extent& a, const Extent& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

void join(Extent& to, const Extent& other) {
  to.low = to.low.cwiseMin(other.low);
  to.high = to.high.cwiseMax(other.high);
}

array<Vec3, 4> corners(const Wall& wall, const Vec3& center) {
  const Vec3 right = wall.half_width * wall.right, up = wall.half_height * wall.up;
  return {center - right - up, center + right - up, center + right + up, center - right + up};
}

bool is_drawn(const Scene& scene, size_t fixed) {
  return fixed >= scene.roster.fixed.size() || scene.roster.fixed[fixed].visible;
}

double median(vector<double> values) {
  const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The points that visible strings and springs hang from.
vector<Vec3> anchors_of(const Scene& scene) {
  vector<Vec3> anchors;
  const Overlay& overlay = scene.overlay;
  for (size_t k = 0; k < scene.world.strings.size(); ++k) {
    const String& string = scene.world.strings[k];
    if (string.other == no_entity && !ranges::binary_search(overlay.hidden_strings, k))
      anchors.push_back(string.anchor);
  }

  for (size_t k = 0; k < scene.world.forces.size(); ++k) {
    const Spring* const spring = std::get_if<Spring>(&scene.world.forces[k].law);
    if (spring != nullptr && ranges::find(overlay.hidden_springs, k) == overlay.hidden_springs.end())
      anchors.push_back(spring->anchor);
  }
  return anchors;
}

}  // namespace

void MotionView::Content::add(const Content& other) {
  reach.add(other.reach);
  join(bodies, other.bodies);
  join(near, other.near);
}

MotionView::MotionView(const Scene& scene, const MotionSamples& samples, double pace, double share)
    : scene_(scene),
      samples_(samples),
      anchors_(anchors_of(scene)),
      is_of_some_(scene.camera && !scene.camera->fit_on.empty()) {
  find_departures();
  find_scopes(pace, share < 1 ? place_of(share) : Place{});
  vector<double> radii;
  for (const Entity body : samples.bodies()) radii.push_back(scene.world.radius[body]);
  if (!radii.empty()) room_ = room_alongside * median(std::move(radii));
}

/// The ball around the middle of what happens that has a share of all impulses.
MotionView::Place MotionView::place_of(double share) const {
  struct Weighed {
    Vec3 at;
    double impulse;
  };
  vector<Weighed> strikes;
  double all = 0;
  for (size_t k = 0; k < samples_.instants(); ++k)
    for (size_t i = 0; i < samples_.bodies().size(); ++i)
      if (samples_.impulse(k, i) >= 0) {
        strikes.push_back({samples_.center(k, i), samples_.impulse(k, i)});
        all += strikes.back().impulse;
      }

  // The measure up to which strikes have a part of the impulses.
  const auto quantile = [&](double part, const auto& measure) {
    ranges::sort(strikes, std::less(), measure);
    double sum = 0;
    for (const Weighed& strike : strikes) {
      sum += strike.impulse;
      if (sum >= part * all) return measure(strike);
    }
    return infinity;
  };

  Place place;
  for (int axis = 0; axis < 3; ++axis)
    place.middle[axis] = quantile(0.5, [&](const Weighed& strike) { return strike.at[axis]; });
  place.reach2 = quantile(share, [&](const Weighed& strike) { return (strike.at - place.middle).squaredNorm(); });
  return place;
}

/// The scope of a sample follows from the time to the next collision of its body, and from the last one.
void MotionView::find_scopes(double pace, const Place& place) {
  const size_t bodies = samples_.bodies().size(), instants = samples_.instants();
  scope_.assign(instants * bodies, uint8_t(whole));
  const auto narrow = [&](size_t instant, size_t i, double film_s) {
    uint8_t& scope = scope_[instant * bodies + i];
    scope = min(scope, uint8_t(ranges::lower_bound(windows, film_s) - windows.begin()));
  };

  const auto counts = [&](size_t k, size_t i) {
    return samples_.impulse(k, i) >= 0 && (samples_.center(k, i) - place.middle).squaredNorm() <= place.reach2;
  };
  for (size_t i = 0; i < bodies; ++i) {
    double last = -infinity, next = infinity;
    for (size_t k = 0; k < instants; ++k) {
      if (counts(k, i)) last = samples_.time(k), strikes_.push_back({k, i});
      narrow(k, i, (samples_.time(k) - last) / (time_after * pace));
    }
    for (size_t k = instants; k-- > 0;) {
      if (counts(k, i)) next = samples_.time(k);
      narrow(k, i, (next - samples_.time(k)) / pace);
    }
  }

  quiet_ = strikes_.empty();
  if (!quiet_) return;
  for (size_t i = 0; i < bodies; ++i)
    for (size_t k = 0; k < instants; ++k)
      if (samples_.is_there(k, i)) strikes_.push_back({k, i}), scope_[k * bodies + i] = 0;
}

/// A body departs while it moves away from where all were at the start.
void MotionView::find_departures() {
  const size_t bodies = samples_.bodies().size(), instants = samples_.instants();
  departure_.assign(bodies, instants);
  if (instants == 0 || bodies == 0) return;
  Vec3 middle = Vec3::Zero();
  for (size_t i = 0; i < bodies; ++i) middle += samples_.center(0, i);
  middle /= double(bodies);

  for (size_t i = 0; i < bodies; ++i) {
    size_t k = instants - 1;
    const auto distance2 = [&](size_t instant) { return (samples_.center(instant, i) - middle).squaredNorm(); };
    while (k > 0 && samples_.is_there(k, i) && distance2(k) > distance2(k - 1)) --k;
    departure_[i] = k + 1;
  }
}

void MotionView::add(Content& content, const Frustum& frustum, const Vec3& center, const Volume& volume) const {
  frustum.add(content.reach, center, volume);
  content.bodies.include(center, volume.half);
}

void MotionView::add(Content& content, const Frustum& frustum, size_t instant, size_t i) const {
  if (!samples_.is_there(instant, i)) return;
  const Volume volume = samples_.volume(instant, i);
  add(content, frustum, samples_.center(instant, i), volume);
  content.near.include(samples_.center(instant, i), 3 * volume.half);
}

MotionView::Content MotionView::without_the_leaving(const Frustum& frustum) const {
  const size_t bodies = samples_.bodies().size(), instants = samples_.instants();
  Content content;
  for (size_t i = 0; i < bodies; ++i)
    for (size_t k = 0; k < min(departure_[i], instants); ++k) add(content, frustum, k, i);

  // The width of a view is proportional to the depth of one point.
  const Vec3 middle = content.bodies.middle();
  const auto depth = [&](const Content& of) { return frustum.depth(of.reach, middle); };

  vector<Content> departures;
  vector<pair<double, size_t>> leaving;  // by depth
  for (size_t i = 0; i < bodies; ++i) {
    if (departure_[i] >= instants) continue;
    Content& departure = departures.emplace_back();
    for (size_t k = departure_[i]; k < instants; ++k) add(departure, frustum, k, i);
    Content with = content;
    with.add(departure);
    leaving.emplace_back(depth(with), departures.size() - 1);
  }
  ranges::sort(leaving);

  const double largest_dot = leaving.empty() ? 0 : dot * frustum.height(1) / (2 * median(scene_.world.radius));
  size_t in_view = bodies - leaving.size();
  double with_half = depth(content);
  for (const auto& [alone, number] : leaving) {
    Content with = content;
    with.add(departures[number]);

    const double deep = depth(with);
    const bool has_half = 2 * in_view >= bodies;
    if (has_half && deep > 2 * with_half && deep * largest_dot > 1) break;

    content = with;
    ++in_view;
    if (!has_half) with_half = deep;
  }
  return content;
}

/// Where a fixed thing is while bodies are shown, where it goes farthest.
vector<Vec3> MotionView::places_of(Entity fixed) const {
  const World& world = samples_.world();
  const double start = samples_.time(0), end = samples_.time(samples_.instants() - 1);
  if (!world.moves(fixed)) return {fixed_position(world, fixed, {start, 0})};
  vector<Vec3> places;
  for (const double time : farthest_times(world.motion(fixed), start, end))
    places.push_back(fixed_position(world, fixed, {time, 0}));
  return places;
}

void MotionView::add_surroundings(Content& content, const Frustum& frustum) const {
  const World& world = scene_.world;
  const Extent bodies = content.bodies;
  const double size = (bodies.high - bodies.low).norm();

  // Floors below the bodies.
  Entity fixed = world.body_count();
  for (size_t i = 0; i < world.planes.size(); ++i) {
    const Plane& plane = world.planes[i];
    const bool is_floor = plane.normal.dot(frustum.up()) > 0.5;

    for (const Vec3& point : places_of(fixed++)) {
      const double above = plane.normal.dot(bodies.middle() - point);
      if (is_drawn(scene_, i) && is_floor && above > 0 && above < 3 * size)
        add(content, frustum, bodies.middle() - above * plane.normal, {});
    }
  }

  // Small walls and obstacles that bodies come near.
  for (size_t i = 0; i < world.walls.size(); ++i) {
    const Wall& wall = world.walls[i];
    const vector<Vec3> places = places_of(fixed++);
    if (!is_drawn(scene_, world.planes.size() + i) || 2 * max(wall.half_width, wall.half_height) > size) continue;

    Extent box;
    for (const Vec3& center : places)
      for (const Vec3& corner : corners(wall, center)) box.include(corner);
    if (!meet(box, content.near)) continue;

    for (const Vec3& center : places)
      for (const Vec3& corner : corners(wall, center)) add(content, frustum, corner, {});
  }

  for (size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& obstacle = world.obstacles[i];
    const vector<Vec3> places = places_of(fixed++);
    const bool drawn = is_drawn(scene_, world.planes.size() + world.walls.size() + i);
    if (!drawn || 2 * obstacle.volume.half.maxCoeff() > size) continue;

    Extent box;
    for (const Vec3& center : places) box.include(center, obstacle.volume.half);
    if (!meet(box, content.near)) continue;
    for (const Vec3& center : places) add(content, frustum, center, obstacle.volume);
  }

  for (const Vec3& anchor : anchors_) add(content, frustum, anchor, {});
  content.bodies = bodies;
}

void MotionView::add_fixed_things(Content& content, const Frustum& frustum) const {
  for (const Plane& plane : scene_.world.planes) add(content, frustum, plane.point, {});
  for (const Wall& wall : scene_.world.walls)
    for (const Vec3& corner : corners(wall, wall.center)) add(content, frustum, corner, {});
  for (const Obstacle& obstacle : scene_.world.obstacles) add(content, frustum, obstacle.center, obstacle.volume);
  if (content.empty()) add(content, frustum, Vec3::Zero(), {});
}

void MotionView::add_what_is_around(Content& content, const Frustum& frustum) const {
  if (is_of_some_)
    add_named_things(content, frustum);
  else
    add_surroundings(content, frustum);
}

/// The things that the scene names, and nothing else.
void MotionView::add_named_things(Content& content, const Frustum& frustum) const {
  const World& world = scene_.world;
  for (const Entity e : scene_.camera->fit_on) {
    if (world.is_body(e)) continue;
    for (const Vec3& place : places_of(e)) {
      if (world.is_plane(e)) add(content, frustum, place, {});
      if (world.is_obstacle(e)) add(content, frustum, place, world.obstacle(e).volume);
      if (!world.is_wall(e)) continue;
      for (const Vec3& corner : corners(world.wall(e), place)) add(content, frustum, corner, {});
    }
  }
}

MotionView::Content MotionView::all(const Frustum& frustum) const {
  Content content;
  if (samples_.instants() == 0 || scene_.world.body_count() == 0) {
    add_fixed_things(content, frustum);
    return content;
  }
  content = without_the_leaving(frustum);
  add_what_is_around(content, frustum);
  return content;
}

array<MotionView::Content, MotionView::whole> MotionView::parts(const Frustum& frustum) const {
  array<Content, whole> parts;
  for (size_t k = 0; k < samples_.instants(); ++k)
    for (size_t i = 0; i < samples_.bodies().size(); ++i) {
      const uint8_t scope = scope_[k * samples_.bodies().size() + i];
      if (scope < whole) add(parts[scope], frustum, k, i);
    }

  // Each has what the narrower ones have.
  for (size_t scope = 1; scope < whole; ++scope) parts[scope].add(parts[scope - 1]);
  for (Content& content : parts)
    if (!content.empty()) add_what_is_around(content, frustum);
  return parts;
}

vector<MotionView::Moment> MotionView::moments(const Frustum& frustum, size_t scope) const {
  vector<Moment> moments(samples_.instants());
  for (size_t k = 0; k < moments.size(); ++k) {
    Moment& moment = moments[k];
    Extent extent;

    for (size_t i = 0; i < samples_.bodies().size(); ++i) {
      if (!is_in(scope, k, i) || !samples_.is_there(k, i)) continue;
      const Vec3& center = samples_.center(k, i);
      const double radius = samples_.volume(k, i).reach();
      frustum.add(moment.reach, center, max(min(room_alongside * radius, room_), radius));
      extent.include(center);
    }

    if (moment.reach.empty()) continue;
    moment.middle = extent.middle();
    for (const Vec3& anchor : anchors_) frustum.add(moment.reach, anchor, 0);
  }
  return moments;
}

}  // namespace carom
