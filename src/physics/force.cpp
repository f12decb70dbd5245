#include "physics/force.h"

#include <algorithm>

namespace carom {

namespace {

bool acts_on(const Force& force, Entity body) {
  return force.on.empty() || std::binary_search(force.on.begin(), force.on.end(), body);
}

bool acts_for_ever(const Force& force) {
  return force.from == 0 && force.until == std::numeric_limits<double>::infinity();
}

}  // namespace

Vec3 free_acceleration(const World& world, Entity body, double time, const Vec3& x, const Vec3& v) {
  Vec3 a = world.gravity;
  for (const Force& force : world.forces) {
    if (time < force.from || time >= force.until || !acts_on(force, body)) continue;
    a += std::visit([&](const auto& law) { return law.acceleration({x, v, world.mass[body]}); }, force.law);
  }
  return a;
}

Vec3 working_acceleration(const World& world, Entity body, double time, const Vec3& x, const Vec3& v) {
  Vec3 a = Vec3::Zero();
  for (const Force& force : world.forces) {
    if (time < force.from || time >= force.until || !acts_on(force, body)) continue;
    const Particle p{x, v, world.mass[body]};
    const bool all = !acts_for_ever(force);
    a += std::visit([&](const auto& law) { return all ? law.acceleration(p) : law.drain(p); }, force.law);
  }
  return a;
}

double potential(const World& world, Entity body, const Vec3& x) {
  double sum = -world.mass[body] * world.gravity.dot(x);
  for (const Force& force : world.forces) {
    if (!acts_for_ever(force) || !acts_on(force, body)) continue;
    const Particle p{x, Vec3::Zero(), world.mass[body]};
    sum += std::visit([&](const auto& law) { return law.potential(p); }, force.law);
  }
  return sum;
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

bool is_constant(const ForceLaw& law) {
  return std::visit([](const auto& l) { return l.constant; }, law);
}

const Force* varying_force(const World& world) {
  for (const Force& force : world.forces)
    if (!is_constant(force.law)) return &force;
  return nullptr;
}

const Force* force_without_closed_form(const World& world) {
  for (const Force& force : world.forces) {
    const Drag* drag = std::get_if<Drag>(&force.law);
    if (!is_constant(force.law) && (drag == nullptr || drag->quadratic != 0)) return &force;
  }
  return nullptr;
}

double fade_of(const World& world, Entity body, double time) {
  double fade = 0;
  for (const Force& force : world.forces) {
    const Drag* drag = std::get_if<Drag>(&force.law);
    if (drag == nullptr || time < force.from || time >= force.until || !acts_on(force, body)) continue;
    fade += drag->linear / world.mass[body];
  }
  return fade;
}

bool varies(const World& world, Entity body, double time) {
  return std::any_of(world.forces.begin(), world.forces.end(), [&](const Force& force) {
    return !is_constant(force.law) && time >= force.from && time < force.until && acts_on(force, body);
  });
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

double default_step(const World& world, const State& initial) {
  double rate = 0;
  for (Entity i = 0; i < world.body_count(); ++i)
    rate = std::max(rate, force_rate(world, i, initial.position[i], initial.velocity[i]));
  return std::min(0.001, 0.005 / rate);
}

}  // namespace carom
