// Follows chains of merged bodies to the joint body that holds them all, which may have left the world.
#include "physics/state.h"

namespace carom {

void State::join_parts() {
  for (Entity i = 0; i < part_of.size(); ++i) {
    if (part_of[i] == i) continue;
    mass[i] = 0;
    Entity whole = i;
    while (part_of[whole] != no_entity && part_of[whole] != whole) whole = part_of[whole];
    part_of[i] = part_of[whole];
    position[i] = position[whole];
    velocity[i] = velocity[whole];
  }
}

}  // namespace carom
