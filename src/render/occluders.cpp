// Finds the things that may shade a given one, by a grid across the light. A test of all pairs would grow with the
// square of their number. Parallel light has one plane grid, a lamp the six faces of a cube around it. Things count as
// the balls around them.
#include "render/occluders.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/whole.h"

namespace carom {
namespace {

constexpr double blur = Lighting::softness;
// A shadow is followed until its blur is so many radii wide.
constexpr double faint = 8;

/// The span of tan(angle) of a disc in one plane through the lamp. False: the disc is not on this face.
bool span_on_face(double side, double ahead, double radius, double& low, double& high) {
  const double distance = std::hypot(side, ahead);
  if (distance <= radius) {
    low = -1, high = 1;
    return true;
  }
  const double middle = std::atan2(side, ahead), half = std::asin(radius / distance), quarter = std::atan(1.0);
  if (middle - half > quarter || middle + half < -quarter) return false;
  low = std::tan(std::max(middle - half, -quarter));
  high = std::tan(std::min(middle + half, quarter));
  return true;
}

}  // namespace

void Occluders::footprint(const Vec3& center, double radius, std::vector<Rect>& rects) const {
  rects.clear();
  if (!near_) {
    const double u = across_u_.dot(center), v = across_v_.dot(center);
    rects.push_back({0, u - radius, u + radius, v - radius, v + radius});
    return;
  }
  const Vec3 p = center - key_;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double ahead = face % 2 ? -p[axis] : p[axis];
    Rect rect;
    rect.face = face;
    if (ahead > -radius && span_on_face(p[(axis + 1) % 3], ahead, radius, rect.u0, rect.u1) &&
        span_on_face(p[(axis + 2) % 3], ahead, radius, rect.v0, rect.v1))
      rects.push_back(rect);
  }
}

template <typename Visit>
void Occluders::cells(const Rect& rect, Visit visit) const {
  const auto index = [&](double x, double origin, double per) {
    return static_cast<int>(std::clamp<std::int64_t>(whole_below((x - origin) * per), 0, side_ - 1));
  };
  const int u0 = index(rect.u0, origin_u_, per_u_), u1 = index(rect.u1, origin_u_, per_u_);
  const int v0 = index(rect.v0, origin_v_, per_v_), v1 = index(rect.v1, origin_v_, per_v_);
  for (int v = v0; v <= v1; ++v)
    for (int u = u0; u <= u1; ++u) visit(static_cast<std::size_t>((rect.face * side_ + v) * side_ + u));
}

Occluders::Occluders(std::span<const Thing> balls, const Lighting& lighting)
    : balls_(balls),
      near_(lighting.key_is_near()),
      lamp_(lighting.lamp_radius()),
      key_(lighting.key()),
      seen_(balls.size(), 0) {
  side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(balls.size()))), 1, 512);
  per_u_ = per_v_ = side_ / 2.0;
  across_u_ = key_.cross(std::abs(key_.x()) < 0.7 * key_.norm() ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
  across_v_ = key_.cross(across_u_).normalized();
  if (!near_) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double u0 = infinity, u1 = -infinity, v0 = infinity, v1 = -infinity, l0 = infinity, l1 = -infinity;
    for (const Thing& ball : balls) {
      const double u = across_u_.dot(ball.center), v = across_v_.dot(ball.center), l = key_.dot(ball.center);
      u0 = std::min(u0, u), u1 = std::max(u1, u);
      v0 = std::min(v0, v), v1 = std::max(v1, v);
      l0 = std::min(l0, l), l1 = std::max(l1, l);
    }
    origin_u_ = u0, origin_v_ = v0;
    per_u_ = u1 > u0 ? side_ / (u1 - u0) : 1;
    per_v_ = v1 > v0 ? side_ / (v1 - v0) : 1;
    extent_ = l1 - l0;
  }

  // The balls of each cell are contiguous: count them first, then fill.
  const std::size_t count = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * (near_ ? 6 : 1);
  start_.assign(count + 1, 0);
  const auto each_cell = [&](auto visit) {
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      const double radius = balls_[i].radius;
      footprint(balls_[i].center, radius + (near_ ? lamp_ : std::min(blur * extent_, faint * radius)), rects_);
      for (const Rect& rect : rects_) cells(rect, [&](std::size_t cell) { visit(cell, i); });
    }
  };
  each_cell([&](std::size_t cell, std::uint32_t) { ++start_[cell + 1]; });
  for (std::size_t c = 0; c < count; ++c) start_[c + 1] += start_[c];
  members_.resize(start_[count]);
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  each_cell([&](std::size_t cell, std::uint32_t i) { members_[next[cell]++] = i; });
}

void Occluders::find(std::uint32_t i, std::vector<std::uint32_t>& found) {
  ++query_;
  found.clear();
  const Thing& ball = balls_[i];
  const Vec3 to_light = near_ ? Vec3((key_ - ball.center).normalized()) : key_;
  const double reach = near_ ? (key_ - ball.center).norm() : std::numeric_limits<double>::infinity();
  const auto along = [&](std::uint32_t k) { return to_light.dot(balls_[k].center - ball.center); };
  footprint(ball.center, ball.radius, rects_);
  for (const Rect& rect : rects_)
    cells(rect, [&](std::size_t cell) {
      for (std::uint32_t m = start_[cell]; m < start_[cell + 1]; ++m) {
        const std::uint32_t k = members_[m];
        if (k == i || seen_[k] == query_) continue;
        seen_[k] = query_;
        const Thing& other = balls_[k];
        const double ahead = along(k);
        if (ahead <= -ball.radius || ahead - other.radius > reach) continue;
        const double wide = near_ ? lamp_ : std::max(ahead + ball.radius, 0.0) * blur;
        if (!near_ && wide > faint * other.radius) continue;
        // The light of a lamp diverges. Along the ray to the ball's centre, its edge deviates by ball.radius * ahead /
        // reach.
        const double apart =
            ball.radius + other.radius + wide + (near_ ? ball.radius * std::max(ahead, 0.0) / reach : 0);
        const Vec3 aside = other.center - ball.center - ahead * to_light;
        if (aside.squaredNorm() < apart * apart) found.push_back(k);
      }
    });
  std::sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double x = along(a), y = along(b);
    return x != y ? x < y : a < b;
  });
  if (found.size() > most) found.resize(most);
}

bool Occluders::may_shade(const Surface& wall, const Thing& thing) const {
  const double size = std::hypot(wall.half_width, wall.half_height);
  const Vec3 offset = wall.center - thing.center;
  // It must come near the line to the lamp.
  if (near_) {
    const Vec3 line = key_ - thing.center;
    const double t = std::clamp(offset.dot(line) / std::max(line.squaredNorm(), 1e-300), 0.0, 1.0);
    return (offset - t * line).norm() < 1.001 * (size + std::max(thing.radius, lamp_));
  }
  const double ahead = key_.dot(offset), reach = size + thing.radius;
  return ahead > -reach && (offset - ahead * key_).norm() < 1.001 * (reach + 1.5 * blur * (ahead + reach));
}

void Occluders::append_rows(std::uint32_t i, const Things& things, const Surfaces& surfaces, std::vector<float>& rows) {
  const auto add = [&](const Vec3& v, double w) {
    for (int k = 0; k < 3; ++k) rows.push_back(static_cast<float>(v[k]));
    rows.push_back(static_cast<float>(w));
  };
  find(i, found_);
  for (const std::uint32_t k : found_) {
    const Thing& thing = balls_[k];
    const Look& look = things.look(thing);
    if (thing.mesh && look.outline_reach > 0) {
      add(thing.mesh_middle, -4);
      add(Vec3(static_cast<double>(look.file), look.outline_reach, 0), 0);
    } else if (thing.shape == Shape::sphere) {
      add(thing.center, thing.half.x());
    } else {
      add(thing.center, thing.shape == Shape::box ? -2 : -3);
      add(thing.half, 0);
    }
  }
  for (std::size_t w = surfaces.planes(); w < surfaces.all().size(); ++w)
    if (may_shade(surfaces.all()[w], balls_[i])) add(Vec3(static_cast<double>(w), 0, 0), -1);
}

}  // namespace carom
