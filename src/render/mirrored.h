#pragma once
// What a plane that is not matt mirrors: the solids of a picture, reflected in the plane, before nothing.

#include "raster/shot.h"
#include "std.h"

namespace carom {

/// The shot as it looks in the plane. Meshes are their volumes, and nothing lies behind the solids.
raster::Shot mirrored(const raster::Shot& shot, const raster::Ground& ground);

}  // namespace carom
