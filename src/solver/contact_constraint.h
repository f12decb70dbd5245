#pragma once
// The contacts of a problem as plain data.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// A contact between two bodies, or between a body and a fixed thing.
struct ContactConstraint {
  static constexpr uint32_t fixed = numeric_limits<uint32_t>::max();
  // Indices in the problem's arrays. b = `fixed`: an immovable thing.
  uint32_t a, b;
  Vec3 normal;        // from a to b; unit up to rounding
  double target = 0;  // lower bound of normal . (u_b - u_a); in the unit of u
  double slack = 0;   // of bilateral contacts; in the unit of u
  double force = 0;   // in: a guess; out: mass times the unit of u, along the normal; >= 0 unless bilateral
  // out: the same, by contacts that do not depend on each other. Where the motion leaves forces open, it differs from
  // the least force.
  double independent = 0;
  // normal . (u_b - u_a) must equal the target, and the force may pull too. Where others determine it already, it may
  // contradict them by its slack: lengths of a frame with more rods than it needs.
  bool bilateral = false;
  // normal . u_b of a fixed thing that moves; in the unit of u. Otherwise 0.
  double surface = 0;
  void keep(auto& archive) { archive(a, b, normal, target, slack, force, independent, bilateral, surface); }

  /// The work of such a thing by the force, which pushes a against the normal.
  double work() const { return -force * surface; }
};

/// The speed of approach of a contact's bodies along its normal, in the unit of `motion`.
inline double approach(span<const Vec3> motion, const ContactConstraint& c) {
  const Vec3 b = c.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : motion[c.b];
  return c.normal.dot(motion[c.a] - b) - c.surface;
}

/// The inverse mass of a contact's second body (1/kg): 0 for an immovable thing.
inline double inverse_mass_of_b(span<const double> inverse_mass, const ContactConstraint& c) {
  return c.b == ContactConstraint::fixed ? 0 : inverse_mass[c.b];
}

struct ContactProblem {
  span<const double> inverse_mass;  // 1/kg, > 0, by body
  span<Vec3> motion;                // velocities, accelerations or displacements; in: free; out: allowed
  span<ContactConstraint> contacts;
  // Of the forces that give this motion, those of equally stiff contacts: the sum of their squares is the least. They
  // do not depend on the order of contacts.
  bool least_forces = false;
};

}  // namespace carom
