#pragma once
// The visible planes of a scene in the camera's frame, and their pattern.
#include <cstddef>

#include "raster/shot.h"
#include "render/eye.h"
#include "scene/scene.h"

namespace carom {

/// Name, colour and other properties of an obstacle, by its number among obstacles.
const FixedName& name_of_obstacle(const Scene& scene, std::size_t obstacle);
/// The same of any fixed thing, by its number among all of them.
const FixedName& name_of_fixed(const Scene& scene, std::size_t fixed);

/// Fills the planes of a shot, the floor that lights bodies from below, and the side of the pattern's squares. Planes
/// that are not visible are left out. They cut nothing off the others. The lamps must be filled before.
void add_surfaces(const Scene& scene, const Eye& eye, raster::Shot& shot);

}  // namespace carom
