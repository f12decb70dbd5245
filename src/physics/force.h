#pragma once
// The effect of gravity and the World's forces on a body. A force acts from its `from` until just before its `until`.
//
// In the energy balance a force that acts for ever has a potential, as gravity has. A force that starts or ends does
// work, and so does a part without potential.
#include "physics/force_jacobian.h"
#include "physics/state.h"
#include "physics/world.h"

namespace carom {

/// The acceleration (m/s^2) from `time` (s) on, at position x (m) and velocity v (m/s).
Vec3 free_acceleration(const World& world, Entity body, double time, const Vec3& x, const Vec3& v);

/// The same of a particle, whose mass (kg) takes the place of the body's.
Vec3 free_acceleration(const World& world, Entity body, double time, const Particle& particle);

/// The part of one force's acceleration that does work, because it has no potential (m/s^2). The force must act on this
/// body.
Vec3 working_acceleration(const World& world, const Force& force, Entity body, const Vec3& x, const Vec3& v);

/// The potential energy (J) of gravity (zero at the origin) and of the forces that act for ever.
double potential(const World& world, Entity body, const Vec3& x);
/// The potential energy (J) of one force. It is 0 unless the force acts for ever on this body.
double potential(const World& world, const Force& force, Entity body, const Vec3& x);

/// The first instant after `time` (s) at which a force on this body starts or ends; infinity: none.
double next_switch(const World& world, Entity body, double time);

/// Whether a force of this law is the same everywhere and at every speed.
bool is_constant(const ForceLaw& law);

/// The first force that is not constant. Null: there is none, and every path between impacts is a parabola.
const Force* varying_force(const World& world);

/// Whether paths under this law are neither parabolas nor the closed form of linear drag.
bool bends(const ForceLaw& law);
/// The first force that bends paths; null: there is none.
const Force* bending_force(const World& world);
/// Whether such a force acts on this body at `time` (s).
bool bends(const World& world, Entity body, double time);

/// The first force because of which flights of a body have no closed form (closed_motion.h) at some time; null: there
/// is none.
const Force* force_without_closed_form(const World& world);

/// Whether a force that acts on this body at `time` (s) takes energy at every speed: drag or a damper.
bool damps(const World& world, Entity body, double time);

/// The linear drag of a law (kg/s).
double fade_of(const ForceLaw& law);
/// The decay rate of a body's velocity by linear drag at `time` (s), in 1/s.
/// The forces that have a closed form give free_acceleration at velocity zero, less this rate times the velocity.
double fade_of(const World& world, Entity body, double time);

/// The key of the law in a scene.
const char* name_of(const ForceLaw& law);

/// An estimate of the greatest rate at which the acceleration changes along the body's path, at this point (1/s); 0:
/// constant.
double force_rate(const World& world, Entity body, const Vec3& x, const Vec3& v);

/// The distance from x within which the forces on a body are smooth (m): the least reach of their laws.
double force_reach(const World& world, Entity body, const Vec3& x);

/// The kinetic energy that a body keeps far from its attractors, as a share of the energy that it has at x (m) and v
/// (m/s), from `time` (s) on. An error of the speed here is a larger share of the speed there.
double left_of_speed(const World& world, Entity body, double time, const Vec3& x, const Vec3& v);

/// The derivatives of a body's acceleration by x (m) and v (m/s), from `time` (s) on.
ForceJacobian force_jacobian(const World& world, Entity body, double time, const Vec3& x, const Vec3& v);

/// A step (s) that follows the forces at the bodies' start: 1/1000, or 1/200 of the time in which they change, if that
/// is shorter.
double default_step(const World& world, const State& initial);

}  // namespace carom
