#pragma once
// What runs are compared by: a number of summary.csv, or where a body is and how it moves at the run's end.
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

/// The name of a measure means nothing. The text says what is wrong and, where a name is near, what was meant.
struct MeasureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// "energy_lost_J", "balls.red.speed_m_per_s", "groups.gas.17.x_m".
struct Measure {
  std::string name;
  const SummaryColumn* column = nullptr;  // null: of a body, and then:
  std::string kind;                       // "balls", "bodies" or "groups"
  std::string body;                       // as in trajectory.csv: "red", "gas.17"
  Quantity quantity = Quantity::x;
};

/// Reads a name by its grammar alone. Throws MeasureError.
Measure parse_measure(std::string_view name);
/// The same, and the body must be one of the scene's.
Measure parse_measure(std::string_view name, const Scene& scene);

/// Of a body at `position` (m) with `velocity` (m/s) and `mass` (kg).
double quantity_of(Quantity quantity, const Vec3& position, const Vec3& velocity, double mass);

/// At a run's end: `state` is its last, in the unit that the name ends in. Not a number: undefined, such as the first
/// collision where there is none, or where a body is that has become part of another or that the scene does not have.
double value_of(const Measure& measure, const Scene& scene, const State& state, const Summary& summary);

/// The unit that the name of a column or measure ends in: "J", "m/s"; empty: a pure number or text.
std::string_view unit_of(std::string_view column);
/// As a person reads it: "energy lost (J)", "balls.red speed (m/s)".
std::string label_of(std::string_view column);

}  // namespace carom
