// The smallest size is the full height or edge of a volume, not half of it. The bound on places is a multiple of it and
// holds in every unit of length.
#include "physics/bounds.h"

#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// A part of a hollow thing has no thickness, which does not count.
double smallest_of(const Volume& volume) {
  double smallest = volume.shape == Shape::box ? infinity : volume.half.x();
  for (int k = 0; k < 3; ++k)
    if (volume.half[k] > 0) smallest = min(smallest, 2 * volume.half[k]);
  return smallest;
}

}  // namespace

double smallest_size(const World& world) {
  double smallest = infinity;
  if (world.volume.empty()) {
    for (const double radius : world.radius) smallest = min(smallest, radius);
  } else {
    for (const Volume& volume : world.volume) smallest = min(smallest, smallest_of(volume));
  }
  for (const Obstacle& obstacle : world.obstacles) smallest = min(smallest, smallest_of(obstacle.volume));
  for (const Wall& wall : world.walls) smallest = min({smallest, 2 * wall.half_width, 2 * wall.half_height});
  return smallest;
}

Bounds bounds_of(const World& world) {
  Bounds bounds;
  bounds.place = farthest_by_size * smallest_size(world);
  return bounds;
}

}  // namespace carom
