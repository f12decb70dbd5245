#include "simulate/stepped_contact_problems.h"

#include <algorithm>

#include "physics/few_contacts.h"
#include "physics/held_contacts.h"
#include "simulate/tolerances_stepped.h"

namespace carom {

using namespace stepped_tolerance;

void solve_cluster(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs) {
  for (PressedPair& p : pairs) p.force = 0;
  if (pairs.size() <= few_pairs) {
    press_few_apart(inverse_mass, u, pairs);
    return;
  }
  const std::vector<Vec3> free(u.begin(), u.end());
  if (press_apart(inverse_mass, u, pairs, cluster_iterations)) return;
  std::copy(free.begin(), free.end(), u.begin());
  press_apart_directly(inverse_mass, u, pairs);
}

void hold_active(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs) {
  hold(inverse_mass, u, pairs);
}

bool solve_balance(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs) {
  if (u.size() <= most_direct_bodies) return press_apart_directly(inverse_mass, u, pairs);
  return press_apart(inverse_mass, u, pairs, balance_iterations);
}

bool GroupSolver::solve(std::span<const double> inverse_mass, std::vector<Vec3>& u, std::vector<PressedPair>& pairs,
                        int sweeps, int iterations) {
  if (pairs.size() <= small_problem) {
    sweeps = displacement_sweeps;
    iterations = many_iterations;
  }
  const std::vector<Vec3> free = iterations > 0 ? u : std::vector<Vec3>{};
  if (sweeps_.press_apart(inverse_mass, u, pairs, sweeps)) return true;
  if (iterations == 0) return false;
  u = free;
  if (press_apart(inverse_mass, u, pairs, iterations)) return true;
  if (pairs.size() > most_direct_pairs) return false;
  u = free;
  return press_apart_directly(inverse_mass, u, pairs);
}

}  // namespace carom
