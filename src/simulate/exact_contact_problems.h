#pragma once
// The contact problems of the exact simulator: every call of a solver is here. u: velocities, accelerations or
// displacements of bodies with these inverse masses (1/kg); in: free, out: allowed. The pairs get their forces, in mass
// times the unit of u (complementarity.h).
#include <span>

#include "physics/complementarity.h"

namespace carom {

/// For a few pairs: to rounding.
bool solve_few_contacts(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs);

/// For any number of pairs: by at most `iterations`. Whether they converged.
bool solve_contacts(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs,
                    int iterations);

/// For pairs in a pile, where iterations do not converge; the cost grows as the square of the number of bodies.
bool solve_contacts_directly(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs);

/// For one body and flat surfaces with these unit normals, from the surface to the body. Gives the allowed u; `active`
/// gets bit k where surface k presses.
Vec3 solve_flat_contacts(const Vec3& u, std::span<const Vec3> normals, unsigned& active);

}  // namespace carom
