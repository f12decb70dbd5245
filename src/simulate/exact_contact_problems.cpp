#include "simulate/exact_contact_problems.h"

#include <array>

#include "physics/projected_gradients.h"

namespace carom {

namespace {

constexpr std::size_t most_flat = 32;

/// One body's motion; the contacts' forces stay with them.
Vec3 solve_one_body(const Vec3& u, std::span<const Vec3> normals, std::array<ContactConstraint, most_flat>& contacts,
                    bool bilateral) {
  for (std::size_t k = 0; k < normals.size(); ++k) {
    contacts[k] = {0, ContactConstraint::fixed, -normals[k]};
    contacts[k].bilateral = bilateral;
  }
  constexpr double unit_mass = 1;
  Vec3 allowed = u;
  solve({{&unit_mass, 1}, {&allowed, 1}, {contacts.data(), normals.size()}});
  return allowed;
}

}  // namespace

Certificate solve_exactly(std::span<const double> inverse_mass, std::span<Vec3> u,
                          std::span<ContactConstraint> contacts) {
  return solve({inverse_mass, u, contacts});
}

bool solve_contacts(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<ContactConstraint> contacts,
                    int iterations) {
  return project_gradients({inverse_mass, u, contacts}, iterations);
}

Vec3 solve_flat_contacts(const Vec3& u, std::span<const Vec3> normals, unsigned& active) {
  std::array<ContactConstraint, most_flat> contacts;
  const Vec3 allowed = solve_one_body(u, normals, contacts, false);
  active = 0;
  for (std::size_t k = 0; k < normals.size(); ++k)
    if (contacts[k].force > 0) active |= 1u << k;
  return allowed;
}

Vec3 keep_flat_contacts(const Vec3& u, std::span<const Vec3> normals) {
  std::array<ContactConstraint, most_flat> contacts;
  return solve_one_body(u, normals, contacts, true);
}

}  // namespace carom
