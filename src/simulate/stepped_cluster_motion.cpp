#include "simulate/stepped_cluster_motion.h"

#include <algorithm>

#include "physics/integrator.h"
#include "physics/touch.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

namespace {

/// How a contact's two things lie to each other at the end of the motion.
Touch touch_at_end(const World& world, const ClusterContact& c, const ClusterState& s) {
  const Vec3 xb = c.of_b != ContactConstraint::fixed ? s.end_x[c.of_b] : world.fixed_position(c.b);
  return touch(world, c.a, s.end_x[c.of_a], c.b, xb, c.feature);
}

/// m/s, at which a contact opens at the end of the motion.
double opening_at_end(const ClusterContact& c, const Vec3& normal, const ClusterState& s) {
  return normal.dot((c.of_b != ContactConstraint::fixed ? s.end_v[c.of_b] : Vec3(Vec3::Zero())) - s.end_v[c.of_a]);
}

}  // namespace

ClusterState ClusterMotion::start(const Cluster& cluster) const {
  ClusterState s;
  for (const Entity i : cluster.bodies) {
    s.inverse_mass.push_back(1 / world_.mass[i]);
    s.x.push_back(paths_.x[i]);
    s.v.push_back(paths_.v[i]);
  }
  return s;
}

Certificate ClusterMotion::accelerate(const Cluster& cluster, const ClusterState& state, const std::vector<Vec3>& x,
                                      const std::vector<Vec3>& v, std::vector<Vec3>& a,
                                      std::vector<ContactConstraint>& pairs) const {
  const std::size_t n = cluster.bodies.size();
  for (std::size_t k = 0; k < n; ++k) a[k] = free_.acceleration(cluster.bodies[k], x[k], v[k]);
  pairs.clear();
  for (const ClusterContact& c : cluster.contacts) {
    if (!c.active) continue;
    const bool body = c.of_b != ContactConstraint::fixed;
    const Vec3 xb = body ? x[c.of_b] : world_.fixed_position(c.b), vb = body ? v[c.of_b] : Vec3(Vec3::Zero());
    const Touch there = touch(world_, c.a, x[c.of_a], c.b, xb, c.feature);
    const double bend =
        is_flat(world_, c.a, c.b, c.feature) ? 0 : bending(world_, c.a, x[c.of_a], c.b, xb, there, vb - v[c.of_a]);
    pairs.push_back({c.of_a, c.of_b, there.normal, -bend, 0, 0, true});
  }
  return solve({state.inverse_mass, a, pairs});
}

void ClusterMotion::carry(const Cluster& cluster, double length, ClusterState& s) const {
  s.end_x = s.x;
  s.end_v = s.v;
  s.path.resize(s.x.size());
  std::vector<ContactConstraint> pairs;
  take_step(
      free_.integrator(), length, s.x, s.v,
      [&](const std::vector<Vec3>& x, const std::vector<Vec3>& v, std::vector<Vec3>& a) {
        s.certificate.merge(accelerate(cluster, s, x, v, a, pairs));
      },
      s.end_x, s.end_v, s.path);
  project(cluster, s);
}

/// Sets bodies in active contact on each other's surfaces and takes what speed they have into or off them. Of the
/// inactive contacts those that the motion has closed are opened.
void ClusterMotion::project(const Cluster& cluster, ClusterState& s) const {
  std::vector<ContactConstraint> pairs;
  std::vector<std::uint8_t> closed(cluster.contacts.size());
  const auto find_pairs = [&](bool of_velocities) {
    pairs.clear();
    for (std::size_t k = 0; k < cluster.contacts.size(); ++k) {
      const ClusterContact& c = cluster.contacts[k];
      if (of_velocities && !c.active && !closed[k]) continue;
      const Touch there = touch_at_end(world_, c, s);
      if (!c.active) {
        closed[k] = closed[k] || there.gap < 0;
        if (!closed[k] || (of_velocities && opening_at_end(c, there.normal, s) >= 0)) continue;
      }
      pairs.push_back({c.of_a, c.of_b, there.normal, of_velocities ? 0 : -there.gap, 0, 0, true});
    }
  };
  for (int pass = 0; pass < projections; ++pass) {  // Newton's method
    find_pairs(false);
    std::vector<Vec3> displacement(s.end_x.size(), Vec3::Zero());
    s.certificate.merge(solve({s.inverse_mass, displacement, pairs}));
    for (std::size_t k = 0; k < displacement.size(); ++k) s.end_x[k] += displacement[k];
  }
  find_pairs(true);
  s.certificate.merge(solve({s.inverse_mass, s.end_v, pairs}));
}

void ClusterMotion::carry_and_activate(Cluster& cluster, double length, ClusterState& s) const {
  carry(cluster, length, s);
  if (std::any_of(cluster.contacts.begin(), cluster.contacts.end(), [](const ClusterContact& c) { return !c.active; }))
    activate(cluster, length, s);
}

/// Of the inactive contacts: makes those active that the path closes and that press at its end.
void ClusterMotion::activate(Cluster& cluster, double length, ClusterState& s) const {
  std::vector<ClusterContact*> activated;
  for (ClusterContact& c : cluster.contacts) {
    if (c.active) continue;
    const Vec3 xb = c.of_b != ContactConstraint::fixed ? s.path[c.of_b].position(length) : world_.fixed_position(c.b);
    const double gap = touch(world_, c.a, s.path[c.of_a].position(length), c.b, xb, c.feature).gap;
    if (gap >= -penetration * world_.radius[c.a]) continue;
    c.active = true;
    activated.push_back(&c);
  }
  if (activated.empty()) return;
  carry(cluster, length, s);
  std::vector<ContactConstraint> pairs;
  std::vector<Vec3> a(s.x.size());
  s.certificate.merge(accelerate(cluster, s, s.end_x, s.end_v, a, pairs));
  std::size_t k = 0;
  bool some_pull = false;
  for (ClusterContact& c : cluster.contacts) {
    if (!c.active) continue;
    const bool pulls = pairs[k++].force < 0;
    if (!pulls || std::find(activated.begin(), activated.end(), &c) == activated.end()) continue;
    c.active = false;
    some_pull = true;
  }
  if (some_pull) carry(cluster, length, s);
}

}  // namespace carom
