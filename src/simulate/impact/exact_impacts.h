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
      : bodies_(bodies), parts_(parts), rules_(rules) {}

  /// Bodies a < b meet at the present instant, at this feature.
  void collide_pair(Entity a, Entity b, uint8_t feature);
  /// Body i meets a fixed thing at the present instant.
  void collide_fixed(Entity i, Entity surface, uint8_t feature);

 private:
  void bounce_off(const PairImpact& impact, Entity striker, Entity struck);
  void apply_pair(const PairImpact& impact, double impulse, bool ends);

  ExactBodies& bodies_;
  const ImpactParts parts_;
  ImpactRules& rules_;
};

}  // namespace carom
