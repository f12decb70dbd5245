#pragma once
// The engines of the format: their names, which one `auto` stands for, and what each of them lacks. How they are made:
// run/engine.h.
#include <string>
#include <string_view>
#include <vector>

#include "scene/simulate_settings.h"

namespace carom {

struct Force;
struct World;

// In the order of Engine and Integrator.
inline constexpr std::string_view engine_names = "auto|exact|stepped|book";
inline constexpr std::string_view integrator_names = "euler|verlet|rk4|dop853";
std::string_view name_of(Engine engine);          // as in scene files
std::string_view name_of(Integrator integrator);  // as in scene files

/// The engine that `simulate` names; for `auto` exact where every path of the world has a closed form, else stepped.
Engine engine_of(const World& world, const Simulate& simulate);

/// What an engine lacks.
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
