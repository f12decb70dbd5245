// Projects strokes. A stroke that is thinner than its least width is drawn that wide.
#include "render/strokes.h"

#include "render/lighting.h"
#include "std.h"

namespace carom {

namespace {

int tiles_along(int pixels) {
  return (pixels + raster::tile_side - 1) / raster::tile_side;
}

}  // namespace

void Lines::begin(Size picture) {
  by_tile.resize(size_t(tiles_along(picture.width)) * size_t(tiles_along(picture.height)));
  for (auto& tile : by_tile) tile.clear();
  all.clear();
}

void Lines::add(const vector<Stroke>& strokes, const Eye& eye) {
  const auto [width, height] = eye.size;
  const int columns = tiles_along(width), rows = tiles_along(height);
  const Stroke* last = nullptr;
  for (const Stroke& stroke : strokes) {
    const bool joined = last && last->to == stroke.from;
    last = nullptr;

    Vec3 a = eye.point(stroke.from), b = eye.point(stroke.to);
    const double near = eye.camera.near;
    if (a.z() <= near && b.z() <= near) continue;
    // Where the stroke is cut, the rest keeps its radii and opacities there.
    double from = 0, to = 1;
    const double way = b.z() - a.z();
    if (a.z() < near) from = (near - a.z()) / way;
    if (b.z() < near) to = (near - a.z()) / way;

    const Vec3 start = a;
    const auto at = [&](double t, double x, double y) { return x + t * (y - x); };
    a = start + from * (b - start), b = start + to * (b - start);

    raster::Line line{};
    const auto pixels = [&](double r, double z) { return float(max(r / (z * eye.pixel), 0.5 * stroke.least_width)); };

    line.x0 = float(0.5 * width + a.x() / (a.z() * eye.pixel));
    line.y0 = float(0.5 * height - a.y() / (a.z() * eye.pixel));
    line.x1 = float(0.5 * width + b.x() / (b.z() * eye.pixel));
    line.y1 = float(0.5 * height - b.y() / (b.z() * eye.pixel));

    line.radius0 = pixels(at(from, stroke.from_radius, stroke.to_radius), a.z());
    line.radius1 = pixels(at(to, stroke.from_radius, stroke.to_radius), b.z());
    line.depth0 = float(1 / a.z()), line.depth1 = float(1 / b.z());

    line.color = linear(stroke.color);
    line.opacity0 = float(at(from, stroke.from_opacity, stroke.to_opacity));
    line.opacity1 = float(at(to, stroke.from_opacity, stroke.to_opacity));
    line.joined = joined;

    const double wide = max(line.radius0, line.radius1) + 1;
    const auto tile = [](double x, int most) { return int(clamp(floor(x / raster::tile_side), -1.0, 1.0 * most)); };
    const int left = max(tile(min(line.x0, line.x1) - wide, columns), 0);
    const int right = min(tile(max(line.x0, line.x1) + wide, columns), columns - 1);
    const int top = max(tile(min(line.y0, line.y1) - wide, rows), 0);
    const int bottom = min(tile(max(line.y0, line.y1) + wide, rows), rows - 1);

    const auto number = uint32_t(all.size());
    all.push_back(line);
    last = &stroke;

    // A long slanting line passes few of the tiles in the box around it.
    const double dx = line.x1 - line.x0, dy = line.y1 - line.y0, length = hypot(dx, dy);
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const double half = 0.5 * raster::tile_side;
        const double ox = x * raster::tile_side + half - line.x0, oy = y * raster::tile_side + half - line.y0;
        if (length > 0 && std::abs(ox * dy - oy * dx) / length > wide + 1.5 * half) continue;
        by_tile[size_t(y * columns + x)].push_back(number);
      }
  }
}

}  // namespace carom
