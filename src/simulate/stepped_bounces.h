#pragma once
// Where bouncing ends and contact begins in a step, and how often each body has collided in it.
#include <cstdint>
#include <vector>

#include "physics/world.h"
#include "simulate/stepped.h"
#include "simulate/tolerances.h"

namespace carom {

class BounceLimits {
 public:
  /// loaded: there is gravity, or a force.
  BounceLimits(const World& world, const SteppedOptions& options, bool loaded);

  /// Counts an impact of two with restitution e in this step.
  void count_impact(Entity a, Entity b, double e);
  /// Counts a contact of whatever kind.
  void count_contact(Entity a) { contacts_[a] += loaded_; }
  /// Forgets a body's counts.
  void begin_step(Entity i) {
    impacts_[i] = 0;
    contacts_[i] = 0;
  }

  /// Whether bounces shorter than the shortest one begin, with this approach (m/s); press (m/s^2) drives the two
  /// together.
  bool slow(double e, double approach, double press) const;
  /// Whether an impact that was counted ends in contact. noise: m/s, an approach that is rounding.
  bool ends_in_contact(Entity a, Entity b, double e, double approach, double press, double noise) const;
  /// Whether body a has met so many that it waits for the next step.
  bool jammed(Entity a) const;
  /// Whether body i has collided so often that it joins the contact group.
  bool joins_group(Entity i) const { return loaded_ && impacts_[i] >= stepped_tolerance::group_impacts; }

 private:
  const World& world_;
  const bool loaded_;
  const double rest_speed_;              // m/s
  double shortest_bounce_;               // s
  std::vector<std::uint32_t> impacts_;   // by body, in this step, with e < 1,
  std::vector<std::uint32_t> contacts_;  // and of whatever kind under load
};

}  // namespace carom
