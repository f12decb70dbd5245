#pragma once
// Impacts that strings and rods pass on, and the impacts where strings go taut.
//
// A taut string that holds its bodies transmits an impulse at once. An impact on such a body is therefore one problem
// with all strings that hold it, and those beyond: the least change of velocities, by kinetic energy, after which the
// struck pair separates as its restitution requires and no string is longer. A string with no share in that goes slack.
#include <span>
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "simulate/impact/impact_parts.h"
#include "solver/contact_problem.h"

namespace carom {

class StringImpacts {
 public:
  StringImpacts(ExactBodies& bodies, const ImpactParts& parts) : bodies_(bodies), parts_(parts) {}

  /// An impact of body a, at the present instant, on another body or a fixed thing, or along a string that goes taut.
  struct Strike {
    Entity a;
    Entity thing;
    Vec3 normal;      // unit, from a to the thing
    double approach;  // m/s
    double change;    // m/s, of the speed along the normal
    double surface;   // m/s, of a fixed thing along the normal
  };
  /// What it does.
  struct Passed {
    std::vector<Entity> bodies;  // both and those to which strings pass it on
    std::vector<Vec3> v;         // m/s, by body, after it
    double impulse = 0;          // N s, between both
  };
  /// Its effect, if a string holds one of its bodies; otherwise null. Sleeping bodies that it reaches wake. Valid until
  /// the next call. Throws SimulationError where strings hold a body against a fixed thing that moves.
  const Passed* pass_on(const Strike& strike);
  /// Begins the flights of the bodies beyond a and b.
  void begin_beyond(const Passed& passed, Entity a, Entity b);

  /// A string goes taut at the present instant.
  void tighten(Entity string);

 private:
  void solve_with_strings(const Strike& strike);

  ExactBodies& bodies_;
  const ImpactParts parts_;
  Passed passed_;  // the last one
};

}  // namespace carom
