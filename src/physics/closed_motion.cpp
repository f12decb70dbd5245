#include "physics/closed_motion.h"

#include <cmath>
#include <limits>

#include "physics/force.h"

namespace carom {

namespace {

/// Takes up forces, one by one, as long as they have a closed form together.
class Gathering {
 public:
  explicit Gathering(double mass) : mass_(mass) {}

  void take(const UniformForce& law) { constant_ = constant_ || !law.force.isZero(0); }
  void take(const UniformAcceleration& law) { gravity(law.value); }
  void gravity(const Vec3& g) { constant_ = constant_ || !g.isZero(0); }
  void take(const Drag& law) {
    if (law.quadratic != 0) closed_ = false;
    forces_.fade += law.linear / mass_;
  }
  void take(const Spring& law) {
    if (law.rest_length != 0 || law.damping != 0) closed_ = false;
    forces_.stiffness += law.stiffness / mass_;
  }
  void take(const Attractor& law) {
    if (law.strength == 0) return;
    if (law.softening != 0 || (forces_.strength != 0 && law.center != forces_.center)) closed_ = false;
    forces_.center = law.center;
    forces_.strength += law.strength;
  }

  std::optional<ClosedForces> all() const {
    const bool springs = forces_.stiffness > 0 || forces_.fade > 0;
    if (!closed_ || (forces_.strength != 0 ? springs || constant_ : !(forces_.stiffness > 0))) return std::nullopt;
    return forces_;
  }

 private:
  double mass_;  // kg
  bool closed_ = true, constant_ = false;
  ClosedForces forces_;
};

}  // namespace

std::optional<ClosedForces> closed_forces(const World& world, Entity body, double time) {
  Gathering all(world.mass[body]);
  all.gravity(world.gravity);
  for (const Force& force : world.forces)
    if (acts(force, body, time)) std::visit([&](const auto& law) { all.take(law); }, force.law);
  return all.all();
}

ClosedMotion::ClosedMotion(const ClosedForces& forces, const Vec3& x, const Vec3& v, const Vec3& at_rest)
    : origin_(forces.strength != 0 ? forces.center : x), strength_(forces.strength) {
  if (strength_ != 0)
    motion_ = KeplerOrbit(strength_, x - origin_, v);
  else
    motion_ = Oscillation{Vec3::Zero(), v, at_rest, forces.fade, forces.stiffness};
}

void ClosedMotion::at(double t, Vec3& place, Vec3& v) const {
  std::visit([&](const auto& motion) { motion.at(t, place, v); }, motion_);
}

Vec3 ClosedMotion::acceleration(const Vec3& place, const Vec3& v) const {
  if (const auto* swing = std::get_if<Oscillation>(&motion_))
    return swing->a - swing->stiffness * place - swing->fade * v;
  const double square = place.squaredNorm();
  return -strength_ / (square * std::sqrt(square)) * place;
}

double ClosedMotion::longest_step(const Vec3& place, const Vec3& v) const {
  if (const auto* swing = std::get_if<Oscillation>(&motion_)) {
    const bool turns = 4 * swing->stiffness > swing->fade * swing->fade;
    return turns ? 1 / std::sqrt(swing->stiffness) : std::numeric_limits<double>::infinity();
  }
  return step_within(place.norm(), v.norm(), acceleration(place, v).norm());
}

}  // namespace carom
