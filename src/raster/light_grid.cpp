// Registers each solid in the cells of its shadow's directions, blur included. A point then has the solids of one cell.
// A test of all pairs would grow with the square of their number.
#include "raster/light_grid.h"

#include <numbers>
#include <numeric>

#include "std.h"

namespace carom::raster {
namespace {

// Balls that may shade one point, on average.
constexpr float most_shades = 16;
constexpr int most_cells = 512;
// Light at a smaller slope is too weak on a plane to cast shadows.
constexpr float least_slope = 0.03F;

/// Half the width of a solid along a unit direction.
float half_width_of_others(const Shot& shot, const Solid& s, const Float3& d);
inline float half_width(const Shot& shot, const Solid& s, const Float3& d) {
  return s.kind == SolidKind::ball ? s.radius : half_width_of_others(shot, s, d);
}
float half_width_of_others(const Shot& shot, const Solid& s, const Float3& d) {
  if (s.kind == SolidKind::mesh) return std::max(s.radius, 1.5F * shot.meshes[s.part].reach);
  const array<Float3, 3>& axes = axes_of(shot, s);
  const float x = std::abs(dot(axes[0], d)), y = std::abs(dot(axes[1], d)), z = std::abs(dot(axes[2], d));
  if (s.kind != SolidKind::cylinder) return s.half[0] * x + s.half[1] * y + s.half[2] * z;
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
  low = float(std::tan(std::max(middle - half, -quarter)));
  high = float(std::tan(std::min(middle + half, quarter)));
  return true;
}

}  // namespace

/// Finds the grid's extent, and how far shadows reach.
void LightGrid::measure(const Shot& shot) {
  const float infinity = numeric_limits<float>::infinity();
  LightExtent& e = extent;
  e.u0 = e.v0 = infinity, e.u1 = e.v1 = -infinity;

  // The extent of all solids across the light.
  double covered = 0;
  for (const Solid& s : shot.solids) {
    const float wide = half_width(shot, s, e.u), high = half_width(shot, s, e.v);
    const float at_u = dot(e.u, s.center), at_v = dot(e.v, s.center);
    e.u0 = std::min(e.u0, at_u - wide), e.u1 = std::max(e.u1, at_u + wide);
    e.v0 = std::min(e.v0, at_v - high), e.v1 = std::max(e.v1, at_v + high);
    if (s.kind != SolidKind::wall) covered += std::numbers::pi * double{s.radius} * s.radius;
  }

  // In a crowd blurs are narrower.
  const double area = std::max(double{e.u1 - e.u0} * (e.v1 - e.v0), 1e-30);
  const auto shades = float(std::sqrt(most_shades * area / std::max(covered, 1e-30)));
  widest_blur = std::clamp(shades - 1, narrowest, faintest);

  const double width = find_blurs(shot);
  if (shot.lighting.lamps[0].near) {
    e.u0 = e.v0 = -1, e.u1 = e.v1 = 1;
    e.side = std::clamp(int(std::sqrt(double(shot.solids.size()))), 1, most_cells / 2);
  } else {
    const float widest = *ranges::max_element(blur_);
    e.u0 -= widest, e.v0 -= widest, e.u1 += widest, e.v1 += widest;
    e.side = std::clamp(int(std::max(e.u1 - e.u0, e.v1 - e.v0) / width), 1, most_cells);
  }

  e.per_u = float(e.side) / std::max(e.u1 - e.u0, 1e-30F);
  e.per_v = float(e.side) / std::max(e.v1 - e.v0, 1e-30F);
}

/// The widest blur of each solid's shadow. Returns the mean of radius and blur, m; without any but walls, the extent.
double LightGrid::find_blurs(const Shot& shot) {
  const Lamp& key = shot.lighting.lamps[0];
  float lowest = numeric_limits<float>::infinity();
  for (const Solid& s : shot.solids) lowest = std::min(lowest, dot(key.vector, s.center) - s.radius);

  blur_.resize(shot.solids.size());
  double width = 0;
  int count = 0;
  for (size_t i = 0; i < shot.solids.size(); ++i) {
    const Solid& s = shot.solids[i];

    float blur = shot.lighting.lamp_radius;
    // Parallel light blurs as far as a shadow may fall.
    if (!key.near) {
      float way = dot(key.vector, s.center) - lowest;
      for (const Ground& g : shot.grounds) {
        const float slope = dot(g.normal, key.vector);
        if (slope > least_slope) way = std::max(way, (dot(g.normal, s.center) + g.height) / slope);
      }
      blur = shot.lighting.softness * std::max(way, 0.0F);
    }

    blur_[i] = std::clamp(blur, narrowest * s.radius, widest_blur * s.radius);
    if (s.kind == SolidKind::wall) continue;
    width += s.radius + blur_[i];
    ++count;
  }

  return count > 0 ? width / count : double{extent.u1 - extent.u0};
}

/// The cells of each solid's shadow.
void LightGrid::find_rects(const Shot& shot) {
  const Lamp& key = shot.lighting.lamps[0];
  const LightExtent& e = extent;

  const auto at = [&](float x, float origin, float per) {
    return int16_t(std::clamp((x - origin) * per, 0.0F, float(e.side - 1)));
  };

  const auto add = [&](int face, float a0, float a1, float b0, float b1) {
    rects_.push_back(
        {int16_t(face), at(a0, e.u0, e.per_u), at(a1, e.u0, e.per_u), at(b0, e.v0, e.per_v), at(b1, e.v0, e.per_v)});
  };

  rects_.clear();
  rects_.reserve(shot.solids.size());
  first_rect_.resize(shot.solids.size() + 1);
  for (size_t i = 0; i < shot.solids.size(); ++i) {
    const Solid& s = shot.solids[i];
    first_rect_[i] = uint32_t(rects_.size());
    if (s.shell) continue;

    if (!key.near) {
      const float a = dot(e.u, s.center), b = dot(e.v, s.center);
      const float wide = half_width(shot, s, e.u) + blur_[i], high = half_width(shot, s, e.v) + blur_[i];
      add(0, a - wide, a + wide, b - high, b + high);
      continue;
    }

    // The faces of the cube around the lamp on which the ball is seen.
    const float radius = s.radius + blur_[i];
    for (int face = 0; face < 6; ++face) {
      const auto axis = size_t(face / 2);
      const auto p = [&](size_t k) { return s.center[k % 3] - key.vector[k % 3]; };
      const float ahead = face % 2 ? -p(axis) : p(axis);

      float a0, a1, b0, b1;
      if (ahead > -radius && span_on_face(p(axis + 1), ahead, radius, a0, a1) &&
          span_on_face(p(axis + 2), ahead, radius, b0, b1))
        add(face, a0, a1, b0, b1);
    }
  }

  first_rect_.back() = uint32_t(rects_.size());
}

/// The members of each cell are contiguous: counts them first, then fills.
void LightGrid::sort_into_cells(const Shot& shot) {
  const int side = extent.side;
  const size_t faces = shot.lighting.lamps[0].near ? 6 : 1;
  const size_t count = faces * size_t(side) * size_t(side);

  const auto each_cell = [&](size_t i, auto visit) {
    for (uint32_t k = first_rect_[i]; k < first_rect_[i + 1]; ++k) {
      const CellRect& r = rects_[k];
      for (int b = r.v0; b <= r.v1; ++b)
        for (int a = r.u0; a <= r.u1; ++a) visit(size_t((r.face * side + b) * side + a));
    }
  };

  // The number of members by cell, then their places.
  for (LightCells* cells : {&balls, &others}) cells->start.assign(count + 1, 0);
  is_ball_.resize(shot.solids.size());
  for (size_t i = 0; i < shot.solids.size(); ++i) {
    const Solid& s = shot.solids[i];
    // Packs have no opacity.
    is_ball_[i] = s.kind == SolidKind::ball && (s.finish == 0 || shot.finishes[s.finish].opacity == 1);
    LightCells& cells = is_ball_[i] ? balls : others;
    each_cell(i, [&](size_t cell) { ++cells.start[cell + 1]; });
  }

  for (LightCells* cells : {&balls, &others}) {
    std::partial_sum(cells->start.begin(), cells->start.end(), cells->start.begin());
    cells->members.resize(cells->start.back());
  }

  next_ball_.assign(balls.start.begin(), balls.start.end() - 1);
  next_other_.assign(others.start.begin(), others.start.end() - 1);

  for (const uint32_t i : order_.numbers()) {
    LightCells& cells = is_ball_[i] ? balls : others;
    vector<size_t>& next = is_ball_[i] ? next_ball_ : next_other_;
    each_cell(i, [&](size_t cell) { cells.members[next[cell]++] = i; });
  }
}

void LightGrid::fill(const Shot& shot) {
  for (LightCells* cells : {&balls, &others}) cells->members.clear(), cells->start.assign(1, 0);
  if (shot.solids.empty()) return;

  const Lamp& key = shot.lighting.lamps[0];
  if (!key.near) {
    const Across sides = across(key.vector);
    extent.u = sides.u, extent.v = sides.v;
  }
  measure(shot);

  towards_light.resize(shot.solids.size());
  for (size_t i = 0; i < shot.solids.size(); ++i) {
    const Float3& c = shot.solids[i].center;
    const Float3 off = {key.vector[0] - c[0], key.vector[1] - c[1], key.vector[2] - c[2]};
    towards_light[i] = key.near ? -dot(off, off) : dot(key.vector, c);
  }

  order_.sort(towards_light);

  find_rects(shot);
  sort_into_cells(shot);
  packs.fill(shot, balls, towards_light);
}

}  // namespace carom::raster
