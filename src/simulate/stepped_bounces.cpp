#include "simulate/stepped_bounces.h"

#include <algorithm>

#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

BounceLimits::BounceLimits(const World& world, const SteppedOptions& options, bool loaded)
    : world_(world),
      loaded_(loaded),
      rest_speed_(options.rest_speed),
      shortest_bounce_(options.step),
      impacts_(world.body_count()),
      contacts_(world.body_count()) {}

void BounceLimits::count_impact(Entity a, Entity b, double e) {
  if (!(e < 1)) return;
  ++impacts_[a];
  if (world_.is_body(b)) ++impacts_[b];
}

bool BounceLimits::slow(double e, double approach, double press) const {
  return press > 0 && e < 1 && (2 * e * approach < press * shortest_bounce_ || approach <= rest_speed_);
}

bool BounceLimits::ends_in_contact(Entity a, Entity b, double e, double approach, double press, double noise) const {
  if (approach <= noise || slow(e, approach, press)) return true;
  const std::uint32_t impacts = std::max(impacts_[a], world_.is_body(b) ? impacts_[b] : 0);
  return e < 1 && impacts > many_impacts;
}

bool BounceLimits::jammed(Entity a) const {
  return contacts_[a] > most_contacts;
}

}  // namespace carom
