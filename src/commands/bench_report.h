#pragma once
// A bench's result as text with a table, and as JSON.
#include <nlohmann/json.hpp>

#include "bench/bench.h"
#include "commands/report.h"

namespace carom {

void describe(Block& block, const PlannedScene& planned, const BenchResult& result);
/// Members named as bench.csv's columns are.
nlohmann::ordered_json bench_json(const BenchResult& result);

}  // namespace carom
