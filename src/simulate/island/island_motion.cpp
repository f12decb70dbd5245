// An island moves by constrained motion, unless its contacts change too often for that.
#include "simulate/island/island_motion.h"

#include "simulate/path/path_log.h"

namespace carom {

void IslandMotion::advance(Entity i) {
  Island& island = bodies_.islands.of(i);
  bodies_.contact_work.end_paths(island.members, bodies_.now);
  for (const Entity k : island.members) paths_.note_change(k);

  if (bodies_.any_taut(island.members)) island.busy = false;
  if (!island.busy && island.crowds.empty() && constrained_.advance(i)) return;
  // It has united with an island that has taut strings, or it has been calm.
  if (!crowds_.advance(i)) return advance(i);
  if (!is_member(bodies_.mode(i))) return;
  for (const Entity k : bodies_.islands.of(i).members) paths_.note_change(k);
}

void IslandMotion::interrupt(Entity i) {
  for (const Entity k : bodies_.islands.of(i).members) paths_.note_change(k);
  crowds_.interrupt(i);
}

void IslandMotion::book_last(double time) const {
  bodies_.islands.for_each([&](const Island& island) { crowds_.book_last(island, time); });
}

}  // namespace carom
