#pragma once
// Which steps of a fixed length a method can take under given forces. Beyond them its errors grow in each step.
#include "physics/force_jacobian.h"
#include "physics/integrator.h"

namespace carom {

/// A motion x'' = -stiffness x - damping x' along one direction: a swing, or a decay.
struct LinearMode {
  double stiffness = 0, damping = 0;  // 1/s^2, 1/s
};

/// The factor by which a step of h (s) multiplies the amplitude of a mode, at most. For euler, verlet and rk4.
double growth(Integrator method, const LinearMode& mode, double h);

/// The longest stable step (s) of one of these methods under forces with these derivatives, along the stiffest of their
/// directions; infinity: they neither pull back nor brake. Forces that push away are left out: there the motion itself
/// parts from any other. `mode`: that direction's.
double stable_step(Integrator method, const ForceJacobian& slopes, LinearMode& mode);

}  // namespace carom
