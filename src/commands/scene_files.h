#pragma once
// The files that a scene depends on.

#include "commands/plan.h"
#include "std.h"

namespace carom {

/// The scene file, its meshes, the materials and textures that these name, and the manifest of the run that it begins
/// with, whether they exist or not.
/// Of a scene with errors, as far as its text shows.
set<string> files_of_scene(const PlannedScene& planned);

}  // namespace carom
