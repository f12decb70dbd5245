#pragma once
// Free motion in closed form under a force that varies with position.
// The force is that of linear springs of rest length 0 with linear drag and constant forces, or of one attractor
// without softening.
#include <variant>

#include "numerics/compensated.h"
#include "physics/entity.h"
#include "physics/kepler_orbit.h"
#include "physics/oscillation.h"
#include "std.h"

namespace carom {

struct World;

/// The forces of such a motion: either springs and drag, or an attractor alone.
struct ClosedForces {
  double fade = 0, stiffness = 0;  // 1/s and 1/s^2: linear drag, and all springs together, over the mass
  Vec3 center = Vec3::Zero();      // m, of the attractor
  double strength = 0;             // m^3/s^2; 0: springs, or no force of either kind

  void keep(auto& archive) { archive(fade, stiffness, center, strength); }

  friend bool operator==(const ClosedForces&, const ClosedForces&) = default;
};

/// The forces on a body from `time` (s) on. It is empty where they have no closed form of this kind together.
/// It is empty too where only constant forces and linear drag act.
optional<ClosedForces> closed_forces(const World& world, Entity body, double time);

/// The time (s) in which a body covers at most half of `reach` (m), from a speed (m/s) under an acceleration (m/s^2).
double step_within(double reach, double speed, double acceleration);

/// A motion from its start on.
class ClosedMotion {
 public:
  ClosedMotion() = default;
  /// Starts at x (m) and v (m/s). at_rest: the acceleration of a body at rest at x (m/s^2).
  ClosedMotion(const ClosedForces& forces, const Vec3& x, const Vec3& v, const Vec3& at_rest);

  /// The origin of all positions (m).
  const Vec3& origin() const { return origin_; }
  /// Position (m, from the origin), velocity (m/s), acceleration (m/s^2) and jerk (m/s^3).
  struct Point {
    Vec3 place, velocity, acceleration, jerk;
  };
  /// The motion at t (s, since the start). The time has two doubles: after a while one double is too coarse for a short
  /// step.
  Point at(DoubleDouble t) const;
  /// The rate at which the motion turns there (1/s).
  double rate(const Point& there) const;
  /// The longest step (s) from there on in which the motion does not turn, and comes at most half way to a centre.
  /// Turns of less than `room` (m) do not count.
  double longest_step(const Point& there, double room) const;

  void keep(auto& archive) { archive(origin_, strength_, motion_); }

 private:
  Vec3 origin_ = Vec3::Zero();
  double strength_ = 0;  // m^3/s^2, of an orbit
  std::variant<Oscillation, KeplerOrbit> motion_;
};

}  // namespace carom
