// Book-keeping of merged bodies. Forces act on each part by its share of the mass, with the mass and position that the
// scene gave it. Volumes add up: the joint body has the shape of the heavier one, scaled to the sum of both volumes.
#include "simulate/path/merged_bodies.h"

#include "geometry/contact_time.h"
#include "numerics/cube_root.h"
#include "physics/force.h"
#include "physics/world_now.h"
#include "std.h"

namespace carom {

MergedBodies::MergedBodies(const World& world, bool merge)
    : timed_(world.triggers.all.empty() ? nullptr : make_unique<World>(world)),
      given_(timed_ ? *timed_ : world),
      joint_(merge ? make_unique<World>(world) : nullptr) {}

void MergedBodies::set_off(uint32_t trigger, double time) {
  carom::set_off(*timed_, trigger, time);
  if (joint_) carom::set_off(*joint_, trigger, time);
}

void MergedBodies::begin() {
  const Entity n = given_.body_count();
  whole_of_.resize(n);
  for (Entity i = 0; i < n; ++i) whole_of_[i] = i;
  parts_.resize(n);
  share_.assign(n, 1);
}

AppliedAcceleration MergedBodies::applied(Entity i, double time) const {
  // Position and velocity have no effect.
  const Vec3 any = Vec3::Zero();

  const auto on = [&](const World& world, Entity body) {
    return AppliedAcceleration{free_acceleration(world, body, time, any, any), fade_of(world, body, time)};
  };

  if (parts_.empty() || parts_[i].empty()) return on(world(), i);
  AppliedAcceleration sum{Vec3::Zero(), 0};
  for (const Entity part : parts_[i]) {
    const AppliedAcceleration its = on(given_, part);
    sum.all += share_[part] * its.all;
    sum.fade += share_[part] * its.fade;
  }
  return sum;
}

bool MergedBodies::bends(Entity i, double time) const {
  if (parts_.empty() || parts_[i].empty()) return carom::bends(world(), i, time);
  return any_of(parts_[i], [&](Entity part) { return carom::bends(given_, part, time); });
}

Vec3 MergedBodies::acceleration(Entity i, double time, const Vec3& x, const Vec3& v) const {
  if (parts_.empty() || parts_[i].empty()) return free_acceleration(world(), i, time, x, v);
  Vec3 sum = Vec3::Zero();
  for (const Entity part : parts_[i]) sum += share_[part] * free_acceleration(given_, part, time, x, v);
  return sum;
}

Vec3 MergedBodies::working_acceleration(const Force& force, Entity i, double time, const Vec3& x, const Vec3& v) const {
  const auto on = [&](const World& world, Entity body) {
    return acts(force, body, time) ? carom::working_acceleration(world, force, body, x, v) : Vec3(Vec3::Zero());
  };
  if (parts_.empty() || parts_[i].empty()) return on(world(), i);
  Vec3 sum = Vec3::Zero();
  for (const Entity part : parts_[i]) sum += share_[part] * on(given_, part);
  return sum;
}

vector<pair<Entity, double>> MergedBodies::shares_of(Entity i) const {
  vector<pair<Entity, double>> shares;
  for (const Entity part : parts_of(i)) shares.emplace_back(part, share_[part]);
  return shares;
}

double MergedBodies::next_switch(Entity i, double time) const {
  if (parts_.empty() || parts_[i].empty()) return carom::next_switch(world(), i, time);
  double next = never;
  for (const Entity part : parts_[i]) next = min(next, carom::next_switch(world(), part, time));
  return next;
}

double MergedBodies::potential(Entity i, const Vec3& x) const {
  if (parts_.empty() || parts_[i].empty()) return carom::potential(given_, i, x);
  double sum = 0;
  for (const Entity part : parts_[i]) sum += carom::potential(given_, part, x);
  return sum;
}

void MergedBodies::join(Entity whole, Entity part) {
  if (whole_of_.empty()) begin();
  World& world = *joint_;

  const double mw = world.mass[whole];
  const double mp = world.mass[part];
  const double mass = mw + mp;

  // Volumes add up, in the shape of `whole`.
  Volume volume = world.volume_of(whole);
  volume.half *= cube_root((volume.size() + world.volume_of(part).size()) / volume.size());
  if (!world.volume.empty()) world.volume[whole] = volume;
  world.radius[whole] = volume.reach();
  world.restitution[whole] = (mw * world.restitution[whole] + mp * world.restitution[part]) / mass;
  world.mass[whole] = mass;

  // The parts of both, and their shares of the mass.
  for (const Entity i : {whole, part})
    if (parts_[i].empty()) parts_[i].push_back(i);
  for (const Entity i : parts_[part]) parts_[whole].push_back(i);
  for (const Entity i : parts_[whole]) share_[i] = given_.mass[i] / mass;
  parts_[part].clear();
  whole_of_[part] = whole;
}

void MergedBodies::remove(Entity i) {
  if (whole_of_.empty()) begin();
  whole_of_[i] = no_entity;
}

}  // namespace carom
