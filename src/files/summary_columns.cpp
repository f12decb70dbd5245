// One row for each column, with the member of Summary that it shows. The file, --json, comparisons and measures read
// this table instead of lists of their own.
#include "files/summary_columns.h"

#include "std.h"

namespace carom {
namespace {

/// The member at the end of the path.
template <auto... Path>
std::variant<string_view, uint64_t, double> at(const Summary& summary) {
  return (summary.*....*Path);
}

constexpr array<SummaryColumn, 27> columns = {{
    {"run", "the run's name", at<&Summary::run>},
    {"title", "the scene's title", at<&Summary::title>},
    {"engine", "the simulator: exact, stepped or book", at<&Summary::engine>},
    {"status",
     "done; doubtful: figures may be wrong, see the warnings in manifest.json; failed: only the parameters are known",
     at<&Summary::status>},
    {"duration_s", "simulated time", at<&Summary::duration>},
    {"bodies", "movable bodies", at<&Summary::bodies>},
    {"collisions", "all collisions, strings that go taut included", at<&Summary::collisions>},
    {"body_body", "collisions between two bodies", at<&Summary::body_body>},
    {"body_fixed", "collisions with planes, walls and obstacles", at<&Summary::body_fixed>},
    {"first_collision_s", "time of the first collision", at<&Summary::first_collision>},
    {"last_collision_s", "time of the last collision", at<&Summary::last_collision>},
    {"energy_start_J", "kinetic and potential energy at the start", at<&Summary::energy, &EnergyTotals::start>},
    {"energy_end_J", "kinetic and potential energy at the end", at<&Summary::energy, &EnergyTotals::end>},
    {"energy_lost_J", "energy lost in impacts, those absorbed by contact included; below 0: gained",
     at<&Summary::energy, &EnergyTotals::lost>},
    {"work_J", "work of forces without a potential", at<&Summary::energy, &EnergyTotals::work>},
    {"energy_residual_J", "energy that neither work nor impacts account for: error of the method, and rounding",
     at<&Summary::energy, &EnergyTotals::residual>},
    {"momentum_drift_kg_m_per_s", "change of total momentum, that by gravity and surfaces included",
     at<&Summary::momentum_drift>},
    {"max_overlap_m", "deepest overlap found", at<&Summary::max_overlap>},
    {"max_speed_m_per_s", "greatest speed of a body", at<&Summary::max_speed>},
    {"resting", "bodies in lasting contact at the end", at<&Summary::resting>},
    {"frames", "pictures drawn", at<&Summary::frames>},
    {"stepped_contact_s", "lasting contact computed in steps of crowds, summed over bodies; 0: all contact is exact",
     at<&Summary::stepped_contact>},
    {"removed_J", "kinetic and potential energy of bodies that regions have removed",
     at<&Summary::energy, &EnergyTotals::removed>},
    {"ended_by", "what ended the run: duration, rest, collisions or a region", at<&Summary::ended_by>},
    {"energy_absorbed_J", "the part of energy_lost_J that lasting contact absorbed, without rows in collisions.csv",
     at<&Summary::contact, &ContactCounts::taken_up, &TakenUp::energy>},
    {"contact_made_J", "the part of energy_residual_J that errors of stepped contact have made",
     at<&Summary::contact, &ContactCounts::made>},
    {"appeared_J", "kinetic and potential energy of bodies that have come into the world after the start",
     at<&Summary::energy, &EnergyTotals::appeared>},
}};

// A longer suffix comes before a shorter one that it ends in.
constexpr array<UnitSuffix, 7> units = {{{"_kg_m_per_s", "kg m/s"},
                                         {"_m_per_s", "m/s"},
                                         {"_N_s", "N s"},
                                         {"_J", "J"},
                                         {"_N", "N"},
                                         {"_m", "m"},
                                         {"_s", "s"}}};

}  // namespace

const UnitSuffix* unit_suffix(string_view column) {
  const auto found = ranges::find_if(units, [&](const UnitSuffix& u) { return column.ends_with(u.suffix); });
  return found == units.end() ? nullptr : &*found;
}

double SummaryColumn::number(const Summary& summary) const {
  const auto given = value(summary);
  const auto* count = std::get_if<uint64_t>(&given);
  return count != nullptr ? double(*count) : std::get<double>(given);
}

span<const SummaryColumn> summary_columns() {
  return columns;
}

const SummaryColumn* find_summary_column(string_view name) {
  const auto found = ranges::find_if(columns, [&](const SummaryColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

}  // namespace carom
