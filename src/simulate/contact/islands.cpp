// The set of islands: a pool of places and, for each body, the number of its island.
// A union moves the members of the smaller island, so that a body moves rarely. A union-find structure could not split
// islands again.
#include "simulate/contact/islands.h"

#include "std.h"

namespace carom {

uint32_t Islands::take_place() {
  ++count_;
  if (vacant_.empty()) {
    islands_.emplace_back();
    return uint32_t(islands_.size() - 1);
  }
  const uint32_t place = vacant_.back();
  vacant_.pop_back();
  return place;
}

void Islands::vacate(uint32_t place) {
  islands_[place] = {};
  vacant_.push_back(place);
  --count_;
}

void Islands::create(Entity i, const Instant& end) {
  const uint32_t place = take_place();
  islands_[place].members.push_back(i);
  islands_[place].end = end;
  island_.write(i) = place;
}

void Islands::merge(Entity a, Entity b, const Instant& end) {
  uint32_t into = island_[a];
  uint32_t from = island_[b];
  if (into == from) return;
  if (islands_[into].members.size() < islands_[from].members.size()) std::swap(into, from);

  Island& one = islands_[into];
  Island& other = islands_[from];
  for (const Entity i : other.members) island_.write(i) = into;
  one.members.insert(one.members.end(), other.members.begin(), other.members.end());

  // The next step, and changes of contact.
  one.end = end;
  one.busy = one.busy || other.busy;
  one.planned = {never, 0};
  one.next_length = min(one.next_length, other.next_length);
  one.changes = max(one.changes, other.changes);
  one.calm = 0;
  one.calm_needed = max(one.calm_needed, other.calm_needed);

  // Crowds, and what is near them.
  one.crowds.insert(one.crowds.end(), other.crowds.begin(), other.crowds.end());
  one.watched.insert(one.watched.end(), other.watched.begin(), other.watched.end());

  vacate(from);
}

void Islands::retain(Entity member, vector<Entity> stay) {
  const uint32_t place = island_[member];
  for (const Entity i : islands_[place].members) island_.write(i) = none;
  for (const Entity i : stay) island_.write(i) = place;
  islands_[place].members = std::move(stay);
  if (islands_[place].members.empty()) vacate(place);
}

vector<Entity> Islands::split(Entity i, span<const uint32_t> labels) {
  const uint32_t whole = island_[i];
  const vector<Entity> members = exchange(islands_[whole].members, {});
  vector<uint32_t> place(members.size());  // by label
  vector<Entity> first;

  for (size_t k = 0; k < members.size(); ++k) {
    // The first member of a part makes its island. The first part keeps the old one.
    if (labels[k] == k) {
      place[k] = first.empty() ? whole : take_place();
      if (!first.empty()) {
        islands_[place[k]] = islands_[whole];
        islands_[place[k]].members.clear();
      }
      first.push_back(members[k]);
    }

    islands_[place[labels[k]]].members.push_back(members[k]);
    island_.write(members[k]) = place[labels[k]];
  }
  return first;
}

}  // namespace carom
