#pragma once
// Clusters: bodies in lasting contact with one another or with fixed things, which take their steps together.
#include <cstdint>
#include <vector>

#include "physics/world.h"

namespace carom {

/// Two things in lasting contact.
struct ClusterContact {
  Entity a, b;
  std::uint8_t feature;              // as in Touch
  bool active;                       // the two are held to each other; else they only must not come nearer
  double force;                      // N, when the path began
  std::uint32_t of_a = 0, of_b = 0;  // places among the cluster's bodies; of_b ContactConstraint::fixed: fixed
};

struct Cluster {
  std::vector<Entity> bodies;  // ascending; empty: not in use
  std::vector<ClusterContact> contacts;
  bool asleep = false;
  bool woken = false;  // struck, and too large to wake before the step's end

  bool in_use() const { return !bodies.empty(); }
  bool moves() const { return in_use() && !asleep; }
  /// Of a body, among `bodies`; ContactConstraint::fixed: it is not of them.
  std::uint32_t place_of(Entity e) const;
  /// Puts bodies in order, and sets the contacts' places among them.
  void order_bodies();
};

class Clusters {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  explicit Clusters(std::size_t bodies) : of_(bodies, none) {}

  std::uint32_t size() const { return static_cast<std::uint32_t>(clusters_.size()); }
  Cluster& operator[](std::uint32_t c) { return clusters_[c]; }
  const Cluster& operator[](std::uint32_t c) const { return clusters_[c]; }

  std::uint32_t of(Entity i) const { return of_[i]; }    // a body's cluster, or none
  bool holds(Entity i) const { return of_[i] != none; }  // whether a body has a cluster
  bool asleep(Entity i) const { return holds(i) && clusters_[of_[i]].asleep; }
  bool any_asleep() const;
  /// Whether a, a body, and b are in contact in a cluster.
  bool in_contact(Entity a, Entity b) const;

  /// Makes an empty cluster. It is in use once it has a body.
  std::uint32_t create();
  void add(std::uint32_t c, Entity i);
  /// Takes a cluster apart.
  void remove(std::uint32_t c);

 private:
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> unused_;  // clusters
  std::vector<std::uint32_t> of_;      // by body
};

}  // namespace carom
