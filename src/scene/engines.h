#pragma once
// The engines of the format: their names, the choice of `auto`, and what each engine lacks.
// Their construction is in engine/engine.h.

#include "scene/simulate_settings.h"
#include "std.h"

namespace carom {

struct Force;
struct World;

// In the order of Engine and Integrator.
inline constexpr string_view engine_names = "auto|exact|stepped|book";
inline constexpr string_view quality_names = "preview|fast|normal|fine|finer|reference";
inline constexpr string_view integrator_names = "dop853|euler|verlet|rk4";
string_view name_of(Engine engine);  // as in scene files
string_view name_of(QualityLevel level);
string_view name_of(Integrator integrator);  // as in scene files

/// The engine of `simulate`. `auto` is exact where every path of the world has a closed form, else stepped.
Engine engine_of(const World& world, const Simulate& simulate);

/// Something that an engine lacks.
struct Unsupported {
  /// The key that requests it: a key of the scene or of `simulate`.
  string at;
  string what;     // "`engine: book` has no obstacles"
  string instead;  // "expected `engine: exact`"
};

/// Whether this engine moves bodies along parabolas from impact to impact in this world.
/// `contact: merge` and `output.flights` require that.
bool goes_along_parabolas(const World& world, const Simulate& simulate);

/// The description of a force without a closed form, alone or with others: "a softened `attractor`".
string open_force_text(const Force& force);

/// What the engine of `simulate` lacks for this world and these settings. Empty: it can run them.
vector<Unsupported> unsupported(const World& world, const Simulate& simulate);

}  // namespace carom
