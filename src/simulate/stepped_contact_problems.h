#pragma once
// The contact problems of the stepped simulator (contact_problem.h) and how exactly each is solved.
#include <cstdint>
#include <span>
#include <vector>

#include "physics/contact_problem.h"
#include "physics/sweeps.h"
#include "physics/vec3.h"

namespace carom {

/// Moves u (m/s or m/s^2, by body) until no contact falls short of its target, and sets the forces: to rounding.
Certificate solve_cluster(std::span<const double> inverse_mass, std::span<Vec3> u,
                          std::vector<ContactConstraint>& contacts);

/// Moves u (m, m/s or m/s^2, by body) until every contact is at its target, and sets the forces; negative ones pull.
Certificate hold_active(std::span<const double> inverse_mass, std::span<Vec3> u,
                        std::vector<ContactConstraint>& contacts);

/// Moves u (m, by body), the displacements of a part of the contact group that sinks. Whether that converged.
bool solve_balance(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<ContactConstraint>& contacts);

/// The contact group's problems, of many pairs: by sweeps from the given forces, then by solvers that get nearer.
class GroupSolver {
 public:
  /// Moves u (m/s, by body) in at most `sweeps`, and then in at most as many iterations of conjugate gradients; 0: in
  /// none. Small problems get more of both. Whether that converged.
  bool solve(std::span<const double> inverse_mass, std::vector<Vec3>& u, std::vector<ContactConstraint>& pairs,
             int sweeps, int iterations);

 private:
  Sweeps sweeps_;
};

}  // namespace carom
