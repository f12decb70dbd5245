// Maxwell, Philosophical Magazine 19 (1860) 19. In d dimensions the density of v is the chi distribution with d degrees
// of freedom, scaled by the deviation of a component.
#include "physics/maxwell.h"

#include <numbers>

#include "numerics/elementary.h"
#include "std.h"

namespace carom {

namespace {

constexpr double least_share = 1e-12;

}  // namespace

double maxwell_density(double speed, int dimensions, double deviation) {
  const double ratio = speed / deviation, fall = exp_minus(ratio * ratio / 2) / deviation;
  if (dimensions == 2) return ratio * fall;
  return sqrt(2 / std::numbers::pi) * (dimensions == 1 ? 1 : ratio * ratio) * fall;
}

void EnergyByDirection::add(double mass, const Vec3& v) {
  const array<double, 6> products = {v.x() * v.x(), v.y() * v.y(), v.z() * v.z(),
                                     v.x() * v.y(), v.x() * v.z(), v.y() * v.z()};
  for (size_t k = 0; k < products.size(); ++k) sum_[k] += mass * products[k];
}

int EnergyByDirection::dimensions() const {
  // Cholesky's factors with the largest pivot first reveal the rank of a matrix without negative eigenvalues.
  array<array<double, 3>, 3> m = {
      {{sum_[0], sum_[3], sum_[4]}, {sum_[3], sum_[1], sum_[5]}, {sum_[4], sum_[5], sum_[2]}}};
  array<bool, 3> used{};

  for (int rank = 0; rank < 3; ++rank) {
    size_t pivot = 3;
    for (size_t k = 0; k < 3; ++k)
      if (!used[k] && (pivot == 3 || m[k][k] > m[pivot][pivot])) pivot = k;
    if (!(m[pivot][pivot] > least_share * 2 * kinetic())) return rank;

    // The other directions lose what they share with the pivot.
    used[pivot] = true;
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j)
        if (!used[i] && !used[j]) m[i][j] -= m[i][pivot] * m[pivot][j] / m[pivot][pivot];
  }
  return 3;
}

}  // namespace carom
