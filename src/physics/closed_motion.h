#pragma once
// Free motion that has a closed form though its force varies with the place: under linear springs of rest length 0 with
// linear drag and constant forces, or about one attractor without softening.
#include <optional>
#include <variant>

#include "numerics/compensated.h"
#include "physics/entity.h"
#include "physics/kepler_orbit.h"
#include "physics/oscillation.h"

namespace carom {

struct World;

/// What forces such a motion: either springs and drag, or an attractor alone.
struct ClosedForces {
  double fade = 0, stiffness = 0;  // 1/s, 1/s^2: of springs together, over the mass
  Vec3 center = Vec3::Zero();      // m, of the attractor
  double strength = 0;             // m^3/s^2; 0: springs, or none of both

  friend bool operator==(const ClosedForces&, const ClosedForces&) = default;
};

/// The forces that act on a body from `time` (s) on; none: together they have no closed form, constant ones and linear
/// drag alone included.
std::optional<ClosedForces> closed_forces(const World& world, Entity body, double time);

/// A motion from its start on.
class ClosedMotion {
 public:
  ClosedMotion() = default;
  /// From x (m) and v (m/s). at_rest: m/s^2, what accelerates a body at x that stands.
  ClosedMotion(const ClosedForces& forces, const Vec3& x, const Vec3& v, const Vec3& at_rest);

  /// m: places are told from here.
  const Vec3& origin() const { return origin_; }
  /// Place (m, from the origin), velocity (m/s), acceleration (m/s^2) and jerk (m/s^3).
  struct Point {
    Vec3 place, velocity, acceleration, jerk;
  };
  /// At t (s, since the start): in two doubles, for one is coarser after some time than a short step can bear.
  Point at(DoubleDouble t) const;
  /// 1/s: how fast it turns there.
  double rate(const Point& there) const;
  /// s: from there on, a step in which the motion does not turn, and comes no nearer to a centre than half way. Turns
  /// of less than `room` (m) do not count.
  double longest_step(const Point& there, double room) const;

 private:
  Vec3 origin_ = Vec3::Zero();
  double strength_ = 0;  // m^3/s^2, of an orbit
  std::variant<Oscillation, KeplerOrbit> motion_;
};

}  // namespace carom
