#pragma once
// What of a scene determines its motion, apart from how the motion is looked at and written.
#include <string>

namespace carom {

struct Scene;

/// A canonical text of the world, the initial state and the settings of the simulator. Scenes with the same text move
/// alike, bit for bit. Names, title, colours, what is drawn, camera, lights, background and output are not in it, nor
/// is how a number was written, nor whether `auto` chose the engine.
std::string motion_text(const Scene& scene);

}  // namespace carom
