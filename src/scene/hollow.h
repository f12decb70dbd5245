#pragma once
// Obstacles with `inside: true`: a sphere is one shell, a tube a side and its ends, a box its faces.

#include "numerics/vec3.h"
#include "physics/world.h"
#include "scene/decode.h"
#include "scene/keys.h"
#include "scene/view.h"
#include "std.h"

namespace carom {

/// One obstacle of a hollow thing.
struct HollowPart {
  string_view name;  // after the thing's name and a dot; empty: it is the whole
  Obstacle obstacle;
  Vec3 inward = Vec3::Zero();  // of a flat part: unit, to the inside
};

/// The names of the parts of a fixed thing that consists of several: the room's and a hollow tube's or box's.
vector<string_view> part_names(const View& thing);

/// The obstacles that an obstacle consists of: itself alone, unless it is hollow. `volume`: its own.
vector<HollowPart> parts_of_obstacle(const ObstacleKeys& keys, const Volume& volume);

/// Adds an error where an obstacle has keys that do not go with `inside` or `open`.
void check_hollow_keys(const View& view, const string& name, Diagnostics& diagnostics);

/// Adds an error for each hollow thing that bodies of the scene cannot meet. Bodies must be decoded before.
void check_hollows(const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics);

}  // namespace carom
