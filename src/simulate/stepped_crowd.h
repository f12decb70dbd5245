#pragma once
// What stepped_crowd.cpp and stepped_rest.cpp share.
#include "simulate/stepped_simulator.h"

namespace carom {

/// What a pair of the crowd is beside a PressedPair.
struct SteppedSimulator::CrowdName {
  Entity a, b;
  double gap, approach, restitution;  // m, m/s
  bool strikes;
};

/// The crowd's step in numbers of its own: member k is body members[k].
struct SteppedSimulator::Crowd {
  std::vector<Entity> members;
  std::vector<Vec3> x, v, pull, moved, way;  // m, m/s, m/s^2, m/s, m/s
  std::vector<double> inverse_mass, haste;   // 1/kg; m/s, at least how fast each goes
  std::vector<PressedPair> pairs;
  std::vector<CrowdName> names;
  double smallest = never, pulls = 0;  // m, m/s^2: the least radius, the greatest acceleration
  bool told = true;                    // velocities and ways are as near to what they should be as asked for
  bool part = false;                   // of the crowd, looked at as if the others were fixed
};

}  // namespace carom
