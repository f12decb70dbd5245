// Perfectly inelastic collisions: bodies that meet become one (chapter 8's two lumps of clay). The joint body keeps
// mass, momentum, volume and the centre of mass; it goes by the name of the heavier of the two (of the first, if they
// weigh the same) and has its shape. Where the joint volume reaches into a third body, the two have met as well; where
// it reaches into something fixed, it is moved out.
#include <algorithm>
#include <cmath>

#include "physics/force.h"
#include "physics/impact.h"
#include "simulate/exact_simulator.h"

namespace carom {

void ExactSimulator::merge(Entity a, Entity b, const Touch& there) {
  const Entity n = world_.body_count();
  if (part_of_.empty()) {
    part_of_.resize(n);
    for (Entity i = 0; i < n; ++i) part_of_[i] = i;
    parts_.resize(n);
    joint_share_.assign(n, 1);
  }
  World& world = *joint_world_;
  const Entity whole = world.mass[b] > world.mass[a] ? b : a, part = whole == a ? b : a;
  const double mw = world.mass[whole], mp = world.mass[part], mass = mw + mp;
  const auto x = [&](Entity i) { return flight_[i].position(now_ - flight_[i].start); };
  const auto v = [&](Entity i) { return flight_[i].velocity(now_ - flight_[i].start); };
  const Vec3 xa = x(a), xb = x(b), va = v(a), vb = v(b);
  path_changes(a);
  path_changes(b);
  book_flight(a, xa);
  book_flight(b, xb);
  const Vec3 w = vb - va;
  const double approach = std::max(-w.dot(there.normal), 0.0);
  const double lost = 0.5 * (mw * mp / mass) * w.squaredNorm();
  log_.lose(lost);
  Collision met =
      make_collision(world_, CollisionKind::merge, now_.hi, a, b, there.point, there.normal, approach, 0, 0);
  met.impulse = approach * (mw * mp / mass);
  met.energy_lost = lost;  // of the motion along the surfaces too
  log_.record(met);

  const double potential_before = potential_of(a, xa) + potential_of(b, xb);

  // Joint: centre of mass and momentum, volume, restitution by mass; forces go on acting on the parts.
  const Vec3 joint_x = x(whole) + (mp / mass) * (x(part) - x(whole));
  const Vec3 joint_v = v(whole) + (mp / mass) * (v(part) - v(whole));
  Volume volume = world.volume_of(whole);
  const double grown = std::cbrt((volume.size() + world.volume_of(part).size()) / volume.size());
  volume.half *= grown;
  if (!world.volume.empty()) world.volume[whole] = volume;
  world.radius[whole] = volume.reach();
  world.restitution[whole] = (mw * world.restitution[whole] + mp * world.restitution[part]) / mass;
  world.mass[whole] = mass;
  if (parts_[whole].empty()) parts_[whole].push_back(whole);
  if (parts_[part].empty()) parts_[part].push_back(part);
  if (!world.forces.empty()) {
    pull_.write(whole) += (mp / mass) * (pull_[part] - pull_[whole]);
    driven_.write(whole) += (mp / mass) * (driven_[part] - driven_[whole]);
  }
  for (Entity i : parts_[part]) parts_[whole].push_back(i);
  for (Entity i : parts_[whole]) joint_share_[i] = given_->mass[i] / mass;
  parts_[part].clear();
  part_of_[part] = whole;

  for (Entity i : {a, b}) {
    if (contacts_[i].count == 0) continue;
    contacts_.write(i).count = 0;
    log_.remove_resting(1);
  }
  neighbours_.remove(part);
  new_version(part);
  body_[part].event = {};
  queue_.update(part, never);
  flight_.set(part, {now_, joint_x, Vec3::Zero(), Vec3::Zero()});

  if (!world.forces.empty()) log_.lose(potential_before - potential_of(whole, joint_x));
  Flight f{now_, joint_x, joint_v, pull_[whole]};
  flight_.set(whole, f);
  new_version(whole);
  body_[whole].set_origin({});
  rebuild_region(whole);
  for (int pass = 0; pass < 8; ++pass) {
    bool free = true;
    for (Entity e : known_to(whole)) {
      if (world.is_body(e)) continue;
      const Touch t = touch(world, whole, f.x, e, world.fixed_position(e));
      if (!(t.gap < 0)) continue;
      const Vec3 out = t.gap * t.normal;
      log_.add_work(potential_of(whole, f.x + out) - potential_of(whole, f.x));  // that lifting it takes
      f.x += out;
      free = false;
    }
    flight_.set(whole, f);
    if (free) break;
  }
  for (Entity e : known_to(whole)) {
    if (!world.is_body(e)) continue;
    const Touch t = touch(world, std::min(whole, e), x(std::min(whole, e)), std::max(whole, e), x(std::max(whole, e)));
    if (t.gap < 0) return merge(std::min(whole, e), std::max(whole, e), t);
  }
  predict(whole);
}

/// Of a body, or of all that it is made of, at x (m).
double ExactSimulator::potential_of(Entity i, const Vec3& x) const {
  if (parts_[i].empty()) return potential(*given_, i, x);
  double sum = 0;
  for (Entity part : parts_[i]) sum += potential(*given_, part, x);
  return sum;
}

}  // namespace carom
