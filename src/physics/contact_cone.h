#pragma once
// Frictionless contact with flat surfaces: of all motions that do not go into any of them, the one nearest to the free
// one.
#include <span>

#include "physics/vec3.h"

namespace carom {

/// min |u' - u| subject to n_i . u' >= 0 for the unit normals n_i (Gauss's principle of least constraint; the
/// complementarity problem 0 <= lambda, n . u' >= 0, lambda (n . u') = 0 for one body). u is an acceleration or a
/// velocity; u' has its unit. `active` gets bit i where surface i presses (lambda_i > 0). At most 32 normals.
Vec3 project_to_cone(const Vec3& u, std::span<const Vec3> normals, unsigned& active);

/// u without its components along any of the unit normals: motion that keeps every one of the contacts.
Vec3 project_to_common_plane(const Vec3& u, std::span<const Vec3> normals);

}  // namespace carom
