#include "simulate/exact_simulator.h"

namespace carom {

/// A new region around where the body is now. One that leaves region after region on one and the same flight tries a
/// wider one: in company that flies along, it costs no more.
void ExactSimulator::rebuild_region(Entity i) {
  Stay& stay = stay_[i];
  stay.left = stay.version == version_[i] ? stay.left + 1 : 0;
  stay.version = version_[i];
  if (neighbours_.renew(i, flight_[i].position(now_ - flight_[i].start), stay.left >= 8)) stay.left = 4;
}

}  // namespace carom
