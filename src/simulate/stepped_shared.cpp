#include "simulate/stepped_shared.h"

namespace carom {

StepShared::StepShared(const World& of, const State& initial, const SteppedOptions& with)
    : world(of),
      options(with),
      bounds(bounds_of(of)),
      log(with.max_collisions, with.record_collisions),
      clock(of, with.duration, with.step),
      free(of, with, clock),
      bounces(of, with, free.loaded()),
      paths(of, initial),
      clusters(of.body_count()),
      awake(of.body_count()),
      group(of.body_count()) {
  for (const Vec3& v : paths.v) log.note_speed(v.norm());
}

}  // namespace carom
