#pragma once
// The part of a scene that determines its motion.

#include "std.h"

namespace carom {

struct Scene;

/// A canonical text of the world, the initial state and the settings of the simulator.
/// Scenes with the same text move alike, bit for bit.
/// It excludes names, title, colours, meshes, camera, lights, background and output.
/// It excludes the way a number was written, and whether `auto` chose the engine.
string motion_text(const Scene& scene);

}  // namespace carom
