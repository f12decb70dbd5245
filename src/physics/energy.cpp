// Compensated sums have the rounding of a single number. Plain sums over many bodies would hide the energy error that
// they are to show.
#include "physics/energy.h"

#include "numerics/compensated.h"
#include "physics/force.h"
#include "physics/world.h"

namespace carom {

namespace {

double mass_of(const World& world, const State& state, Entity i) {
  return state.mass.empty() ? world.mass[i] : state.mass[i];
}

}  // namespace

double kinetic_energy(const World& world, const State& state) {
  Sum sum;
  for (Entity i = 0; i < world.body_count(); ++i)
    sum.add(0.5 * mass_of(world, state, i) * state.velocity[i].squaredNorm());
  return sum.value();
}

double potential_energy(const World& world, const State& state) {
  if (world.gravity.isZero(0) && world.forces.empty()) return 0;
  Sum sum;
  for (Entity i = 0; i < world.body_count(); ++i) sum.add(potential(world, i, state.position[i]));
  return sum.value();
}

Vec3 momentum(const World& world, const State& state) {
  Sum sum[3];
  for (Entity i = 0; i < world.body_count(); ++i)
    for (int k = 0; k < 3; ++k) sum[k].add(mass_of(world, state, i) * state.velocity[i][k]);
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

}  // namespace carom
