#pragma once
// Takes bodies out of the world. What rested on one falls.

#include "physics/entity.h"
#include "std.h"

namespace carom {

struct ExactBodies;
class ExactGroup;
class FlatContacts;
class FlightChanges;
class ModeChanges;

class BodyRemoval {
 public:
  BodyRemoval(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlatContacts& flat, FlightChanges& flights)
      : bodies_(bodies), modes_(modes), group_(group), flat_(flat), flights_(flights) {}

  /// Removes body i at the present instant, and books its energy and momentum. It stays at its position, out of the
  /// world. Returns bodies in lasting contact, one of each island that has lost it: their forces are to be found anew.
  vector<Entity> remove(Entity i);

 private:
  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlatContacts& flat_;
  FlightChanges& flights_;
};

}  // namespace carom
