// Registers each solid in the cells of its shadow's directions, blur included. A point then has the solids of one cell.
// A test of all pairs would grow with the square of their number.
#include "raster/light_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace carom::raster {
namespace {

// Balls that may shade one point, on average.
constexpr float most_shades = 16;
constexpr float narrowest = 0.25F;
constexpr int most_cells = 512;
// Light at a smaller slope is too weak on a plane to cast shadows.
constexpr float least_slope = 0.03F;

float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Float3 cross(const Float3& a, const Float3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Float3 unit(const Float3& a) {
  const float length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Half the width of a solid along a unit direction.
float half_width(const Frame& frame, const Solid& s, const Float3& d) {
  if (s.kind == Kind::wall) return s.half[0] * std::abs(dot(s.right, d)) + s.half[1] * std::abs(dot(s.up, d));
  if (s.kind == Kind::mesh) return std::max(s.radius, 1.5F * s.mesh_reach);
  if (s.kind == Kind::ball || s.kind == Kind::wide_ball) return s.radius;
  const float x = std::abs(dot(frame.axes[0], d)), y = std::abs(dot(frame.axes[1], d)), z = std::abs(dot(frame.axes[2], d));
  if (s.kind == Kind::box) return s.half[0] * x + s.half[1] * y + s.half[2] * z;
  return s.half[0] * std::sqrt(x * x + z * z) + s.half[1] * y;
}

/// The span of tan(angle) of a disc in one plane through the lamp. False: the disc is not on this face.
bool span_on_face(float aside, float ahead, float radius, float& low, float& high) {
  const double distance = std::hypot(aside, ahead);
  if (distance <= radius) {
    low = -1, high = 1;
    return true;
  }
  const double middle = std::atan2(aside, ahead), half = std::asin(radius / distance), quarter = std::numbers::pi / 4;
  if (middle - half > quarter || middle + half < -quarter) return false;
  low = static_cast<float>(std::tan(std::max(middle - half, -quarter)));
  high = static_cast<float>(std::tan(std::min(middle + half, quarter)));
  return true;
}

}  // namespace

/// Finds the grid's extent, and how far shadows reach.
void LightGrid::measure(const Frame& frame) {
  const Lamp& key = frame.lamps[0];
  const float infinity = std::numeric_limits<float>::infinity();
  u0 = v0 = infinity, u1 = v1 = -infinity;
  float lowest = infinity;
  double covered = 0;
  for (const Solid& s : frame.solids) {
    const float wide = half_width(frame, s, u), high = half_width(frame, s, v);
    u0 = std::min(u0, dot(u, s.center) - wide), u1 = std::max(u1, dot(u, s.center) + wide);
    v0 = std::min(v0, dot(v, s.center) - high), v1 = std::max(v1, dot(v, s.center) + high);
    lowest = std::min(lowest, dot(key.vector, s.center) - s.radius);
    if (s.kind != Kind::wall) covered += std::numbers::pi * double{s.radius} * s.radius;
  }
  const double area = std::max(double{u1 - u0} * (v1 - v0), 1e-30);
  const auto shades = static_cast<float>(std::sqrt(most_shades * area / std::max(covered, 1e-30)));
  widest_blur = std::clamp(shades - 1, narrowest, faintest);

  blur_.resize(frame.solids.size());
  float widest = 0;
  double width = 0;
  int count = 0;
  for (std::size_t i = 0; i < frame.solids.size(); ++i) {
    const Solid& s = frame.solids[i];
    float blur = frame.lamp_radius;
    if (!key.near) {
      float way = dot(key.vector, s.center) - lowest;
      for (const Ground& g : frame.grounds) {
        const float slope = dot(g.normal, key.vector);
        if (slope > least_slope) way = std::max(way, (dot(g.normal, s.center) + g.height) / slope);
      }
      blur = frame.softness * std::max(way, 0.0F);
    }
    blur_[i] = std::min(blur, widest_blur * s.radius);
    widest = std::max(widest, blur_[i]);
    if (s.kind == Kind::wall) continue;
    width += s.radius + blur_[i];
    ++count;
  }
  width = count > 0 ? width / count : double{u1 - u0};
  if (key.near) {
    u0 = v0 = -1, u1 = v1 = 1;
    side = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(frame.solids.size()))), 1, most_cells / 2);
  } else {
    u0 -= widest, v0 -= widest, u1 += widest, v1 += widest;
    side = std::clamp(static_cast<int>(std::max(u1 - u0, v1 - v0) / width), 1, most_cells);
  }
  per_u = static_cast<float>(side) / std::max(u1 - u0, 1e-30F);
  per_v = static_cast<float>(side) / std::max(v1 - v0, 1e-30F);
}

void LightGrid::footprint(const Frame& frame, std::size_t i, std::vector<Rect>& rects) const {
  const Solid& s = frame.solids[i];
  const Lamp& key = frame.lamps[0];
  rects.clear();
  if (!key.near) {
    const float x = dot(u, s.center), y = dot(v, s.center);
    const float wide = half_width(frame, s, u) + blur_[i], high = half_width(frame, s, v) + blur_[i];
    rects.push_back({0, x - wide, x + wide, y - high, y + high});
    return;
  }
  for (int face = 0; face < 6; ++face) {
    const auto axis = static_cast<std::size_t>(face / 2);
    const auto p = [&](std::size_t k) { return s.center[k % 3] - key.vector[k % 3]; };
    const float ahead = face % 2 ? -p(axis) : p(axis), radius = s.radius + blur_[i];
    Rect r{face, 0, 0, 0, 0};
    if (ahead > -radius && span_on_face(p(axis + 1), ahead, radius, r.u0, r.u1) &&
        span_on_face(p(axis + 2), ahead, radius, r.v0, r.v1))
      rects.push_back(r);
  }
}

void LightGrid::fill(const Frame& frame) {
  members_.clear();
  if (frame.solids.empty()) {
    start_.assign(1, 0);
    return;
  }
  const Lamp& key = frame.lamps[0];
  const Float3 aside = std::abs(key.vector[0]) < 0.7F ? Float3{1, 0, 0} : Float3{0, 1, 0};
  if (!key.near) {
    u = unit(cross(key.vector, aside));
    v = cross(key.vector, u);
  }
  measure(frame);
  towards_light.clear();
  for (const Solid& s : frame.solids) {
    const Float3 off = {key.vector[0] - s.center[0], key.vector[1] - s.center[1], key.vector[2] - s.center[2]};
    towards_light.push_back(key.near ? -dot(off, off) : dot(key.vector, s.center));
  }
  start_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * (key.near ? 6 : 1) + 1, 0);
  const auto each_cell = [&](std::size_t i, auto visit) {
    footprint(frame, i, rects_);
    const auto at = [&](float x, float origin, float per) {
      return static_cast<int>(std::clamp((x - origin) * per, 0.0F, static_cast<float>(side - 1)));
    };
    for (const Rect& r : rects_)
      for (int y = at(r.v0, v0, per_v); y <= at(r.v1, v0, per_v); ++y)
        for (int x = at(r.u0, u0, per_u); x <= at(r.u1, u0, per_u); ++x)
          visit(static_cast<std::size_t>((r.face * side + y) * side + x));
  };
  for (std::size_t i = 0; i < frame.solids.size(); ++i) each_cell(i, [&](std::size_t cell) { ++start_[cell + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  members_.resize(start_.back());
  next_.assign(start_.begin(), start_.end() - 1);
  order_.resize(frame.solids.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return towards_light[a] != towards_light[b] ? towards_light[a] < towards_light[b] : a < b;
  });
  for (auto* a : {&x, &y, &z, &radius, &place}) a->resize(members_.size() + 16);
  for (const std::uint32_t i : order_) {
    const Solid& s = frame.solids[i];
    const bool ball = s.kind == Kind::ball || s.kind == Kind::wide_ball;
    each_cell(i, [&](std::size_t cell) {
      const std::size_t k = next_[cell]++;
      members_[k] = i;
      x[k] = s.center[0], y[k] = s.center[1], z[k] = s.center[2];
      radius[k] = ball ? s.radius : -1;
      place[k] = towards_light[i];
    });
  }
}

}  // namespace carom::raster
