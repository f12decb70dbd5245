#pragma once
// The contact problems of one body on flat surfaces, solved by contact_problem.h. u: a velocity or an acceleration.

#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

/// The motion of one body on flat surfaces.
struct FlatSolution {
  Vec3 u;               // allowed
  double work = 0;      // by surfaces that move: of one mass unit, in the unit of u squared
  unsigned active = 0;  // bit k where surface k presses
  Certificate certificate{};
};

/// A flat surface: its unit normal, from the surface to the body, and its own motion along that.
struct FlatSurface {
  Vec3 normal;
  double u = 0;
};

/// The allowed motion for one body and flat surfaces. At most 32 of them. `pushes`: by surface, what it adds along its
/// normal, unless that is empty.
FlatSolution solve_flat_contacts(const Vec3& u, span<const FlatSurface> surfaces, span<double> pushes = {});

/// u with the surfaces' components along their normals: motion that keeps all contacts.
FlatSolution keep_flat_contacts(const Vec3& u, span<const FlatSurface> surfaces, span<double> pushes = {});

}  // namespace carom
