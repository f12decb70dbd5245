// The effect of gravity and the World's forces on a body: sums over the laws of force_law.h.
// The laws are plain structs in a variant, so that sums need no change for a new law. Sums follow the order of the
// scene.
#include "physics/force.h"

#include "physics/closed_motion.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

bool acts_for_ever(const Force& force) {
  return force.from == 0 && force.until == infinity;
}

/// Whether a force of which this is true acts on a body at `time` (s).
template <typename Is>
bool any_acts(const World& world, Entity body, double time, const Is& is) {
  return any_of(world.forces, [&](const Force& force) { return std::visit(is, force.law) && acts(force, body, time); });
}

double reach_of(const ForceLaw& law, const Vec3& x) {
  return std::visit([&](const auto& l) { return l.reach(x); }, law);
}

}  // namespace

Vec3 free_acceleration(const World& world, Entity body, double time, const Vec3& x, const Vec3& v) {
  return free_acceleration(world, body, time, {x, v, world.mass[body]});
}

Vec3 free_acceleration(const World& world, Entity body, double time, const Particle& particle) {
  Vec3 a = world.gravity;
  for (const Force& force : world.forces) {
    if (!acts(force, body, time)) continue;
    a += std::visit([&](const auto& law) { return law.acceleration(particle); }, force.law);
  }
  return a;
}

Vec3 working_acceleration(const World& world, const Force& force, Entity body, const Vec3& x, const Vec3& v) {
  const Particle p{x, v, world.mass[body]};
  const bool all = !acts_for_ever(force);
  return std::visit([&](const auto& law) { return all ? law.acceleration(p) : law.drain(p); }, force.law);
}

double potential(const World& world, Entity body, const Vec3& x) {
  double sum = -world.mass[body] * world.gravity.dot(x);
  for (const Force& force : world.forces) sum += potential(world, force, body, x);
  return sum;
}

double potential(const World& world, const Force& force, Entity body, const Vec3& x) {
  if (!acts_for_ever(force) || !acts_on(force, body)) return 0;
  const Particle p{x, Vec3::Zero(), world.mass[body]};
  return std::visit([&](const auto& law) { return law.potential(p); }, force.law);
}

double next_switch(const World& world, Entity body, double time) {
  double next = infinity;
  for (const Force& force : world.forces) {
    if (!acts_on(force, body)) continue;
    for (double t : {force.from, force.until})
      if (t > time) next = min(next, t);
  }
  return next;
}

bool is_constant(const ForceLaw& law) {
  return std::visit([](const auto& l) { return l.constant; }, law);
}

const Force* varying_force(const World& world) {
  for (const Force& force : world.forces)
    if (!is_constant(force.law)) return &force;
  return nullptr;
}

bool bends(const ForceLaw& law) {
  return std::visit([](const auto& l) { return l.bends(); }, law);
}

const Force* bending_force(const World& world) {
  for (const Force& force : world.forces)
    if (bends(force.law)) return &force;
  return nullptr;
}

bool bends(const World& world, Entity body, double time) {
  return any_acts(world, body, time, [](const auto& law) { return law.bends(); });
}

namespace {

/// A force because of which a body's motion from `time` (s) on has no closed form.
/// That is one without a closed form of its own, if there is one. Otherwise it is one of those that have none together.
const Force* open_force(const World& world, Entity body, double time) {
  if (!bends(world, body, time) || closed_forces(world, body, time)) return nullptr;
  const Force* any = nullptr;
  for (const Force& force : world.forces) {
    if (!bends(force.law) || !acts(force, body, time)) continue;
    if (!std::visit([](const auto& law) { return law.closed(); }, force.law)) return &force;
    any = &force;
  }
  return any;
}

}  // namespace

const Force* force_without_closed_form(const World& world) {
  if (bending_force(world) == nullptr) return nullptr;

  // What waits for events may act at any time.
  if (!world.triggers.all.empty()) {
    World all = world;
    for (const TriggeredEnd& end : all.triggers.ends)
      if (end.of == TriggeredEnd::Of::force) all.forces[end.index].from = 0, all.forces[end.index].until = infinity;
    all.triggers = {};
    if (const Force* const open = force_without_closed_form(all))
      return &world.forces[size_t(open - all.forces.data())];
  }

  const bool alike = all_of(world.forces, [](const Force& f) { return f.on.empty(); });
  const Entity bodies = alike ? min<Entity>(1, world.body_count()) : world.body_count();
  for (Entity i = 0; i < bodies; ++i)
    for (double time = 0; time < infinity; time = next_switch(world, i, time))
      if (const Force* open = open_force(world, i, time)) return open;
  return nullptr;
}

bool damps(const World& world, Entity body, double time) {
  return any_acts(world, body, time, [](const auto& law) { return law.damps(); });
}

double fade_of(const ForceLaw& law) {
  return std::visit([](const auto& l) { return l.fade(); }, law);
}

double fade_of(const World& world, Entity body, double time) {
  double fade = 0;
  for (const Force& force : world.forces) {
    if (acts(force, body, time)) fade += fade_of(force.law) / world.mass[body];
  }
  return fade;
}

const char* name_of(const ForceLaw& law) {
  return std::visit([](const auto& l) { return l.name; }, law);
}

double force_rate(const World& world, Entity body, const Vec3& x, const Vec3& v) {
  double most = 0;
  for (const Force& force : world.forces) {
    if (!acts_on(force, body)) continue;
    most += std::visit([&](const auto& law) { return law.rate({x, v, world.mass[body]}); }, force.law);
  }
  return most;
}

double force_reach(const World& world, Entity body, const Vec3& x) {
  double least = everywhere;
  for (const Force& force : world.forces)
    if (acts_on(force, body)) least = min(least, reach_of(force.law, x));
  return least;
}

double left_of_speed(const World& world, Entity body, double time, const Vec3& x, const Vec3& v) {
  double depth = 0;  // m^2/s^2
  for (const Force& force : world.forces) {
    if (reach_of(force.law, x) == everywhere || !acts(force, body, time)) continue;
    depth = max(depth, -std::visit([&](const auto& law) { return law.potential({x, v, 1}); }, force.law));
  }

  const double kinetic = 0.5 * v.squaredNorm();
  return depth > 0 && kinetic > 0 ? min(std::abs(kinetic - depth) / kinetic, 1.0) : 1;
}

ForceJacobian force_jacobian(const World& world, Entity body, double time, const Vec3& x, const Vec3& v) {
  ForceJacobian sum;
  for (const Force& force : world.forces) {
    if (!acts(force, body, time)) continue;
    sum += std::visit([&](const auto& law) { return jacobian(law, {x, v, world.mass[body]}); }, force.law);
  }
  return sum;
}

double default_step(const World& world, const State& initial) {
  double rate = 0;
  for (Entity i = 0; i < world.body_count(); ++i)
    rate = max(rate, force_rate(world, i, initial.position[i], initial.velocity[i]));
  return min(0.001, 0.005 / rate);
}

}  // namespace carom
