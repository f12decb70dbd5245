#pragma once
// The laws of force. Each is a plain struct in a file of its own with a `name`, whether it is
// `constant`, the same everywhere and at every speed, and the same four functions:
//   acceleration(p)  m/s^2, what it does to a particle
//   potential(p)     J, of which the acceleration is the downhill slope, but for
//   drain(p)         m/s^2, the part of the acceleration that has no potential
//   rate(p)          1/s, at most about how fast the acceleration turns or fades along a path: what a time step must
//                    follow; 0: it is constant
#include <variant>

#include "physics/attractor.h"
#include "physics/drag.h"
#include "physics/spring.h"
#include "physics/uniform_acceleration.h"
#include "physics/uniform_force.h"

namespace carom {

using ForceLaw = std::variant<UniformForce, UniformAcceleration, Drag, Spring, Attractor>;

}  // namespace carom
