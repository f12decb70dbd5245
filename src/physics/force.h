#pragma once
// What gravity and the World's forces do to a body. A force counts from its `from` until just before its `until`.
//
// In the energy books a force that acts for ever has its potential, like gravity; one that sets in or ceases, and what
// has no potential, does work.
#include "physics/force_jacobian.h"
#include "physics/state.h"
#include "physics/world.h"

namespace carom {

/// m/s^2, from `time` (s) on, at position x (m) and velocity v (m/s).
Vec3 free_acceleration(const World& world, Entity body, double time, const Vec3& x, const Vec3& v);

/// m/s^2: the part of it that one force has, which acts on this body, and that does work: no potential stands for it.
Vec3 working_acceleration(const World& world, const Force& force, Entity body, const Vec3& x, const Vec3& v);

/// J, of gravity (zero at the origin) and of the forces that act for ever.
double potential(const World& world, Entity body, const Vec3& x);
/// Of one force: 0 unless it acts for ever on this body.
double potential(const World& world, const Force& force, Entity body, const Vec3& x);

/// The first instant after `time` (s) at which a force on this body sets in or ceases; infinity: none.
double next_switch(const World& world, Entity body, double time);

/// Whether a force of this law is the same everywhere and at every speed.
bool is_constant(const ForceLaw& law);

/// The first force that is not; null: there is none, and every path between impacts is a parabola.
const Force* varying_force(const World& world);

/// Whether a force acts on a body at `time` (s).
bool acts(const Force& force, Entity body, double time);

/// Whether paths under a force of this law are more than parabolas that linear drag makes fade.
bool bends(const ForceLaw& law);
/// The first force that bends paths; null: there is none.
const Force* bending_force(const World& world);
/// Whether one acts on this body at `time` (s).
bool bends(const World& world, Entity body, double time);

/// The first force because of which some body's flights at some time have no closed form (closed_motion.h); null: there
/// is none.
const Force* force_without_closed_form(const World& world);

/// Whether a force that acts on this body at `time` (s) takes energy, however slow it is: drag, a damper.
bool damps(const World& world, Entity body, double time);

/// 1/s: how fast linear drag takes a body's velocity at `time` (s), by the velocity; free_acceleration at no velocity,
/// less this times the velocity, is what forces do that have a closed form.
double fade_of(const World& world, Entity body, double time);

/// Its key in a scene.
const char* name_of(const ForceLaw& law);

/// 1/s: about how fast the acceleration changes along the body's path at most, at this point of it; 0: it is constant.
double force_rate(const World& world, Entity body, const Vec3& x, const Vec3& v);

/// m: so far from x the forces on a body are smooth: to the nearest attractor's centre, by what softens it too.
double force_reach(const World& world, Entity body, const Vec3& x);

/// s: in which a body gets half as far as `reach` (m) at most, from a speed (m/s) on, under an acceleration (m/s^2).
double step_within(double reach, double speed, double acceleration);

/// How the acceleration of a body at x (m) and v (m/s) changes with these, from `time` (s) on.
ForceJacobian force_jacobian(const World& world, Entity body, double time, const Vec3& x, const Vec3& v);

/// s: a step that follows the forces where the bodies start: 1/1000, or 1/200 of the time in which they change.
double default_step(const World& world, const State& initial);

}  // namespace carom
