#pragma once
// The contact problems of the stepped simulator and how exactly each is solved. In clusters and in the contact group
// they are those of complementarity.h. Where it is known which contacts are active, those of held_contacts.h.
#include <cstdint>
#include <span>
#include <vector>

#include "physics/complementarity.h"
#include "physics/sweeps.h"
#include "physics/vec3.h"

namespace carom {

/// Moves u (m/s or m/s^2, by body) until no pair falls short of its target, and sets the forces; their guesses are not
/// used. For clusters: to rounding where pairs are few.
void solve_cluster(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs);

/// Moves u (m, m/s or m/s^2, by body) until every pair is at its target, and sets the forces; negative ones pull.
void hold_active(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs);

/// Moves u (m, by body), the displacements of a part of the contact group that sinks. Whether that converged.
bool solve_balance(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs);

/// The contact group's problems, of many pairs: by sweeps from the given forces, then by solvers that get nearer.
class GroupSolver {
 public:
  /// Moves u (m/s, by body) in at most `sweeps`, and then in at most as many iterations of conjugate gradients; 0: in
  /// none. Small problems get more of both. Whether that converged.
  bool solve(std::span<const double> inverse_mass, std::vector<Vec3>& u, std::vector<PressedPair>& pairs, int sweeps,
             int iterations);

 private:
  Sweeps sweeps_;
};

}  // namespace carom
