#pragma once
// The one door to frictionless contact: of all motions that no contact forbids, the one nearest to the free one
// (Gauss's principle of least constraint). With the forces x_c >= 0 along the normals n_c as unknowns it is the
// complementarity problem
//   u = u_free + M^-1 N x,  w = N^T u - target,  0 <= x, 0 <= w, x w = 0.
// The motion u is unique, the forces need not be.
//
// Two methods find it to rounding. A dual active set on orthogonal factors (active_set.h) is for what is small,
// ill-conditioned or nearly as it was last time. An interior point with a proximal Newton method on the bodies' sparse
// matrix (contact_interior_point.h) is for what is large. Each is the other's fallback, and one certificate judges both
// (contact_island.h). Cost chooses between them, unless masses are too unequal for the sparse one. Where contacts may
// be off by their slack projected gradients (contact_projected_gradients.h) go first, while they are cheaper.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "numerics/vec3.h"

namespace carom {

/// Two bodies, or a body and something fixed, that contact keeps from each other.
struct ContactConstraint {
  static constexpr std::uint32_t fixed = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t a, b;      // places in the problem's arrays; b `fixed`: something that nothing moves
  Vec3 normal;             // from a to b; unit but for rounding
  double target = 0;       // normal . (u_b - u_a) must not be less; in the unit of u
  double slack = 0;        // an answer that is this much short of it will do; in the unit of u
  double force = 0;        // in: a guess; out: mass times the unit of u, along the normal; >= 0 unless bilateral
  bool bilateral = false;  // normal . (u_b - u_a) must be the target: the force may pull too
};

/// How fast a contact's bodies approach each other along its normal, in the unit of `motion`.
inline double approach(std::span<const Vec3> motion, const ContactConstraint& c) {
  const Vec3 b = c.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : motion[c.b];
  return c.normal.dot(motion[c.a] - b);
}

/// How near an answer has to be. A contact that is off by its slack s has the kinetic energy of the motion that would
/// mend it: s^2 / (2/m_a + 2/m_b).
enum class ContactAccuracy : std::uint8_t {
  rounding,  // whatever the contacts' slack
  contacts,  // every contact is within its slack
  energy     // or an iterative method gains less in the second half of its work than that, by contact, of the least
};

struct ContactProblem {
  std::span<const double> inverse_mass;  // 1/kg, > 0, by body
  std::span<Vec3> motion;                // velocities, accelerations or displacements; in: free; out: allowed
  std::span<ContactConstraint> contacts;
  ContactAccuracy accuracy = ContactAccuracy::rounding;
};

/// What is known of an answer. It is the exact one, rounded, of data that differ from the given ones by `change`
/// relative to each row's own scale: a target's, or a free motion's, with the problem's greatest one.
struct Certificate {
  enum class Verdict : std::uint8_t {
    solved,      // to rounding, or as nearly as was asked
    infeasible,  // no motion keeps all contacts: those that matter most to the method are kept
    doubtful     // neither method has got as near as rounding allows
  };
  Verdict verdict = Verdict::solved;
  double change = 0;
  bool solved() const { return verdict == Verdict::solved; }
  /// What is known of both answers.
  void merge(const Certificate& other) {
    verdict = std::max(verdict, other.verdict);
    change = std::max(change, other.change);
  }
};

/// Solves problems that are alike faster one after the other: it keeps the factors of the last one. The motion that it
/// finds does not depend on that but for its last bits.
class ContactSolver {
 public:
  ContactSolver();
  ~ContactSolver();
  ContactSolver(ContactSolver&&) noexcept;
  ContactSolver& operator=(ContactSolver&&) noexcept;

  Certificate solve(const ContactProblem& problem);

 private:
  friend Certificate solve(const ContactProblem& problem);
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// The same without memory of what came before. Masses, lengths and times in other units, powers of two apart, give the
/// same bits.
Certificate solve(const ContactProblem& problem);

}  // namespace carom
