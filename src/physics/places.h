#pragma once
// The places in a World, which a change of coordinates moves. Those of bodies are in a State.
#include <variant>

#include "physics/world.h"
#include "std.h"

namespace carom {

/// Calls move(place) for the places (m) of fixed things and regions, of anchors, and of centres of attraction.
template <typename Move>
void for_each_place(World& world, Move move) {
  for (Plane& plane : world.planes) move(plane.point);
  for (Wall& wall : world.walls) move(wall.center);
  for (Obstacle& obstacle : world.obstacles) move(obstacle.center);
  for (String& string : world.strings) move(string.anchor);
  for (WorldRegion& region : world.regions) move(region.position);
  for (Force& force : world.forces) {
    if (auto* spring = std::get_if<Spring>(&force.law)) move(spring->anchor);
    if (auto* attractor = std::get_if<Attractor>(&force.law)) move(attractor->center);
  }
}

}  // namespace carom
