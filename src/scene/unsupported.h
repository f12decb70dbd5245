#pragma once
// What each engine does not have.
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

struct Unsupported {
  std::string at;       // the key that asks for it: the scene's, or one of `simulate`
  std::string what;     // "`engine: book` has no obstacles"
  std::string instead;  // "expected `engine: exact`"
};

/// Whether this engine goes along parabolas from impact to impact in this world: `contact: merge` and `output.flights`
/// need that.
bool goes_along_parabolas(const World& world, const Simulate& simulate);

/// What a force is that has no closed form, alone or with others: "a softened `attractor`".
std::string open_force_text(const Force& force);

/// What the engine that `simulate` names cannot do of what the world and `simulate` ask for; empty: it runs.
std::vector<Unsupported> unsupported(const World& world, const Simulate& simulate);

}  // namespace carom
