// Shapes are drawn by their distance, pixel by pixel within their bounds. A picture has few of them, and they are
// small.
#include "overlay/pen.h"

#include "std.h"

namespace carom {
namespace {

double length_of(const PixelPoint& a) {
  return hypot(a.x, a.y);
}

/// Covers pixels in a rectangle by `inside`: how far (pixels) a pixel's middle is inside an edge; negative: outside.
template <typename Inside>
void cover(const PixelPoint& low, const PixelPoint& high, Coverage& covered, const Inside& inside) {
  const auto limited = [](double x, int size) { return int(clamp(x, 0.0, double(size))); };
  const int left = limited(floor(low.x - 1), covered.width), right = limited(ceil(high.x + 1), covered.width);
  const int top = limited(floor(low.y - 1), covered.height), bottom = limited(ceil(high.y + 1), covered.height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double part = clamp(inside(PixelPoint{x + 0.5, y + 0.5}) + 0.5, 0.0, 1.0);
      uint8_t& value = covered.at(x, y);
      value = max(value, uint8_t(std::lround(255 * part)));
    }
  }
}

double cross(const PixelPoint& a, const PixelPoint& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

void draw_line(const PixelPoint& from, const PixelPoint& to, double width, Coverage& covered) {
  const PixelPoint way = to - from;
  const double length2 = way.x * way.x + way.y * way.y, reach = width / 2;
  const PixelPoint low{min(from.x, to.x) - reach, min(from.y, to.y) - reach};
  const PixelPoint high{max(from.x, to.x) + reach, max(from.y, to.y) + reach};

  // A line thinner than a pixel is a fainter one.
  const double thin = min(width, 1.0), half = max(reach, 0.5);
  cover(low, high, covered, [&](const PixelPoint& p) {
    const PixelPoint off = p - from;
    const double along = length2 > 0 ? clamp((off.x * way.x + off.y * way.y) / length2, 0.0, 1.0) : 0;
    return thin * clamp(half - length_of(off - along * way) + 0.5, 0.0, 1.0) - 0.5;
  });
}

void draw_arrow(const PixelPoint& from, const PixelPoint& to, double width, Coverage& covered) {
  const PixelPoint way = to - from;
  const double whole = length_of(way);
  if (!(whole > 0.5)) return;
  const double head = min(4 * width, whole), half = 0.42 * head;
  const PixelPoint along = (1 / whole) * way, across{-along.y, along.x};
  const PixelPoint neck = to - head * along;
  // The head covers the end of the shaft.
  if (whole > head) draw_line(from, neck + 0.3 * head * along, width, covered);

  // The head.
  const array<PixelPoint, 3> corners = {to, neck + half * across, neck - half * across};
  PixelPoint low = to, high = to;
  for (const PixelPoint& corner : corners) {
    low = {min(low.x, corner.x), min(low.y, corner.y)};
    high = {max(high.x, corner.x), max(high.y, corner.y)};
  }

  cover(low, high, covered, [&](const PixelPoint& p) {
    double inside = infinity;
    for (size_t i = 0; i < 3; ++i) {
      const PixelPoint edge = corners[(i + 1) % 3] - corners[i];
      inside = min(inside, cross(edge, p - corners[i]) / length_of(edge));
    }
    return inside;
  });
}

void draw_box(const PixelPoint& upper_left, const PixelPoint& lower_right, Coverage& covered) {
  const auto part = [](double low, double high, double pixel) {
    return clamp(min(high, pixel + 0.5) - max(low, pixel - 0.5), 0.0, 1.0);
  };
  cover(upper_left, lower_right, covered, [&](const PixelPoint& p) {
    return part(upper_left.x, lower_right.x, p.x) * part(upper_left.y, lower_right.y, p.y) - 0.5;
  });
}

void draw_disc(const PixelPoint& center, double radius, Coverage& covered) {
  const PixelPoint reach{radius, radius};
  cover(center - reach, center + reach, covered, [&](const PixelPoint& p) { return radius - length_of(p - center); });
}

Coverage outline_of(const Coverage& covered, double radius) {
  Coverage wide = covered;
  const int reach = int(ceil(radius));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double part = clamp(radius + 0.5 - hypot(dx, dy), 0.0, 1.0);
      if (part <= 0) continue;
      const auto share = uint32_t(std::lround(256 * part));

      for (int y = max(0, -dy); y < min(covered.height, covered.height - dy); ++y) {
        const uint8_t* from = &covered.values[size_t(y) * size_t(covered.width)];
        uint8_t* to = &wide.values[size_t(y + dy) * size_t(covered.width)];
        for (int x = max(0, -dx); x < min(covered.width, covered.width - dx); ++x)
          to[x + dx] = max(to[x + dx], uint8_t((share * from[x]) >> 8));
      }
    }
  }
  return wide;
}

}  // namespace carom
