#include "physics/force.h"

#include <algorithm>

namespace carom {

namespace {

bool acts_on(const Force& force, Entity body) {
  return force.on.empty() || std::binary_search(force.on.begin(), force.on.end(), body);
}

}  // namespace

Vec3 free_acceleration(const World& world, Entity body, double time) {
  Vec3 a = world.gravity;
  for (const Force& force : world.forces) {
    if (time < force.from || time >= force.until || !acts_on(force, body)) continue;
    a += force.per_mass ? force.value : Vec3(force.value / world.mass[body]);
  }
  return a;
}

double next_switch(const World& world, Entity body, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Force& force : world.forces) {
    if (!acts_on(force, body)) continue;
    for (double t : {force.from, force.until})
      if (t > time) next = std::min(next, t);
  }
  return next;
}

}  // namespace carom
