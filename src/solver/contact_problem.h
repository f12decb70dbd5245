#pragma once
// The one interface to frictionless contact. Of all motions that no contact forbids, it finds the one nearest to the
// free motion (Gauss's principle of least constraint). With the forces x_c >= 0 along the normals n_c as unknowns it is
// the complementarity problem
//   u = u_free + M^-1 N x,  w = N^T u - target,  0 <= x, 0 <= w, x w = 0.
// The motion u is unique, the forces need not be. On request they are the least ones (least_forces.h).
//
// Two methods solve it to rounding. Each is the other's fallback, and one certificate judges both (contact_island.h). A
// dual active set on orthogonal factors (active_set.h) serves small or ill-conditioned problems, and those similar to
// the last one. An interior point with a proximal Newton method on the bodies' sparse matrix (contact_interior_point.h)
// serves large ones. The cheaper method is chosen, unless masses are too unequal for the sparse one.

#include "solver/contact_constraint.h"
#include "std.h"

namespace carom {

/// The quality of a solution. It is the exact one, rounded, of data that differ from the given ones by `change`.
/// The change is relative to each row's own scale: a target's, or a free motion's, with the problem's greatest one.
struct Certificate {
  enum class Verdict : uint8_t {
    solved,  // to rounding, or to the required accuracy
    // No motion satisfies all contacts. Those that matter most to the method are satisfied.
    infeasible,
    doubtful  // no method came as near as rounding allows
  };
  Verdict verdict = Verdict::solved;
  double change = 0;
  bool solved() const { return verdict == Verdict::solved; }
  /// Combines the quality of two solutions.
  void merge(const Certificate& other) {
    verdict = max(verdict, other.verdict);
    change = max(change, other.change);
  }
};

/// Solves a sequence of similar problems faster, because it keeps the factors of the last one. The motion depends on
/// that in its last bits only.
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
  unique_ptr<Workspace> workspace_;
};

/// The same without memory of earlier problems. Units of mass, length and time that differ by powers of two give the
/// same bits.
Certificate solve(const ContactProblem& problem);

}  // namespace carom
