// Computes outlines. A ball has an ellipse, by which its edge is smooth and its depth free of cancellation.
#include "raster/silhouettes.h"

#include "raster/outline.h"
#include "raster/polygon.h"
#include "std.h"

namespace carom::raster {
namespace {

/// Bounds in the plane z = 1 as pixels, with a margin of half a pixel around.
PixelBounds pixels(const Lens& lens, double left, double right, double bottom, double top) {
  // std::ceil and std::floor would be calls.
  const auto first = [](double x, int most) {
    x = std::clamp(x, 0.0, double(most));
    const int i = int(x);
    return int16_t(i < x ? i + 1 : i);
  };

  const auto end = [](double x, int most) {
    x = std::clamp(x, -1.0, most - 1.0);
    const int i = int(x);
    return int16_t(i > x ? i : i + 1);
  };

  // The middle of pixel i is at left + i pixel.
  return {first((left - lens.left) / lens.pixel - 0.5, lens.width),
          first((lens.top - top) / lens.pixel - 0.5, lens.height),
          end((right - lens.left) / lens.pixel + 0.5, lens.width),
          end((lens.top - bottom) / lens.pixel + 0.5, lens.height)};
}

/// The outline of a ball, with the pixels that it may cover.
PixelBounds outline_ball(const Lens& lens, const Solid& solid, Silhouette& to) {
  Outline o{};
  if (!outline_of(vec(solid.center), solid.radius, o)) {
    to.wide = true;
    return bounds_of_ball(lens, solid.center, solid.radius);
  }

  double a = std::sqrt(o.ax * o.ax + o.ay * o.ay), b = std::sqrt(o.bx * o.bx + o.by * o.by);
  const double ex = o.ax / a, ey = o.ay / a;

  // A ball that is smaller than a pixel is larger and fainter. The edge of a disc is blurred over a pixel, which adds
  // pi / 12 pixels to its area; the opacity takes them off where they count.
  const double least = 0.75 * lens.pixel, seen = 2 * lens.pixel;
  BallOutline& ball = to.ball;
  if (lens.smooth && b < seen) {
    const double longer = std::max(a, least), shorter = std::max(b, least);
    ball.opacity = float(a * b / (longer * shorter + lens.pixel * lens.pixel / 12));
    a = longer, b = shorter;
  }

  ball.x = float(o.x), ball.y = float(o.y);
  ball.xx = float(ex / a), ball.xy = float(ey / a);
  ball.yx = float(-ey / b), ball.yy = float(ex / b);
  ball.per_a = float(1 / a), ball.per_b = float(1 / b);
  ball.depth2 = float(o.depth2);

  const double wide = std::sqrt(a * a * ex * ex + b * b * ey * ey), high = std::sqrt(a * a * ey * ey + b * b * ex * ex);
  return pixels(lens, o.x - wide, o.x + wide, o.y - high, o.y + high);
}

}  // namespace

PixelBounds bounds_of_ball(const Lens& lens, const Float3& center, float radius) {
  const double near = center[2] - radius, far = center[2] + radius;
  if (far <= lens.near) return {};
  if (near <= lens.near) return {0, 0, int16_t(lens.width), int16_t(lens.height)};
  const auto low = [&](double x) { return x / (x < 0 ? near : far); };
  const auto high = [&](double x) { return x / (x > 0 ? near : far); };
  return pixels(lens, low(center[0] - radius), high(center[0] + radius), low(center[1] - radius),
                high(center[1] + radius));
}

PixelBounds Silhouettes::add_polygon(const Shot& shot, const Solid& solid, Silhouette& to) {
  const Lens& lens = shot.lens;
  const vector<PlanePoint> hull = outline_polygon(shot, solid);
  if (hull.size() < 3) return {};

  to.first_edge = int32_t(edges_.size());
  const size_t pairs = (hull.size() + 1) / 2;
  to.edge_pairs = int32_t(pairs);

  const auto edge = [&](size_t i) -> Edge {
    if (i >= hull.size()) return {0, 0, 1e6F};
    const PlanePoint &p = hull[i], &q = hull[(i + 1) % hull.size()];
    const double length = std::hypot(q.x - p.x, q.y - p.y) * lens.pixel;
    const double a = -(q.y - p.y) / length, b = (q.x - p.x) / length;
    return {float(a), float(b), float(-a * p.x - b * p.y)};
  };

  for (size_t i = 0; i < pairs; ++i) {
    edges_.push_back(edge(i));
    edges_.push_back(edge(i + pairs));
  }

  const auto [left, right] = std::minmax_element(hull.begin(), hull.end(), [](auto& p, auto& q) { return p.x < q.x; });
  const auto [bottom, top] = std::minmax_element(hull.begin(), hull.end(), [](auto& p, auto& q) { return p.y < q.y; });
  return pixels(lens, left->x, right->x, bottom->y, top->y);
}

void Silhouettes::fill(const Shot& shot) {
  edges_.clear();
  all_.resize(shot.solids.size());
  for (size_t i = 0; i < shot.solids.size(); ++i) {
    const Solid& solid = shot.solids[i];
    Silhouette& to = all_[i];
    to = {};

    to.nearest = solid.center[2] - solid.radius;
    if (solid.shadow_only) {
      to.bounds = {};
    } else if (solid.kind == SolidKind::ball) {
      to.bounds = outline_ball(shot.lens, solid, to);
    } else if (solid.kind == SolidKind::mesh) {
      to.bounds = bounds_of_ball(shot.lens, solid.center, solid.radius);
    } else {
      to.bounds = add_polygon(shot, solid, to);
    }
  }
}

}  // namespace carom::raster
