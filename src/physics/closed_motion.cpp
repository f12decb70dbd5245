// Decides which sets of forces have a closed form together, and evaluates the motion under them.
// Springs with linear drag become an Oscillation, an attractor alone a KeplerOrbit. Every other set is left to
// numerical integration.
#include "physics/closed_motion.h"

#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// Collects forces one by one, as long as they have a closed form together.
class Gathering {
 public:
  explicit Gathering(double mass) : mass_(mass) {}

  void add(const auto& law) {
    closed_ = closed_ && law.closed();
    take(law);
  }
  void gravity(const Vec3& g) { constant_ = constant_ || !g.isZero(0); }

  optional<ClosedForces> all() const {
    const bool springs = forces_.stiffness > 0 || forces_.fade > 0;
    if (!closed_ || (forces_.strength != 0 ? springs || constant_ : !(forces_.stiffness > 0))) return nullopt;
    return forces_;
  }

 private:
  void take(const UniformForce& law) { constant_ = constant_ || !law.force.isZero(0); }
  void take(const UniformAcceleration& law) { gravity(law.value); }
  void take(const Drag& law) { forces_.fade += law.linear / mass_; }
  void take(const Spring& law) { forces_.stiffness += law.stiffness / mass_; }
  void take(const Attractor& law) {
    if (law.strength == 0) return;
    if (forces_.strength != 0 && law.center != forces_.center) closed_ = false;
    forces_.center = law.center;
    forces_.strength += law.strength;
  }

  double mass_;  // kg
  bool closed_ = true, constant_ = false;
  ClosedForces forces_;
};

}  // namespace

optional<ClosedForces> closed_forces(const World& world, Entity body, double time) {
  Gathering all(world.mass[body]);
  all.gravity(world.gravity);
  for (const Force& force : world.forces)
    if (acts(force, body, time)) std::visit([&](const auto& law) { all.add(law); }, force.law);
  return all.all();
}

/// The positive root of speed t + acceleration t^2 / 2 = reach / 2, without cancellation.
double step_within(double reach, double speed, double acceleration) {
  return reach / (speed + sqrt(speed * speed + acceleration * reach));
}

ClosedMotion::ClosedMotion(const ClosedForces& forces, const Vec3& x, const Vec3& v, const Vec3& at_rest)
    : origin_(forces.strength != 0 ? forces.center : x), strength_(forces.strength) {
  if (strength_ != 0)
    motion_ = KeplerOrbit(strength_, x - origin_, v);
  else
    motion_ = Oscillation{Vec3::Zero(), v, at_rest, forces.fade, forces.stiffness};
}

namespace {

/// The acceleration (m/s^2) and the jerk (m/s^3) about an attractor.
void fall(double strength, ClosedMotion::Point& there) {
  const double square = there.place.squaredNorm(), factor = -strength / (square * sqrt(square));
  there.acceleration = factor * there.place;
  there.jerk = factor * (there.velocity - 3 * there.place.dot(there.velocity) / square * there.place);
}

}  // namespace

ClosedMotion::Point ClosedMotion::at(DoubleDouble t) const {
  Point there;
  if (const auto* orbit = std::get_if<KeplerOrbit>(&motion_)) {
    orbit->at(t, there.place, there.velocity);
    fall(strength_, there);
    return there;
  }

  // The slopes carry an oscillation over the low part of the time.
  const Oscillation& swing = std::get<Oscillation>(motion_);
  swing.at(t.hi, there.place, there.velocity);
  swing.bend(t.hi, there.acceleration, there.jerk);
  there.place += t.lo * there.velocity;
  there.velocity += t.lo * there.acceleration;
  there.acceleration += t.lo * there.jerk;
  return there;
}

double ClosedMotion::rate(const Point& there) const {
  if (const auto* swing = std::get_if<Oscillation>(&motion_)) return sqrt(swing->stiffness);
  return there.velocity.norm() / there.place.norm();
}

double ClosedMotion::longest_step(const Point& there, double room) const {
  if (const auto* swing = std::get_if<Oscillation>(&motion_)) {
    const double turn = sqrt(swing->stiffness);
    const bool turns = 2 * turn > swing->fade;
    // An upper bound of the speed from there on, m/s.
    const double left = there.velocity.norm() + there.acceleration.norm() / turn;
    return turns && left > room * turn ? 1 / turn : infinity;
  }
  return step_within(there.place.norm(), there.velocity.norm(), there.acceleration.norm());
}

}  // namespace carom
