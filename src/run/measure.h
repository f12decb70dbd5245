#pragma once
// The measures by which runs are compared: a number of summary.csv, or a body's position or motion at the run's end.
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "files/summary.h"
#include "numerics/vec3.h"
#include "physics/state.h"
#include "run/summary_columns.h"

namespace carom {

struct Scene;

enum class Quantity { x, y, z, vx, vy, vz, speed, kinetic };

/// "x_m", ..., "speed_m_per_s", "kinetic_J".
std::string_view name_of(Quantity quantity);
/// A phrase: "x coordinate of the centre".
std::string_view meaning_of(Quantity quantity);

/// The name of a measure is invalid. The text describes the fault and suggests a near name, if there is one.
struct MeasureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// "energy_lost_J", "balls.red.speed_m_per_s", "groups.gas.17.x_m".
struct Measure {
  std::string name;
  /// Null: a quantity of a body, with the members below.
  const SummaryColumn* column = nullptr;
  std::string kind;  // "balls", "bodies" or "groups"
  std::string body;  // as in trajectory.csv: "red", "gas.17"
  Quantity quantity = Quantity::x;
};

/// Parses a name by its grammar alone. Throws MeasureError.
Measure parse_measure(std::string_view name);
/// The same, and the body must exist in the scene.
Measure parse_measure(std::string_view name, const Scene& scene);

/// A quantity of a body at `position` (m) with `velocity` (m/s) and `mass` (kg).
double quantity_of(Quantity quantity, const Vec3& position, const Vec3& velocity, double mass);

/// The value at a run's end, in the unit at the end of the name. `state`: the run's last state.
/// NaN: undefined. Examples are the first collision of a run without collisions, a merged body, and an unknown body.
double value_of(const Measure& measure, const Scene& scene, const State& state, const Summary& summary);

/// The unit at the end of a column's or measure's name: "J", "m/s". Empty: a pure number or text.
std::string_view unit_of(std::string_view column);
/// A readable label: "energy lost (J)", "balls.red speed (m/s)".
std::string label_of(std::string_view column);

}  // namespace carom
