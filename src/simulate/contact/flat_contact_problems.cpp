// Contact problems of one body on flat surfaces, by the general contact solver.
// The body has unit mass, because its own mass has no effect on the allowed motion.
#include "simulate/contact/flat_contact_problems.h"

#include "std.h"

namespace carom {

namespace {

constexpr size_t most_flat = 32;

FlatSolution solve_one_body(const Vec3& u, span<const FlatSurface> surfaces, bool bilateral, span<double> pushes) {
  array<ContactConstraint, most_flat> contacts;
  for (size_t k = 0; k < surfaces.size(); ++k) {
    contacts[k] = {0, ContactConstraint::fixed, -surfaces[k].normal};
    contacts[k].bilateral = bilateral;
    contacts[k].surface = -surfaces[k].u;
  }

  constexpr double unit_mass = 1;
  FlatSolution solution;
  solution.u = u;
  solution.certificate = solve({{&unit_mass, 1}, {&solution.u, 1}, {contacts.data(), surfaces.size()}, true});

  for (size_t k = 0; k < surfaces.size(); ++k) {
    if (contacts[k].force > 0) solution.active |= 1u << k;
    solution.work += contacts[k].work();
    if (!pushes.empty()) pushes[k] = contacts[k].force;
  }
  return solution;
}

}  // namespace

FlatSolution solve_flat_contacts(const Vec3& u, span<const FlatSurface> surfaces, span<double> pushes) {
  return solve_one_body(u, surfaces, false, pushes);
}

FlatSolution keep_flat_contacts(const Vec3& u, span<const FlatSurface> surfaces, span<double> pushes) {
  return solve_one_body(u, surfaces, true, pushes);
}

}  // namespace carom
