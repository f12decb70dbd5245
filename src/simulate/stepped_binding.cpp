#include "simulate/stepped_binding.h"

#include <algorithm>
#include <cmath>

#include "physics/contact_problem.h"
#include "physics/disjoint_sets.h"
#include "physics/restitution.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

namespace {

bool is_met(const StepEvent* met, Entity a, Entity b) {
  return met != nullptr && met->a == a && met->b == b;
}

}  // namespace

ClusterBinding::ClusterBinding(StepShared& shared, StepMotion& motion, const Neighbours& neighbours)
    : shared_(shared), motion_(motion), neighbours_(neighbours), place_(shared.world.body_count()) {}

void ClusterBinding::bind(std::vector<Entity>& bodies, double time) {
  find_clusters(bodies, time, nullptr, false);
}

void ClusterBinding::bind_after(const StepEvent& met, bool parts, std::vector<Entity>& bodies, double time) {
  if (shared_.free.loaded() || !parts) find_clusters(bodies, time, &met, parts);
  if (!parts) return;
  for (const auto& [i, other] : {std::pair(met.a, met.b), std::pair(met.b, met.a)})
    if (shared_.world.is_body(i)) shared_.paths.origin[i] = {other, met.feature};
}

void ClusterBinding::find_clusters(std::vector<Entity>& bodies, double time, const StepEvent* met, bool parts) {
  add_touching(bodies, time);
  std::sort(bodies.begin(), bodies.end());  // lists of neighbours are in no order that results may depend on
  find_contacts(bodies, met, parts);
  if (contacts_.empty()) return;
  stop_approach(bodies);
  const auto kept = [&](std::size_t c) { return is_met(met, contacts_[c].a, contacts_[c].b); };
  const double rounding = contact_rounding * (fastest_ + strongest_ * shared_.options.step);
  keep_contacts([&](std::size_t c) { return kept(c) || opening(c, v_) <= rounding; });
  find_forces();
  keep_contacts([&](std::size_t c) {
    return kept(c) || contacts_[c].active || opening(c, a_) - pairs_[c].target <= opening_acceleration * strongest_;
  });
  if (!contacts_.empty()) make_clusters(bodies);
}

/// Whether a and b touch and neither separate nor collide, so that they may be in lasting contact.
bool ClusterBinding::touches(Entity a, const Vec3& xa, const Vec3& va, Entity b, const Vec3& xb, const Vec3& vb,
                             Touch& there) const {
  const World& world = shared_.world;
  const bool body = world.is_body(b);
  if (body && (xb - xa).cwiseAbs().maxCoeff() > far_apart * (world.radius[a] + world.radius[b])) return false;
  there = touch(world, a, xa, b, xb);
  const double rounding = position_rounding * (xa.cwiseAbs().sum() + xb.cwiseAbs().sum());
  if (there.gap > std::max(contact_gap * world.radius[a], rounding)) return false;
  const double of_a = shared_.free.acceleration(a, xa, va).norm();
  const double press = std::max(of_a, body ? shared_.free.acceleration(b, xb, vb).norm() : 0.0);
  const double approach = there.normal.dot(va - vb);
  const double noise = contact_rounding * (va.norm() + vb.norm() + press * shared_.options.step);
  if (std::abs(approach) <= noise) return true;
  if (approach < 0) return false;
  return shared_.bounces.slow(pair_restitution(world, a, b), approach, press);
}

/// Adds the bodies that touch one of the given bodies at `time`, and so on.
void ClusterBinding::add_touching(std::vector<Entity>& bodies, double time) {
  const StepPaths& paths = shared_.paths;
  place_.number(bodies);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Entity i = bodies[k];
    for (const Entity e : neighbours_.near(i)) {
      if (!shared_.world.is_body(e) || place_.in(bodies, e) || shared_.group.in_step(e) || shared_.group.joined(e))
        continue;
      const Path now = paths.from(e, time);
      Touch there;
      const bool touching = i < e ? touches(i, paths.x[i], paths.v[i], e, now.x, now.v, there)
                                  : touches(e, now.x, now.v, i, paths.x[i], paths.v[i], there);
      if (!touching) continue;
      const std::size_t first = bodies.size();
      motion_.set_free(e, time, bodies);
      place_.number(bodies, first);
    }
  }
}

/// The bodies' contacts with one another and with fixed things.
void ClusterBinding::find_contacts(const std::vector<Entity>& bodies, const StepEvent* met, bool parts) {
  const World& world = shared_.world;
  const StepPaths& paths = shared_.paths;
  place_.number(bodies);
  contacts_.clear();
  pairs_.clear();
  std::vector<std::pair<Entity, Touch>> found;  // of one body
  for (const Entity i : bodies) {
    found.clear();
    for (const Entity e : neighbours_.near(i)) {
      if (world.is_body(e) && (e < i || !place_.in(bodies, e))) continue;
      if (parts && is_met(met, i, e)) continue;
      Touch there;
      if (!touches(i, paths.x[i], paths.v[i], e, paths.position_of(e), paths.velocity_of(e), there)) {
        if (!is_met(met, i, e)) continue;
        there = touch(world, i, paths.x[i], e, paths.position_of(e), met->feature);
      }
      found.emplace_back(e, there);
    }
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [e, there] : found) {
      contacts_.push_back({i, e, there.feature, false, 0});
      pairs_.push_back({place_[i], world.is_body(e) ? place_[e] : ContactConstraint::fixed, there.normal, 0, 0, 0});
    }
  }
}

/// Changes the bodies' velocities so that no contact closes.
void ClusterBinding::stop_approach(const std::vector<Entity>& bodies) {
  StepPaths& paths = shared_.paths;
  const std::size_t n = bodies.size();
  inverse_mass_.resize(n);
  v_.resize(n);
  a_.resize(n);
  fastest_ = strongest_ = 0;
  for (std::size_t k = 0; k < n; ++k) {
    inverse_mass_[k] = 1 / shared_.world.mass[bodies[k]];
    v_[k] = paths.v[bodies[k]];
    fastest_ = std::max(fastest_, v_[k].norm());
  }
  shared_.log.note(solve({inverse_mass_, v_, pairs_}));
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = bodies[k];
    a_[k] = shared_.free.acceleration(i, paths.x[i], v_[k]);
    strongest_ = std::max(strongest_, a_[k].norm());
    if (v_[k] == paths.v[i]) continue;
    shared_.log.lose(0.5 * shared_.world.mass[i] * (paths.v[i] - v_[k]).dot(paths.v[i] + v_[k]));
    paths.v[i] = v_[k];
  }
}

/// The forces in the contacts that are left, and which of these they make active.
void ClusterBinding::find_forces() {
  const World& world = shared_.world;
  const StepPaths& paths = shared_.paths;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const ClusterContact& c = contacts_[k];
    const Vec3 xb = paths.position_of(c.b);
    const Touch there = touch(world, c.a, paths.x[c.a], c.b, xb, c.feature);
    pairs_[k].target = -bending(world, c.a, paths.x[c.a], c.b, xb, there, paths.velocity_of(c.b) - paths.v[c.a]);
  }
  shared_.log.note(solve({inverse_mass_, a_, pairs_}));
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    contacts_[k].active = pairs_[k].force > 0;
    contacts_[k].force = pairs_[k].force;
  }
}

/// m/s or m/s^2, at which contact c opens with these velocities or accelerations.
double ClusterBinding::opening(std::size_t c, const std::vector<Vec3>& u) const {
  const ContactConstraint& p = pairs_[c];
  return p.normal.dot((p.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : u[p.b]) - u[p.a]);
}

/// Keeps the contacts for which keeps(c).
template <typename Keeps>
void ClusterBinding::keep_contacts(const Keeps& keeps) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    if (!keeps(c)) continue;
    pairs_[kept] = pairs_[c];
    contacts_[kept++] = contacts_[c];
  }
  pairs_.resize(kept);
  contacts_.resize(kept);
}

/// Makes clusters of the bodies that contacts bind.
void ClusterBinding::make_clusters(const std::vector<Entity>& bodies) {
  Clusters& clusters = shared_.clusters;
  const std::size_t n = bodies.size();
  DisjointSets sets(n);
  std::vector<std::uint8_t> is_bound(n);
  for (const ContactConstraint& p : pairs_) {
    is_bound[p.a] = 1;
    if (p.b == ContactConstraint::fixed) continue;
    is_bound[p.b] = 1;
    sets.join(p.a, p.b);
  }
  std::vector<std::uint32_t> cluster_of(n, Clusters::none);  // by root
  for (std::uint32_t k = 0; k < n; ++k) {
    if (!is_bound[k]) continue;
    std::uint32_t& c = cluster_of[sets.root(k)];
    if (c == Clusters::none) {
      c = clusters.create();
      clusters[c].asleep = true;
    }
    clusters.add(c, bodies[k]);
    if (!balanced(bodies[k], a_[k])) clusters[c].asleep = false;
  }
  for (std::size_t c = 0; c < pairs_.size(); ++c)
    clusters[cluster_of[sets.root(pairs_[c].a)]].contacts.push_back(contacts_[c]);
  for (const std::uint32_t c : cluster_of)
    if (c != Clusters::none) finish(c);
}

/// Whether a body that is left this acceleration (m/s^2) is at rest.
bool ClusterBinding::balanced(Entity i, const Vec3& acceleration) const {
  const double fall = std::sqrt(strongest_ * shared_.world.radius[i]);  // m/s
  return shared_.paths.v[i].norm() <= standstill * fall && acceleration.norm() <= cluster_balance * strongest_;
}

/// A cluster that has all its bodies and contacts.
void ClusterBinding::finish(std::uint32_t c) {
  Cluster& cluster = shared_.clusters[c];
  shared_.log.add_resting(cluster.bodies.size());
  cluster.order_bodies();
  if (cluster.asleep) return fall_asleep(cluster);
  if (cluster.bodies.size() > most_cluster_bodies) hand_over(c);
}

/// A cluster of too many bodies becomes part of the contact group: they wait for the step's end.
void ClusterBinding::hand_over(std::uint32_t c) {
  std::vector<Entity> bodies;
  motion_.dissolve(c, shared_.paths.start[shared_.clusters[c].bodies.front()], bodies);
  for (const Entity i : bodies) {
    shared_.group.join(i);
    shared_.group.enter_step(i, i);
  }
}

void ClusterBinding::fall_asleep(const Cluster& cluster) {
  StepPaths& paths = shared_.paths;
  for (const Entity i : cluster.bodies) {
    shared_.log.lose(0.5 * shared_.world.mass[i] * paths.v[i].squaredNorm());
    paths.v[i].setZero();
    paths.stay(i);
  }
}

}  // namespace carom
