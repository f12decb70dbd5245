#pragma once
// The contact problems of the exact simulator: every call of a solver is here. u: velocities, accelerations or
// displacements of bodies with these inverse masses (1/kg); in: free, out: allowed. The contacts get their forces, in
// mass times the unit of u (contact_problem.h).
#include <span>

#include "physics/contact_problem.h"

namespace carom {

/// To rounding.
Certificate solve_exactly(std::span<const double> inverse_mass, std::span<Vec3> u,
                          std::span<ContactConstraint> contacts);

/// To the contacts' slack, by at most `iterations`. Whether they converged.
bool solve_contacts(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<ContactConstraint> contacts,
                    int iterations);

/// The motion of one body on flat surfaces.
struct FlatSolution {
  Vec3 u;               // allowed
  unsigned active = 0;  // bit k where surface k presses
  Certificate certificate;
};

/// For one body and flat surfaces with these unit normals, from the surface to the body. At most 32 of them.
FlatSolution solve_flat_contacts(const Vec3& u, std::span<const Vec3> normals);

/// u without its components along any of the unit normals: motion that keeps every one of the contacts.
FlatSolution keep_flat_contacts(const Vec3& u, std::span<const Vec3> normals);

}  // namespace carom
