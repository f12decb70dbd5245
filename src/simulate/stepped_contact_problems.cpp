#include "simulate/stepped_contact_problems.h"

#include <algorithm>

#include "physics/projected_gradients.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

Certificate solve_cluster(std::span<const double> inverse_mass, std::span<Vec3> u,
                          std::vector<ContactConstraint>& contacts) {
  return carom::solve({inverse_mass, u, contacts});
}

Certificate hold_active(std::span<const double> inverse_mass, std::span<Vec3> u,
                        std::vector<ContactConstraint>& contacts) {
  for (ContactConstraint& c : contacts) c.bilateral = true;
  return carom::solve({inverse_mass, u, contacts});
}

bool solve_balance(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<ContactConstraint>& contacts) {
  if (u.size() <= most_direct_bodies) return carom::solve({inverse_mass, u, contacts}).solved();
  return project_gradients({inverse_mass, u, contacts}, balance_iterations);
}

bool GroupSolver::solve(std::span<const double> inverse_mass, std::vector<Vec3>& u,
                        std::vector<ContactConstraint>& pairs, int sweeps, int iterations) {
  if (pairs.size() <= small_problem) {
    sweeps = displacement_sweeps;
    iterations = many_iterations;
  }
  const std::vector<Vec3> free = iterations > 0 ? u : std::vector<Vec3>{};
  if (sweeps_.solve(inverse_mass, u, pairs, sweeps)) return true;
  if (iterations == 0) return false;
  u = free;
  if (project_gradients({inverse_mass, u, pairs}, iterations)) return true;
  if (pairs.size() > most_direct_pairs) return false;
  u = free;
  return carom::solve({inverse_mass, u, pairs}).solved();
}

}  // namespace carom
