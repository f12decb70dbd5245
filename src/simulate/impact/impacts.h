#pragma once
// All parts that resolve impacts: their rules, impacts of two, and all of one instant.
#include "simulate/impact/exact_impacts.h"
#include "simulate/impact/impact_rules.h"
#include "simulate/impact/instant_impacts.h"

namespace carom {

struct Impacts {
  Impacts(ExactBodies& bodies, const ImpactParts& parts)
      : rules(bodies, parts.collapses, parts.group, parts.flat),
        of_two(bodies, parts, rules),
        at_once(bodies, parts, rules) {}
  Impacts(const Impacts&) = delete;
  Impacts& operator=(const Impacts&) = delete;

  ImpactRules rules;
  ExactImpacts of_two;
  InstantImpacts at_once;
};

}  // namespace carom
