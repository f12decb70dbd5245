#pragma once
// The contact problems of one body on flat surfaces, solved by contact_problem.h. u: a velocity or an acceleration.
#include <span>

#include "solver/contact_problem.h"

namespace carom {

/// The motion of one body on flat surfaces.
struct FlatSolution {
  Vec3 u;               // allowed
  unsigned active = 0;  // bit k where surface k presses
  Certificate certificate;
};

/// The allowed motion for one body and flat surfaces with these unit normals, from the surface to the body. At most 32
/// of them.
FlatSolution solve_flat_contacts(const Vec3& u, std::span<const Vec3> normals);

/// u without its components along any of the unit normals: motion that keeps all contacts.
FlatSolution keep_flat_contacts(const Vec3& u, std::span<const Vec3> normals);

}  // namespace carom
