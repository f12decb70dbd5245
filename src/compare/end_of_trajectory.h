#pragma once
// The last instant of a run's trajectory.csv.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The motion of a body at the end of a run.
struct EndMotion {
  string body;
  Vec3 position, velocity;  // m, m/s
};

/// All bodies at the last instant, in the order of the file in this open folder. Only the end of the file is read.
/// Throws ExportError if there is no such file.
vector<EndMotion> end_of_trajectory(int folder);

}  // namespace carom
