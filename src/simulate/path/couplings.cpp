// Lists of springs by body and of bodies by gravitation. They change where bodies merge or leave the world.
#include "simulate/path/couplings.h"

#include <numeric>

#include "std.h"

namespace carom {

Couplings::Couplings(const World& world) : world_(world), any_(has_couplings(world)) {
  if (!any_) return;
  springs_of_.resize(world.body_count());
  for (uint32_t s = 0; s < world.springs.size(); ++s) {
    const BodySpring& spring = world.springs[s];
    ends_.emplace_back(spring.a, spring.b);
    springs_of_[spring.a].push_back(s);
    springs_of_[spring.b].push_back(s);
  }

  for (const Gravitation& law : world.gravitations) {
    vector<Entity>& all = attracting_.emplace_back(law.on);
    if (all.empty()) {
      all.resize(world.body_count());
      std::iota(all.begin(), all.end(), Entity{0});
    }
    vector<double>& masses = masses_.emplace_back(world.body_count(), 0);
    for (const Entity i : all) masses[i] = world.mass[i];
  }
}

bool Couplings::act_on(Entity i, double time) const {
  bool acts = false;
  for_each_link(i, time, [&](Entity) { acts = true; });
  return acts;
}

double Couplings::next_switch(Entity i, double time) const {
  double next = infinity;
  if (!any_) return next;
  const auto take = [&](const auto& law) {
    for (const double t : {law.from, law.until})
      if (t > time) next = min(next, t);
  };
  for (const uint32_t s : springs_of_[i]) take(world_.springs[s]);
  for (size_t g = 0; g < attracting_.size(); ++g)
    if (masses_[g][i] != 0) take(world_.gravitations[g]);
  return next;
}

void Couplings::join(Entity whole, Entity part) {
  if (!any_) return;
  for (const uint32_t s : exchange(springs_of_[part], {})) {
    const Entity other = other_end(s, part);
    if (other == whole) {
      std::erase(springs_of_[whole], s);
      continue;
    }
    (ends_[s].first == part ? ends_[s].first : ends_[s].second) = whole;
    springs_of_[whole].insert(std::upper_bound(springs_of_[whole].begin(), springs_of_[whole].end(), s), s);
  }

  for (size_t g = 0; g < attracting_.size(); ++g) {
    const double mass = exchange(masses_[g][part], 0);
    if (mass == 0) continue;
    vector<Entity>& all = attracting_[g];
    std::erase(all, part);
    if (masses_[g][whole] == 0) all.insert(std::upper_bound(all.begin(), all.end(), whole), whole);
    masses_[g][whole] += mass;
  }
}

void Couplings::remove(Entity i) {
  if (!any_) return;
  for (const uint32_t s : exchange(springs_of_[i], {})) std::erase(springs_of_[other_end(s, i)], s);
  for (size_t g = 0; g < attracting_.size(); ++g)
    if (exchange(masses_[g][i], 0) != 0) std::erase(attracting_[g], i);
}

}  // namespace carom
