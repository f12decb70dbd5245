// Follows chains of merged bodies to the joint body that holds them all.
#include "physics/state.h"

namespace carom {

void State::join_parts() {
  for (Entity i = 0; i < part_of.size(); ++i) {
    if (part_of[i] == i) continue;
    Entity whole = part_of[i];
    while (part_of[whole] != whole) whole = part_of[whole];
    part_of[i] = whole;
    mass[i] = 0;
    position[i] = position[whole];
    velocity[i] = velocity[whole];
  }
}

}  // namespace carom
