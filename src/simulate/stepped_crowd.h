#pragma once
// Many bodies that press on one another (stepped_crowd.cpp), in arrays of their own: member k is body members[k].
#include <vector>

#include "physics/complementarity.h"
#include "physics/sweeps.h"
#include "simulate/simulator.h"

namespace carom {

/// Two that may come into contact in a step: a member, and another or something fixed.
struct CrowdContact {
  Entity a, b;
  std::uint32_t of_a, of_b;  // their places in the crowd; of_b PressedPair::none: not of it
  Vec3 normal;               // unit, from a to b
  double gap, approach;      // m, m/s, as the step begins
  double restitution = 0;
  double impulse = 0;  // N s, in the step
  bool strikes = false;
};

struct Crowd {
  std::vector<Entity> members;               // ascending
  std::vector<Vec3> x, v, pull, moved, way;  // m, m/s, m/s^2, m/s, m/s
  std::vector<double> inverse_mass;          // 1/kg
  std::vector<double> haste, known;          // m/s: at least how fast each goes, and for which its contacts are known
  std::vector<CrowdContact> contacts;
  std::vector<PressedPair> pairs;  // the problem at hand,
  std::vector<std::size_t> which;  // and whose contacts its pairs are
  Sweeps sweeps;
  std::vector<std::uint8_t> pressed;  // something presses on it
  std::size_t carried = 0;            // members in lasting contact that do not sleep
  double smallest = never;            // m, the least radius
  double pulls = 0;                   // m/s^2, the greatest acceleration
  bool told = true;                   // ways are as near to what they should be as asked for
  bool part = false;                  // of the crowd, looked at as if the others were fixed

  /// To be filled anew.
  void clear();
  void add(Entity i, const Vec3& at, const Vec3& velocity, const Vec3& acceleration, double mass, double radius);
};

}  // namespace carom
