#include "physics/trigger.h"

namespace carom {

bool is_event(const Trigger& trigger, const Collision& collision) {
  if (trigger.regions || collision.kind == CollisionKind::rest) return false;
  const auto meet = [&](Entity one, Entity other) { return trigger.a.has(one) && trigger.b.has(other); };
  return meet(collision.a, collision.b) || meet(collision.b, collision.a);
}

bool is_event(const Trigger& trigger, const RegionCrossing& crossing) {
  return crossing.enters && trigger.regions && trigger.regions->has(crossing.region);
}

}  // namespace carom
