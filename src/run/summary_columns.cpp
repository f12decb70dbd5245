// One row for each column, with the member of Summary that it shows. The file, comparisons and measures read this table
// instead of lists of their own.
#include "run/summary_columns.h"

#include <algorithm>

#include "std.h"

namespace carom {
namespace {

template <auto Member>
double number_of(const Summary& summary) {
  return static_cast<double>(summary.*Member);
}

template <auto Member>
double energy_of(const Summary& summary) {
  return summary.energy.*Member;
}

constexpr array<SummaryColumn, 26> columns = {{
    {"run", "the run's name"},
    {"title", "the scene's title"},
    {"engine", "the simulator: exact, stepped or book"},
    {"status",
     "done; doubtful: figures may be wrong, see the warnings in manifest.json; failed: only the parameters are known"},
    {"duration_s", "simulated time", number_of<&Summary::duration>},
    {"bodies", "movable bodies", number_of<&Summary::bodies>},
    {"collisions", "all collisions, strings that go taut included", number_of<&Summary::collisions>},
    {"body_body", "collisions between two bodies", number_of<&Summary::body_body>},
    {"body_fixed", "collisions with planes, walls and obstacles", number_of<&Summary::body_fixed>},
    {"first_collision_s", "time of the first collision", number_of<&Summary::first_collision>},
    {"last_collision_s", "time of the last collision", number_of<&Summary::last_collision>},
    {"energy_start_J", "kinetic and potential energy at the start", energy_of<&EnergyTotals::start>},
    {"energy_end_J", "kinetic and potential energy at the end", energy_of<&EnergyTotals::end>},
    {"energy_lost_J", "energy lost in impacts, those absorbed by contact included; below 0: gained",
     energy_of<&EnergyTotals::lost>},
    {"work_J", "work of forces without a potential", energy_of<&EnergyTotals::work>},
    {"energy_residual_J", "energy that neither work nor impacts account for: error of the method, and rounding",
     energy_of<&EnergyTotals::residual>},
    {"momentum_drift_kg_m_per_s", "change of total momentum, that by gravity and surfaces included",
     number_of<&Summary::momentum_drift>},
    {"max_overlap_m", "deepest overlap found", number_of<&Summary::max_overlap>},
    {"max_speed_m_per_s", "greatest speed of a body", number_of<&Summary::max_speed>},
    {"resting", "bodies in lasting contact at the end", number_of<&Summary::resting>},
    {"frames", "pictures drawn", number_of<&Summary::frames>},
    {"stepped_contact_s", "lasting contact computed in steps of crowds, summed over bodies; 0: all contact is exact",
     number_of<&Summary::stepped_contact>},
    {"removed_J", "kinetic and potential energy of bodies that regions have removed",
     energy_of<&EnergyTotals::removed>},
    {"ended_by", "what ended the run: duration, rest, collisions or a region"},
    {"energy_absorbed_J", "the part of energy_lost_J that lasting contact absorbed, without rows in collisions.csv",
     [](const Summary& summary) { return summary.contact.taken_up.energy; }},
    {"contact_made_J", "the part of energy_residual_J that errors of stepped contact have made",
     [](const Summary& summary) { return summary.contact.made; }},
}};

}  // namespace

span<const SummaryColumn> summary_columns() {
  return columns;
}

const SummaryColumn* find_summary_column(string_view name) {
  const auto found = std::ranges::find_if(columns, [&](const SummaryColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

}  // namespace carom
