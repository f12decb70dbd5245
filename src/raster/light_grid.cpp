// Registers each solid in the cells of its shadow's directions, blur included. A point then has the solids of one cell.
// A test of all pairs would grow with the square of their number.
#include "raster/light_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "raster/radix_sort.h"

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

/// The cells of each solid's shadow.
void LightGrid::find_rects(const Frame& frame) {
  const Lamp& key = frame.lamps[0];
  const auto at = [&](float x, float origin, float per) {
    return static_cast<std::int16_t>(std::clamp((x - origin) * per, 0.0F, static_cast<float>(side - 1)));
  };
  const auto add = [&](int face, float a0, float a1, float b0, float b1) {
    rects_.push_back({static_cast<std::int16_t>(face), at(a0, u0, per_u), at(a1, u0, per_u), at(b0, v0, per_v), at(b1, v0, per_v)});
  };
  rects_.clear();
  first_rect_.clear();
  for (std::size_t i = 0; i < frame.solids.size(); ++i) {
    const Solid& s = frame.solids[i];
    first_rect_.push_back(static_cast<std::uint32_t>(rects_.size()));
    if (!key.near) {
      const float a = dot(u, s.center), b = dot(v, s.center);
      const float wide = half_width(frame, s, u) + blur_[i], high = half_width(frame, s, v) + blur_[i];
      add(0, a - wide, a + wide, b - high, b + high);
      continue;
    }
    const float radius = s.radius + blur_[i];
    for (int face = 0; face < 6; ++face) {
      const auto axis = static_cast<std::size_t>(face / 2);
      const auto p = [&](std::size_t k) { return s.center[k % 3] - key.vector[k % 3]; };
      const float ahead = face % 2 ? -p(axis) : p(axis);
      float a0, a1, b0, b1;
      if (ahead > -radius && span_on_face(p(axis + 1), ahead, radius, a0, a1) &&
          span_on_face(p(axis + 2), ahead, radius, b0, b1))
        add(face, a0, a1, b0, b1);
    }
  }
  first_rect_.push_back(static_cast<std::uint32_t>(rects_.size()));
}

/// Sorts solids by their place towards the light.
void LightGrid::sort() {
  keys_.clear();
  for (const float place : towards_light) keys_.push_back(key_of(place));
  sort_by_key(keys_, order_, spare_);
}

void LightGrid::fill(const Frame& frame) {
  for (Cells* cells : {&balls, &others}) cells->members.clear(), cells->start.assign(1, 0);
  if (frame.solids.empty()) return;
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
  find_rects(frame);
  sort();
  const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * (key.near ? 6 : 1);
  const auto is_ball = [&](std::size_t i) { return frame.solids[i].kind == Kind::ball || frame.solids[i].kind == Kind::wide_ball; };
  const auto each_cell = [&](std::size_t i, auto visit) {
    for (std::uint32_t k = first_rect_[i]; k < first_rect_[i + 1]; ++k) {
      const Rect& r = rects_[k];
      for (int b = r.v0; b <= r.v1; ++b)
        for (int a = r.u0; a <= r.u1; ++a) visit(static_cast<std::size_t>((r.face * side + b) * side + a));
    }
  };
  // The members of each cell are contiguous: count them first, then fill.
  for (Cells* cells : {&balls, &others}) cells->start.assign(count + 1, 0);
  for (std::size_t i = 0; i < frame.solids.size(); ++i) {
    Cells& cells = is_ball(i) ? balls : others;
    each_cell(i, [&](std::size_t cell) { ++cells.start[cell + 1]; });
  }
  for (Cells* cells : {&balls, &others}) {
    std::partial_sum(cells->start.begin(), cells->start.end(), cells->start.begin());
    cells->members.resize(cells->start.back());
    next_.assign(cells->start.begin(), cells->start.end() - 1);
    for (const std::uint32_t i : order_)
      if (is_ball(i) == (cells == &balls)) each_cell(i, [&](std::size_t cell) { cells->members[next_[cell]++] = i; });
  }
  for (auto* a : {&x, &y, &z, &radius, &place}) a->resize(balls.members.size() + 16);
  for (std::size_t k = 0; k < balls.members.size(); ++k) {
    const std::uint32_t i = balls.members[k];
    const Solid& s = frame.solids[i];
    x[k] = s.center[0], y[k] = s.center[1], z[k] = s.center[2], radius[k] = s.radius, place[k] = towards_light[i];
  }
}

}  // namespace carom::raster
