// Moves bodies, and all places of the world (physics/places.h), by an irrational share of the extent. All digits of
// their positions then change.
#include "bench/shifted.h"

#include "physics/places.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

World shifted(const World& world, const Vec3& by) {
  World moved = world;
  for_each_place(moved, [&](Vec3& place) { place += by; });
  return moved;
}

State shifted(State state, const Vec3& by) {
  for (Vec3& x : state.position) x += by;
  return state;
}

double extent(const World& world, const State& initial) {
  double most = 0;
  for (Entity i = 0; i < world.body_count(); ++i) most = max(most, initial.position[i].norm() + world.radius[i]);
  return most;
}

double rounding_of(const World& world, const State& initial) {
  return 0x1p-53 * extent(world, initial);
}

Vec3 shift(double extent, int number) {
  const auto fraction = [&](double root) { return number * root - floor(number * root); };
  return extent * Vec3(0.5 + fraction(sqrt(2.0)), 0.5 + fraction(sqrt(3.0)), 0.5 + fraction(sqrt(5.0)));
}

}  // namespace carom
