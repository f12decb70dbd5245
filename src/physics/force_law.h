#pragma once
// The laws of force. Each is a plain struct in a file of its own.
// A law has a `name`. Its `constant` is true if the force is the same everywhere and at every speed. It also has these
// functions:
//   bends()          whether paths under it are neither parabolas nor the closed form of linear drag
//   closed()         whether paths under it alone have a closed form
//   damps()          whether it takes energy at every speed
//   fade()           kg/s, the linear drag that is in it
//   reach(x)         m, the distance to the nearest complex point at which the acceleration is infinite
//   acceleration(p)  m/s^2, of a particle under the force
//   potential(p)     J; the acceleration is its downhill slope, except for
//   drain(p)         m/s^2, the part of the acceleration that has no potential
//   rate(p)          1/s, an estimate of the greatest rate at which the acceleration turns or fades along a path;
//                    a time step must follow it; 0: the acceleration is constant
#include <variant>

#include "physics/attractor.h"
#include "physics/drag.h"
#include "physics/spring.h"
#include "physics/uniform_acceleration.h"
#include "physics/uniform_force.h"

namespace carom {

using ForceLaw = std::variant<UniformForce, UniformAcceleration, Drag, Spring, Attractor>;

}  // namespace carom
