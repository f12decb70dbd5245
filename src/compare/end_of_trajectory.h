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

/// The last instant in the file of an open folder.
struct TrajectoryEnd {
  double time = 0;           // s
  vector<EndMotion> bodies;  // in the order of the file
};

/// Reads only the end of the file. Throws ExportError if there is none.
TrajectoryEnd end_of_trajectory(int folder);

}  // namespace carom
