#pragma once
// The engines of the format: their names, the choice of `auto`, and what each engine lacks.
// Their construction is in run/engine.h.
#include <string>
#include <string_view>
#include <vector>

#include "scene/simulate_settings.h"

namespace carom {

struct Force;
struct World;

// In the order of Engine and Integrator.
inline constexpr std::string_view engine_names = "auto|exact|stepped|book";
inline constexpr std::string_view quality_names = "preview|fast|normal|fine|finer|reference";
inline constexpr std::string_view integrator_names = "dop853|euler|verlet|rk4";
std::string_view name_of(Engine engine);  // as in scene files
std::string_view name_of(QualityLevel level);
std::string_view name_of(Integrator integrator);  // as in scene files

/// The engine of `simulate`. `auto` is exact where every path of the world has a closed form, else stepped.
Engine engine_of(const World& world, const Simulate& simulate);

/// Something that an engine lacks.
struct Unsupported {
  /// The key that requests it: a key of the scene or of `simulate`.
  std::string at;
  std::string what;     // "`engine: book` has no obstacles"
  std::string instead;  // "expected `engine: exact`"
};

/// Whether this engine moves bodies along parabolas from impact to impact in this world.
/// `contact: merge` and `output.flights` require that.
bool goes_along_parabolas(const World& world, const Simulate& simulate);

/// The description of a force without a closed form, alone or with others: "a softened `attractor`".
std::string open_force_text(const Force& force);

/// What the engine of `simulate` lacks for this world and these settings. Empty: it can run them.
std::vector<Unsupported> unsupported(const World& world, const Simulate& simulate);

}  // namespace carom
