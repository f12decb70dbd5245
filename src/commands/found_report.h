#pragma once
// What a comparison has found, as text or as JSON.

#include <nlohmann/json.hpp>

#include "commands/report.h"
#include "compare/stored_findings.h"
#include "std.h"

namespace carom {

/// At most five lines: of each measure that differs the runs with the highest and the lowest value, and the parameter
/// that matters most.
void describe(Block& block, const vector<FoundMeasure>& found);
/// The run with the highest value of the measure, or that no run has one.
void describe_best(Block& block, const vector<FoundMeasure>& found, string_view measure);

/// That run. Null: no run has a value.
nlohmann::ordered_json best_json(const vector<FoundMeasure>& found, string_view measure);
nlohmann::ordered_json found_json(const vector<FoundMeasure>& found);

}  // namespace carom
