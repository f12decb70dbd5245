#include "scene/grid.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;

double dot(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

std::int64_t cell_of(double x, double cell) {
  // Beyond 4e18 all cells are one: only positions far outside of any scene are.
  return static_cast<std::int64_t>(std::clamp(std::floor(x / cell), -4e18, 4e18));
}

}  // namespace

double touch_tolerance(double radius_sum, const Vec3& a, const Vec3& b) {
  const double largest = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  return 1e-12 * radius_sum + 4 * 0x1p-52 * largest;
}

void BallGrid::reserve(std::size_t balls) {
  balls_.reserve(balls);
  exponents_.reserve(balls);
  next_.reserve(balls);
  std::size_t size = 64;
  while (size < 2 * balls) size *= 2;
  if (size <= heads_.size()) return;
  heads_.assign(size, none);
  for (std::uint32_t i = 0; i < balls_.size(); ++i) link(i);
}

std::size_t BallGrid::bucket(int exponent, std::int64_t x, std::int64_t y, std::int64_t z) const {
  // Cells that are neighbours along x share a line of memory.
  const std::uint64_t row = static_cast<std::uint64_t>(y) * 0x9E3779B97F4A7C15ULL +
                            static_cast<std::uint64_t>(z) * 0xC2B2AE3D27D4EB4FULL +
                            static_cast<std::uint64_t>(exponent) * 0x165667B19E3779F9ULL;
  return (static_cast<std::uint64_t>(x) + (row ^ (row >> 29))) & (heads_.size() - 1);
}

void BallGrid::link(std::uint32_t i) {
  const Ball& ball = balls_[i];
  const double cell = std::ldexp(1.0, exponents_[i]);
  std::uint32_t& head = heads_[bucket(exponents_[i], cell_of(ball.center.x(), cell), cell_of(ball.center.y(), cell),
                                      cell_of(ball.center.z(), cell))];
  next_[i] = head;
  head = i;
}

void BallGrid::insert(const Ball& ball) {
  if (2 * (balls_.size() + 1) > heads_.size()) reserve(std::max<std::size_t>(64, 2 * balls_.size()));
  int exponent = 0;
  std::frexp(2 * ball.radius, &exponent);
  const auto index = static_cast<std::uint32_t>(balls_.size());
  balls_.push_back(ball);
  exponents_.push_back(exponent);
  next_.push_back(none);
  auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.exponent == exponent; });
  if (level == levels_.end()) level = levels_.insert(level, {exponent, std::ldexp(1.0, exponent), {}});
  level->balls.push_back(index);
  link(index);
}

std::optional<BallGrid::Overlap> BallGrid::overlap_with(std::uint32_t i, const Vec3& center, double radius) const {
  const Ball& ball = balls_[i];
  const Vec3 d = ball.center - center;
  const double sum = ball.radius + radius;
  const double squared = dot(d, d);
  if (squared >= sum * sum) return std::nullopt;
  const double depth = sum - std::sqrt(squared);
  if (depth <= touch_tolerance(sum, ball.center, center)) return std::nullopt;
  return Overlap{ball.entity, depth};
}

std::optional<BallGrid::Overlap> BallGrid::find_overlap(const Vec3& center, double radius) const {
  for (const Level& level : levels_) {
    const double reach = radius + level.cell / 2;
    std::int64_t low[3], high[3];
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      low[k] = cell_of(center[k] - reach, level.cell);
      high[k] = cell_of(center[k] + reach, level.cell);
      cells *= static_cast<double>(high[k] - low[k] + 1);
    }
    // A large ball among few small ones: cheaper to ask them all.
    if (cells > static_cast<double>(level.balls.size()) + 27) {
      for (const std::uint32_t i : level.balls) {
        if (auto overlap = overlap_with(i, center, radius)) return overlap;
      }
      continue;
    }
    // The ball's own cell first: where there is an overlap, it is most often there.
    for (std::uint32_t i = heads_[bucket(level.exponent, cell_of(center.x(), level.cell),
                                         cell_of(center.y(), level.cell), cell_of(center.z(), level.cell))];
         i != none; i = next_[i]) {
      if (auto overlap = overlap_with(i, center, radius)) return overlap;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          for (std::uint32_t i = heads_[bucket(level.exponent, x, y, z)]; i != none; i = next_[i]) {
            if (auto overlap = overlap_with(i, center, radius)) return overlap;
          }
        }
      }
    }
  }
  return std::nullopt;
}

std::optional<double> overlap_depth(const Vec3& center, double radius, const Plane& plane) {
  const double depth = radius - dot(center - plane.point, plane.normal);
  if (depth <= touch_tolerance(radius, center, plane.point)) return std::nullopt;
  return depth;
}

std::optional<double> overlap_depth(const Vec3& center, double radius, const Wall& wall) {
  // Distance to the nearest point of the rectangle.
  const Vec3 d = center - wall.center;
  const double across = std::max(0.0, std::fabs(dot(d, wall.right)) - wall.half_width);
  const double along = std::max(0.0, std::fabs(dot(d, wall.up)) - wall.half_height);
  const double away = dot(d, wall.normal);
  const double depth = radius - std::sqrt(across * across + along * along + away * away);
  if (depth <= touch_tolerance(radius, center, wall.center)) return std::nullopt;
  return depth;
}

bool touches_nothing_fixed(const World& world, const Vec3& center, double radius) {
  return std::none_of(world.planes.begin(), world.planes.end(),
                      [&](const Plane& p) { return overlap_depth(center, radius, p).has_value(); }) &&
         std::none_of(world.walls.begin(), world.walls.end(),
                      [&](const Wall& w) { return overlap_depth(center, radius, w).has_value(); });
}

}  // namespace carom
