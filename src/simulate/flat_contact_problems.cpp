// Contact problems of one body on flat surfaces, by the general contact solver.
// The body has unit mass, because its own mass has no effect on the allowed motion.
#include "simulate/flat_contact_problems.h"

#include <array>

namespace carom {

namespace {

constexpr std::size_t most_flat = 32;

FlatSolution solve_one_body(const Vec3& u, std::span<const Vec3> normals, bool bilateral) {
  std::array<ContactConstraint, most_flat> contacts;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    contacts[k] = {0, ContactConstraint::fixed, -normals[k]};
    contacts[k].bilateral = bilateral;
  }
  constexpr double unit_mass = 1;
  FlatSolution solution{u, 0, {}};
  solution.certificate = solve({{&unit_mass, 1}, {&solution.u, 1}, {contacts.data(), normals.size()}});
  for (std::size_t k = 0; k < normals.size(); ++k)
    if (contacts[k].force > 0) solution.active |= 1u << k;
  return solution;
}

}  // namespace

FlatSolution solve_flat_contacts(const Vec3& u, std::span<const Vec3> normals) {
  return solve_one_body(u, normals, false);
}

FlatSolution keep_flat_contacts(const Vec3& u, std::span<const Vec3> normals) {
  return solve_one_body(u, normals, true);
}

}  // namespace carom
