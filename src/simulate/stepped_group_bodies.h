#pragma once
// The contact group's bodies in a step, in arrays of their own: body k is entity[k].
#include <algorithm>
#include <vector>

#include "physics/contact_time.h"
#include "physics/vec3.h"
#include "physics/world.h"

namespace carom {

struct GroupBodies {
  std::vector<Entity> entity;           // ascending
  std::vector<Vec3> x, v;               // m, m/s, as the step begins
  std::vector<Vec3> free_acceleration;  // m/s^2
  std::vector<double> inverse_mass;     // 1/kg
  double smallest_radius = never;       // m
  double greatest_acceleration = 0;     // m/s^2

  std::size_t size() const { return entity.size(); }
  void clear() {
    entity.clear();
    x.clear();
    v.clear();
    free_acceleration.clear();
    inverse_mass.clear();
    smallest_radius = never;
    greatest_acceleration = 0;
  }
  void add(const World& world, Entity i, const Vec3& at, const Vec3& velocity, const Vec3& acceleration) {
    entity.push_back(i);
    x.push_back(at);
    v.push_back(velocity);
    free_acceleration.push_back(acceleration);
    inverse_mass.push_back(1 / world.mass[i]);
    smallest_radius = std::min(smallest_radius, world.radius[i]);
    greatest_acceleration = std::max(greatest_acceleration, acceleration.norm());
  }
};

}  // namespace carom
