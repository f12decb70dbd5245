#pragma once
// Which forces act between which bodies now. Bodies that these forces connect fly as one system: an island
// (contact/islands.h), whose members they keep together without contact.
// A body that merges passes its springs and its attraction on. A spring between two bodies that become one ends.

#include "physics/coupled_forces.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

class Couplings {
 public:
  /// `world` must outlive this object.
  explicit Couplings(const World& world);

  /// Whether there are any. Where there are none, no other function need be called.
  bool any() const { return any_; }
  // Times are doubles that have passed: just before a switch, an instant rounds to it.
  /// Whether such a force acts on body i at `time` (s).
  bool act_on(Entity i, double time) const;
  /// Calls what(other) for bodies that forces at `time` (s) connect with body i. Over such links all bodies are reached
  /// that forces connect.
  template <typename What>
  void for_each_link(Entity i, double time, What what) const {
    if (!any_) return;

    for (const uint32_t s : springs_of_[i])
      if (world_.springs[s].acts(time)) what(other_end(s, i));
    for (size_t g = 0; g < attracting_.size(); ++g) {
      const vector<Entity>& all = attracting_[g];
      if (!world_.gravitations[g].acts(time) || masses_[g][i] == 0) continue;
      if (all.front() != i) {
        what(all.front());
        continue;
      }

      for (const Entity other : all)
        if (other != i) what(other);
    }
  }
  /// The first time (s) after `time` at which such a force on body i starts or ends.
  double next_switch(Entity i, double time) const;

  /// The forces at `time` (s) among these bodies, which have all bodies that they connect. number(i): that of body i
  /// among them.
  template <typename Number>
  CoupledForces among(span<const Entity> bodies, double time, Number number) const;
  /// The potential energy (J) of those of these bodies, at position(i) (m), with each other and with all others.
  template <typename Position>
  double potential(span<const Entity> those, Position position) const;

  /// Makes body `part` a part of body `whole`.
  void join(Entity whole, Entity part);
  /// Takes body i out of the world.
  void remove(Entity i);

  void keep(auto& archive) { archive(ends_, springs_of_, attracting_, masses_); }

 private:
  Entity other_end(uint32_t s, Entity i) const { return ends_[s].first == i ? ends_[s].second : ends_[s].first; }

  const World& world_;
  const bool any_;
  vector<pair<Entity, Entity>> ends_;    // by spring
  vector<vector<uint32_t>> springs_of_;  // by body, ascending; empty: there are no couplings
  vector<vector<Entity>> attracting_;    // by gravitation: the bodies that attract, ascending
  vector<vector<double>> masses_;        // kg, by gravitation and body: by which it attracts; 0: it does not
};

template <typename Number>
CoupledForces Couplings::among(span<const Entity> bodies, double time, Number number) const {
  CoupledForces forces;
  if (!any_) return forces;
  for (const Entity i : bodies)
    for (const uint32_t s : springs_of_[i])
      if (ends_[s].first == i && world_.springs[s].acts(time))
        forces.add(world_.springs[s], number(i), number(ends_[s].second));

  for (size_t g = 0; g < attracting_.size(); ++g) {
    if (!world_.gravitations[g].acts(time)) continue;
    vector<uint32_t> of;
    vector<double> masses;
    for (const Entity i : bodies) {
      if (masses_[g][i] == 0) continue;
      of.push_back(number(i));
      masses.push_back(masses_[g][i]);
    }
    forces.add(world_.gravitations[g], std::move(of), std::move(masses));
  }
  return forces;
}

template <typename Position>
double Couplings::potential(span<const Entity> those, Position position) const {
  if (!any_) return 0;
  double sum = 0;
  for (size_t k = 0; k < those.size(); ++k) {
    const Entity i = those[k];
    const Vec3 x = position(i);
    // Each pair once.
    const auto counted = [&](Entity other) { return other == i || ranges::count(those.first(k), other) > 0; };
    for (const uint32_t s : springs_of_[i])
      if (const Entity other = other_end(s, i); !counted(other))
        sum += world_.springs[s].potential(position(other) - x);

    for (size_t g = 0; g < attracting_.size(); ++g) {
      if (masses_[g][i] == 0) continue;
      for (const Entity other : attracting_[g])
        if (!counted(other))
          sum += world_.gravitations[g].potential(masses_[g][i] * masses_[g][other], position(other) - x);
    }
  }
  return sum;
}

}  // namespace carom
