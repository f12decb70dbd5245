#pragma once
// The effect of impacts on velocities, of two bodies, and of a body and a fixed thing.
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "simulate/impact/impact_parts.h"
#include "simulate/impact/impact_rules.h"
#include "std.h"

namespace carom {

class ExactImpacts {
 public:
  ExactImpacts(ExactBodies& bodies, const ImpactParts& parts, ImpactRules& rules)
      : bodies_(bodies),
        parts_(parts),
        rules_(rules),
        otherwise_(bodies.options.merge || bodies.contact_work.impulses.any()) {}

  /// Bodies a < b meet at the present instant, at this feature.
  void collide_pair(Entity a, Entity b, uint8_t feature);
  /// Body i meets a fixed thing at the present instant.
  void collide_fixed(Entity i, Entity surface, uint8_t feature);

 private:
  template <bool summed>
  [[gnu::always_inline]] void resolve(const PairImpact& impact);
  void bounce_off(const PairImpact& impact, Entity striker, Entity struck);
  [[gnu::noinline]] void book_push(const FixedImpact& impact, double change) const;
  void apply_pair(const PairImpact& impact, double impulse, bool ends);

  ExactBodies& bodies_;
  const ImpactParts parts_;
  ImpactRules& rules_;
  const bool otherwise_;  // bodies merge, or impulses are summed
};

}  // namespace carom
