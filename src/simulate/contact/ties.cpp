// The lists of strings by body. They are made only where a world has strings.
#include "simulate/contact/ties.h"

#include "std.h"

namespace carom {

Ties::Ties(const World& world) : world_(world), any_(!world.strings.empty()) {
  if (!any_) return;
  of_.resize(world.body_count());
  for (size_t k = 0; k < world.strings.size(); ++k) {
    of_[world.strings[k].body].push_back(world.string_number(k));
    if (world.strings[k].other != no_entity) of_[world.strings[k].other].push_back(world.string_number(k));
  }
}

Entity Ties::other(Entity string, Entity i) const {
  const String& s = world_.string(string);
  return s.body == i ? s.other : s.body;
}

double Ties::next_cut(Entity i, double time) const {
  double next = infinity;
  for (const Entity string : of(i))
    if (const double until = world_.string(string).until; until > time) next = min(next, until);
  return next;
}

void Ties::cut(Entity string) {
  const String& s = world_.string(string);
  std::erase(of_[s.body], string);
  if (s.other != no_entity) std::erase(of_[s.other], string);
}

void Ties::untie(Entity i) {
  for (const Entity string : of(i))
    if (const Entity k = other(string, i); k != no_entity) std::erase(of_[k], string);
  if (any()) of_[i].clear();
}

}  // namespace carom
