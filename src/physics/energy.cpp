// Compensated sums have the rounding of a single number. Plain sums over many bodies would hide the energy error that
// they are to show.
#include "physics/energy.h"

#include "numerics/compensated.h"
#include "physics/body_now.h"
#include "physics/coupled_forces.h"
#include "physics/force.h"

namespace carom {

double kinetic_energy(const World& world, const State& state) {
  Sum sum;
  for (Entity i = 0; i < world.body_count(); ++i)
    sum.add(0.5 * mass_now(world, state, i) * state.velocity[i].squaredNorm());
  return sum.value();
}

double potential_energy(const World& world, const State& state) {
  const bool coupled = has_couplings(world);
  if (world.gravity.isZero(0) && world.forces.empty() && !coupled) return 0;
  Sum sum;
  for (Entity i = 0; i < world.body_count(); ++i)
    if (!is_removed(state, i)) sum.add(potential(world, i, state.position[i]));
  if (coupled) sum.add(coupled_forces(world, state).potential(state.position).sum());
  return sum.value();
}

Vec3 momentum(const World& world, const State& state) {
  Sum sum[3];
  for (Entity i = 0; i < world.body_count(); ++i)
    for (int k = 0; k < 3; ++k) sum[k].add(mass_now(world, state, i) * state.velocity[i][k]);
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

}  // namespace carom
