#pragma once
// The visible planes of a scene in the camera's frame, and their pattern.

#include "raster/shot.h"
#include "render/eye.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// Name, colour and other properties of an obstacle, by its number among obstacles.
const FixedLook& look_of_obstacle(const Scene& scene, size_t obstacle);
/// The same of any fixed thing, by its number among all of them.
const FixedLook& look_of_fixed(const Scene& scene, size_t fixed);

/// The side of the squares on planes, m: several bodies wide, between a twelfth and half of the picture at the target
/// of the camera at time 0. A camera that moves does not change it.
double pattern_unit(const Scene& scene, Size size);

/// Fills the planes of a shot and the floor that lights bodies from below. Planes that are not visible are left out.
/// They cut nothing off the others. The lamps and the side of the squares must be filled before.
void add_surfaces(const Scene& scene, const Eye& eye, raster::Shot& shot);

}  // namespace carom
