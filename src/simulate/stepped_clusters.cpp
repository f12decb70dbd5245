#include "simulate/stepped_clusters.h"

#include <algorithm>

#include "physics/contact_problem.h"

namespace carom {

std::uint32_t Cluster::place_of(Entity e) const {
  const auto at = std::lower_bound(bodies.begin(), bodies.end(), e);
  return at != bodies.end() && *at == e ? static_cast<std::uint32_t>(at - bodies.begin()) : ContactConstraint::fixed;
}

void Cluster::order_bodies() {
  std::sort(bodies.begin(), bodies.end());
  for (ClusterContact& contact : contacts) {
    contact.of_a = place_of(contact.a);
    contact.of_b = place_of(contact.b);
  }
}

bool Clusters::any_asleep() const {
  return std::any_of(clusters_.begin(), clusters_.end(), [](const Cluster& c) { return c.asleep && c.in_use(); });
}

bool Clusters::in_contact(Entity a, Entity b) const {
  if (!holds(a)) return false;
  const std::vector<ClusterContact>& contacts = clusters_[of_[a]].contacts;
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const ClusterContact& c) { return c.a == std::min(a, b) && c.b == std::max(a, b); });
}

std::uint32_t Clusters::create() {
  if (unused_.empty()) {
    unused_.push_back(static_cast<std::uint32_t>(clusters_.size()));
    clusters_.emplace_back();
  }
  const std::uint32_t c = unused_.back();
  unused_.pop_back();
  return c;
}

void Clusters::add(std::uint32_t c, Entity i) {
  clusters_[c].bodies.push_back(i);
  of_[i] = c;
}

void Clusters::remove(std::uint32_t c) {
  for (const Entity i : clusters_[c].bodies) of_[i] = none;
  clusters_[c] = {};
  unused_.push_back(c);
}

}  // namespace carom
