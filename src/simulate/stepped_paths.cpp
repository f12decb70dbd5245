#include "simulate/stepped_paths.h"

namespace carom {

StepPaths::StepPaths(const World& of, const State& initial)
    : world(of),
      x(initial.position),
      v(initial.velocity),
      start(of.body_count()),
      path(of.body_count()),
      origin(of.body_count()),
      version(of.body_count()) {
  if (!world.impulse.empty())
    for (Entity i = 0; i < world.body_count(); ++i) v[i] += world.impulse[i] / world.mass[i];
  for (Entity i = 0; i < world.body_count(); ++i) path[i] = {x[i], v[i], Vec3::Zero(), Vec3::Zero()};
  end_x = x;
  end_v = v;
}

Path StepPaths::from(Entity e, double time) const {
  if (!world.is_body(e)) return {world.fixed_position(e), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  return path[e].from(time - start[e]);
}

void StepPaths::cut(Entity i, double time, const Vec3& at, const Vec3& velocity, bool constrained) {
  if (time > start[i]) pieces.push_back({i, start[i], time, path[i], velocity, constrained});
  x[i] = at;
  v[i] = velocity;
  start[i] = time;
  origin[i] = {};
  ++version[i];
}

void StepPaths::wake(Entity i, double time) {
  start[i] = time;
  const Vec3 zero = Vec3::Zero();
  if (time > 0) pieces.push_back({i, 0, time, {x[i], zero, zero, zero}, zero, true});
}

void StepPaths::stay(Entity i) {
  path[i] = {x[i], Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  end_x[i] = x[i];
  end_v[i] = v[i];
}

}  // namespace carom
