// A motion leaves four numbers (frustum.h) for the bodies that stay, and four for each that may be flying away. Only
// the motion's end shows which of these return.
#include "render/motion_view.h"

#include "physics/body_now.h"
#include "std.h"

namespace carom {
namespace {

/// A body is a dot if it is lower than this part of the picture.
constexpr double dot = 0.01;

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

}  // namespace

void MotionView::Content::add(const Content& other) {
  for (size_t i = 0; i < reach.size(); ++i) reach[i].add(other.reach[i]);
  join(bodies, other.bodies);
  join(near, other.near);
}

void MotionView::add(const State& state) {
  const bool first = departures_.empty();
  departures_.resize(state.position.size());
  if (first && !state.position.empty()) {
    for (const Vec3& position : state.position) middle_ += position;
    middle_ /= double(state.position.size());
    start_ = time_ = state.time;
  }

  known_.at(state.fired);
  const double since = state.time - exchange(time_, state.time);
  for (Entity body = 0; body < state.position.size(); ++body) {
    Departure& departure = departures_[body];
    const Vec3& position = state.position[body];

    // A body departs while it moves away from where all were at the start.
    const double distance2 = (position - middle_).squaredNorm();
    const double before = exchange(departure.distance2, distance2);
    const bool part = is_gone(state, body);
    const bool departs = !part && before >= 0 && distance2 > before;

    if (!departs && !departure.content.empty()) core_.add(exchange(departure.content, {}));
    if (part) continue;

    const Volume volume = volume_now(scene_.world, state, body);
    Content& content = departs ? departure.content : core_;
    add(content, position, volume);

    // Straight back to what the body has met since the previous instant.
    content.near.include(position, 3 * volume.half);
    content.near.include(position - since * state.velocity[body], 3 * volume.half);
  }
}

void MotionView::add(Content& content, const Vec3& center, const Volume& volume) const {
  for (size_t i = 0; i < directions_.size(); ++i) directions_[i].add(content.reach[i], center, volume);
  content.bodies.include(center, volume.half);
}

MotionView::Content MotionView::without_the_leaving(const Frustum& frustum, size_t direction) const {
  // The width of a view is proportional to the depth of one point.
  const Vec3 middle = core_.bodies.middle();
  const auto depth = [&](const Content& content) { return frustum.depth(content.reach[direction], middle); };

  vector<pair<double, size_t>> leaving;  // by depth
  for (size_t body = 0; body < departures_.size(); ++body) {
    if (departures_[body].content.empty()) continue;
    Content with = core_;
    with.add(departures_[body].content);
    leaving.emplace_back(depth(with), body);
  }
  if (leaving.empty()) return core_;
  ranges::sort(leaving);

  const double largest_dot = dot * frustum.height(1) / (2 * median(scene_.world.radius));  // per m of depth
  Content content = core_;
  size_t in_view = departures_.size() - leaving.size();
  double with_half = depth(core_);
  for (const auto& [alone, body] : leaving) {
    Content with = content;
    with.add(departures_[body].content);

    const double deep = depth(with);
    const bool has_half = 2 * in_view >= departures_.size();
    if (has_half && deep > 2 * with_half && deep * largest_dot > 1) break;

    content = with;
    ++in_view;
    if (!has_half) with_half = deep;
  }
  return content;
}

/// Where a fixed thing is while bodies are shown, where it goes farthest.
vector<Vec3> MotionView::places_of(Entity fixed) const {
  if (!world_.moves(fixed)) return {fixed_position(world_, fixed, {start_, 0})};
  vector<Vec3> places;
  for (const double time : farthest_times(world_.motion(fixed), start_, time_))
    places.push_back(fixed_position(world_, fixed, {time, 0}));
  return places;
}

void MotionView::add_surroundings(Content& content) const {
  const World& world = scene_.world;
  const Extent bodies = content.bodies;
  const double size = (bodies.high - bodies.low).norm();

  // Floors below the bodies.
  Entity fixed = world.body_count();
  for (size_t i = 0; i < world.planes.size(); ++i) {
    const Plane& plane = world.planes[i];
    const bool is_floor = plane.normal.dot(directions_[0].up()) > 0.5;

    for (const Vec3& point : places_of(fixed++)) {
      const double above = plane.normal.dot(bodies.middle() - point);
      if (is_drawn(scene_, i) && is_floor && above > 0 && above < 3 * size)
        add(content, bodies.middle() - above * plane.normal, {});
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
      for (const Vec3& corner : corners(wall, center)) add(content, corner, {});
  }

  for (size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& obstacle = world.obstacles[i];
    const vector<Vec3> places = places_of(fixed++);
    const bool drawn = is_drawn(scene_, world.planes.size() + world.walls.size() + i);
    if (!drawn || 2 * obstacle.volume.half.maxCoeff() > size) continue;

    Extent box;
    for (const Vec3& center : places) box.include(center, obstacle.volume.half);
    if (!meet(box, content.near)) continue;
    for (const Vec3& center : places) add(content, center, obstacle.volume);
  }

  // Anchors of strings.
  const vector<size_t>& hidden = scene_.overlay.hidden_strings;
  for (size_t k = 0; k < world.strings.size(); ++k) {
    const String& string = world.strings[k];
    if (string.other == no_entity && !std::binary_search(hidden.begin(), hidden.end(), k))
      add(content, string.anchor, {});
  }

  content.bodies = bodies;
}

void MotionView::add_fixed_things(Content& content) const {
  for (const Plane& plane : scene_.world.planes) add(content, plane.point, {});
  for (const Wall& wall : scene_.world.walls)
    for (const Vec3& corner : corners(wall, wall.center)) add(content, corner, {});
  for (const Obstacle& obstacle : scene_.world.obstacles) add(content, obstacle.center, obstacle.volume);
  if (content.empty()) add(content, Vec3::Zero(), {});
}

MotionView::Content MotionView::content(size_t direction) const {
  Content content;
  if (departures_.empty()) {
    add_fixed_things(content);
  } else {
    content = without_the_leaving(directions_[direction], direction);
    add_surroundings(content);
  }
  return content;
}

}  // namespace carom
