// The motion of bodies between events. The present forces of a body are cached. Constant ones are recomputed only when
// a force starts or ends.
#include "simulate/path/paths.h"

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/simulation_error.h"

namespace carom {

BodyPaths::BodyPaths(const World& given, const ExactOptions& given_options)
    : options(given_options),
      merged(given, options.merge),
      couplings(merged.given()),
      world(merged.world()),
      moving(merged.given()),
      bounds(bounds_of(given)),
      forced(!given.forces.empty() || couplings.any() ||
             any_of(given.strings, [](const String& string) { return string.until < infinity; })),
      varying(bending_force(given) != nullptr),
      by_method(options.integrator != Integrator::dop853 || !options.closed_forms),
      in_steps(varying || by_method),
      // By body.
      applied(given.body_count(), given.gravity),
      fade(given.body_count()),
      bent(given.body_count()),
      flights(given.body_count(), given.gravity),
      kick(given.body_count()),
      body(given.body_count()),
      log(options.max_collisions, options.record_collisions, given.forces.size(), couplings.any(), given.triggers.all) {
}

Vec3 BodyPaths::velocity_without_kick(Entity i, const Instant& at) const {
  const double t = at - flights[i].start;
  const Vec3 v = flights[i].velocity(t);
  if (!is_kicked(mode(i))) return v;
  return v - kick[i].rest(at);
}

void BodyPaths::apply(Entity i, const AppliedAcceleration& forces) {
  applied.write(i) = forces.all;
  if (forces.fade != fade[i]) fade.write(i) = forces.fade;
}

void BodyPaths::apply_forces(Entity i, const Vec3& x, const Vec3& v) {
  const bool bend = varying && merged.bends(i, now.hi);
  if (bend != (bent[i] != 0)) bent.write(i) = bend;
  if (!bend) return apply(i, merged.applied(i, now.hi));
  apply(i, {merged.acceleration(i, now.hi, x, v), 0});
}

/// Euler's method has another velocity than its path.
void BodyPaths::note_greatest_speed(Entity i, const Vec3& v) {
  const PolynomialPath* const curve = flights.curve(i);
  log.note_speed(i, curve == nullptr ? v.norm() : (v - curve->ahead).norm());
}

VelocityBeyond BodyPaths::beyond_curve(Entity i, const Flight& f, double length) const {
  VelocityBeyond beyond;
  beyond.terms[0] = -f.curve->ahead;
  if (options.integrator == Integrator::verlet && f.curve->is_parabola && length > 0)
    beyond.terms[2] = verlet_change(i, f, length) / (length * length);
  return beyond;
}

/// Steps that are too long for the forces make energy without end. The remedies then name the step.
Remedies BodyPaths::remedies() const {
  constexpr const char* step =
      "steps of simulate.step are too long for the forces: shorten it, or use `integrator: dop853`";
  return log.tally().doubts.stiffest.phase > 1 ? Remedies{step, step} : Remedies{};
}

/// Whether the method's steps under forces with a closed form differ from it. Except for Euler's method they do not
/// where the acceleration is constant.
bool BodyPaths::method_bends(Entity i) const {
  return fade[i] != 0 || (options.integrator == Integrator::euler && !applied[i].isZero(0));
}

Vec3 BodyPaths::bent_force_at(Entity i, const Vec3& x, const Vec3& v) const {
  return merged.acceleration(i, now.hi, x, v);
}

}  // namespace carom
