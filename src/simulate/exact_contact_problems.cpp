#include "simulate/exact_contact_problems.h"

#include "physics/contact_cone.h"
#include "physics/few_contacts.h"

namespace carom {

bool solve_few_contacts(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs) {
  return press_few_apart(inverse_mass, u, pairs);
}

bool solve_contacts(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs,
                    int iterations) {
  return press_apart(inverse_mass, u, pairs, iterations);
}

bool solve_contacts_directly(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs) {
  return press_apart_directly(inverse_mass, u, pairs);
}

Vec3 solve_flat_contacts(const Vec3& u, std::span<const Vec3> normals, unsigned& active) {
  return project_to_cone(u, normals, active);
}

}  // namespace carom
