// An island moves by constrained motion, unless its contacts change too often for that.
#include "simulate/island/island_motion.h"

#include "simulate/path/path_log.h"

namespace carom {

void IslandMotion::advance(Entity i) {
  Island& island = bodies_.islands.of(i);
  bodies_.contact_work.end_paths(island.members, bodies_.now);
  for (const Entity k : island.members) paths_.note_change(k);

  if (bodies_.any_taut(island.members)) island.busy = false;
  if (!island.busy && constrained_.advance(i)) return;
  // It has united with an island that has taut strings.
  if (!stepping_.advance(i)) advance(i);
}

}  // namespace carom
