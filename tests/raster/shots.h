#pragma once
// Pictures for the tests of raster/, and all that a kernel knows of their pixels after it has drawn.

#include "raster/polygon.h"
#include "raster/tile.h"
#include "raster/tile_memory.h"
#include "std.h"

namespace carom::raster::test {

inline double noise(uint64_t& seed) {
  seed = seed * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(seed >> 11U) * 0x1p-53;
}

/// A camera along z, with the world's axes x, y and -z.
inline Shot shot_of(int width, int height, double tan_x) {
  Shot shot;
  shot.lens.width = width, shot.lens.height = height;
  shot.lens.pixel = static_cast<float>(2 * tan_x / width);
  shot.lens.left = static_cast<float>(-tan_x) + 0.5F * shot.lens.pixel;
  shot.lens.top = 0.5F * static_cast<float>(height - 1) * shot.lens.pixel;
  shot.lens.near = 0.1F;
  shot.lens.axes = {Float3{1, 0, 0}, Float3{0, 1, 0}, Float3{0, 0, -1}};
  shot.backdrop.plain = true;
  shot.lighting.ambient = {0.3F, 0.3F, 0.3F};
  shot.lighting.softness = 0.03F;
  shot.lighting.lamps.push_back({{0.48F, 0.8F, -0.36F}, false, {0.8F, 0.8F, 0.7F}});
  return shot;
}

/// The same camera, turned about two of the world's axes.
inline void tilt(Shot& shot) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(-0.4, Vec3::UnitX()) * Eigen::AngleAxisd(0.6, Vec3::UnitY())).matrix();
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = (i == 2 ? -1 : 1) * turn.col(i);
    for (int k = 0; k < 3; ++k)
      shot.lens.axes[static_cast<size_t>(i)][static_cast<size_t>(k)] = static_cast<float>(axis[k]);
  }
}

inline Solid ball(const Float3& center, float radius) {
  Solid s;
  s.center = center, s.radius = radius, s.half = {radius, radius, radius};
  return s;
}

inline Solid solid(SolidKind kind, const Float3& center, const Float3& half) {
  Solid s;
  s.kind = kind, s.center = center, s.half = half;
  s.radius = std::sqrt(dot(half, half));
  return s;
}

/// Of each kind that rays meet, one about this centre. Walls are the shot's first.
inline vector<Solid> one_of_each_kind(Shot& shot, const Float3& center) {
  shot.walls.push_back({Float3{0.8F, 0, 0.6F}, Float3{0.36F, 0.8F, -0.48F}, Float3{0.48F, -0.6F, -0.64F}});
  return {ball(center, 0.5F), solid(SolidKind::box, center, {0.3F, 0.4F, 0.5F}),
          solid(SolidKind::cylinder, center, {0.3F, 0.5F, 0.3F}), solid(SolidKind::wall, center, {0.5F, 0.4F, 0.02F})};
}

struct Span {
  double from, to;
};

/// The s at which p + s d is in a solid that is `scale` times as large, by the formulas of textbooks.
inline optional<Span> inside(const Shot& shot, const Solid& solid, const Vec3& p, const Vec3& d, double scale = 1) {
  const Vec3 off = p - vec(solid.center), half = scale * vec(solid.half);
  Span span{-1e300, 1e300};
  const auto between = [&](double at, double rate, double reach) {
    const double a = (-reach - at) / rate, b = (reach - at) / rate;
    span = {std::max(span.from, std::min(a, b)), std::min(span.to, std::max(a, b))};
  };
  // |off + s d|^2 = r^2
  const auto within = [&](const Vec3& at, const Vec3& rate, double r) {
    const double a = rate.squaredNorm(), b = at.dot(rate), disc = b * b - a * (at.squaredNorm() - r * r);
    const double root = disc < 0 ? std::nan("") : std::sqrt(disc);
    span = disc < 0 ? Span{1, 0} : Span{std::max(span.from, (-b - root) / a), std::min(span.to, (-b + root) / a)};
  };

  const array<Float3, 3>& unit_axes = axes_of(shot, solid);
  const array<Vec3, 3> axes = {vec(unit_axes[0]), vec(unit_axes[1]), vec(unit_axes[2])};
  if (solid.kind == SolidKind::ball) within(off, d, scale * double{solid.radius});
  if (solid.kind == SolidKind::cylinder)
    within(off - axes[1].dot(off) * axes[1], d - axes[1].dot(d) * axes[1], half.x());
  for (size_t k = 0; k < 3; ++k)
    if (solid.kind == SolidKind::box || solid.kind == SolidKind::wall || (solid.kind == SolidKind::cylinder && k == 1))
      between(axes[k].dot(off), axes[k].dot(d), half[static_cast<int>(k)]);
  return span.from <= span.to ? optional(span) : nullopt;
}

/// The ray through the middle of a pixel: (x, y, 1).
inline Vec3 ray(const Lens& lens, int x, int y) {
  return {double{lens.left} + x * double{lens.pixel}, double{lens.top} - y * double{lens.pixel}, 1};
}

/// What a pixel shows, from the nearest to the farthest.
struct Layer {
  double z, share;
  int solid;
  bool inside;
};

struct Seen {
  vector<Layer> layers;
  double clear = 0;    // share that no solid covers
  double inverse = 0;  // 1 / z of the largest share; with lines only
  Vec3 light;          // linear
  double alpha = 0;
};

struct How {
  TileKernel kernel = tile_kernels().back();
  int channels = 3;
  vector<Line> lines = {};
  bool last_tile_first = false;
};

struct Drawn {
  int width = 0, height = 0;
  vector<uint8_t> bytes;
  vector<Seen> pixels;
  const Seen& at(int x, int y) const { return pixels[static_cast<size_t>(y * width + x)]; }
};

/// Reads what the memory holds of one pixel of the last tile.
inline Seen seen_in(const TileMemory& m, size_t block, size_t pixel) {
  constexpr size_t lanes = block_side * block_side;
  const size_t at = block * lanes + pixel;
  Seen seen;

  for (size_t k = 0; k < static_cast<size_t>(m.layers.used[block]); ++k) {
    const size_t place = (block * most_layers + k) * lanes + pixel;
    const int solid = m.layers.solid[place];
    if (m.layers.cover[place] > 0)
      seen.layers.push_back({double{m.layers.depth[place]}, double{m.layers.cover[place]}, solid & number_mask,
                             (solid & seen_inside) != 0});
  }

  seen.clear = double{m.layers.clear[at]}, seen.inverse = double{m.pixels.inverse[at]};
  seen.light = {double{m.pixels.red[at]}, double{m.pixels.green[at]}, double{m.pixels.blue[at]}};
  seen.alpha = double{m.pixels.alpha[at]};
  return seen;
}

inline Drawn drawn(const Shot& shot, const How& how = {}) {
  Silhouettes silhouettes;
  silhouettes.fill(shot);
  Bins bins;
  bins.fill(shot, silhouettes);
  LightGrid lights;
  lights.fill(shot);

  Drawn out{shot.lens.width, shot.lens.height, {}, {}};
  out.pixels.resize(static_cast<size_t>(out.width * out.height));
  out.bytes.resize(out.pixels.size() * static_cast<size_t>(how.channels));
  vector<uint32_t> numbers(how.lines.size());
  for (uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  const vector<vector<uint32_t>> by_tile(static_cast<size_t>(bins.count()), numbers);
  const Picture picture{&shot, &silhouettes, &bins, &lights, &how.lines, &by_tile, out.bytes.data(), how.channels};

  const auto memory = make_unique<TileMemory>();
  for (int i = 0; i < bins.count(); ++i) {
    const int tile = how.last_tile_first ? bins.count() - 1 - i : i;
    how.kernel(picture, *memory, tile);
    const int left = tile % bins.columns() * tile_side, top = tile / bins.columns() * tile_side;
    for (int y = top; y < std::min(top + tile_side, out.height); ++y)
      for (int x = left; x < std::min(left + tile_side, out.width); ++x) {
        const int block = (y - top) / block_side * blocks_across + (x - left) / block_side;
        const int pixel = (y - top) % block_side * block_side + (x - left) % block_side;
        out.pixels[static_cast<size_t>(y * out.width + x)] =
            seen_in(*memory, static_cast<size_t>(block), static_cast<size_t>(pixel));
      }
  }

  return out;
}

/// Calls check(x, y, seen) for each pixel.
inline void for_each_pixel(const Drawn& picture, const auto& check) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) check(x, y, picture.at(x, y));
}

}  // namespace carom::raster::test
