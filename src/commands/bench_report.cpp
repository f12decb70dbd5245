// The terminal gets rounded figures, and JSON all digits. Figures of a failed or incomparable row stay empty.
#include "commands/bench_report.h"

#include <fmt/format.h>

#include "bench/bench_folder.h"
#include "commands/error_list.h"
#include "commands/text.h"
#include "std.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

using Cells = vector<string>;

string digits(double value) {
  return value == 0 ? "0" : isfinite(value) ? fmt::format("{:.3g}", value) : "";
}

bool is_confirmed(const BenchResult& result) {
  return any_of(result.witnesses, [](const Witness& w) { return w.agrees; });
}

string reference_text(const BenchResult& result) {
  const Differences& error = result.reference_error;
  const string text = full_name_of(result.reference);
  if (!(result.horizon > 0)) return text;
  const bool disputed = !result.witnesses.empty() && !is_confirmed(result);
  const char* how = disputed ? "no other method agrees with it: its estimated error is"
                    : result.reference.is_stepped_by(Integrator::dop853) ? "rounding and smaller step errors move it by"
                    : result.reference.engine != Engine::exact           ? "doubled steps move it by"
                    : result.inexact_islands                             ? "rounding and smaller step errors move it by"
                                                                         : "rounding moves it by";
  return text +
         fmt::format("; {} {} and {} at most", how, quantity(error.position, "m"), quantity(error.velocity, "m/s"));
}

/// How the other methods agree with the reference.
string witnesses_text(const BenchResult& result) {
  if (result.witnesses.empty()) return "nothing: no other method converges, or all follow the same paths";
  vector<string> agree, differ;
  for (const Witness& witness : result.witnesses)
    (witness.agrees ? agree : differ)
        .push_back(fmt::format("{} ({})", full_name_of(witness.method), quantity(witness.apart, "m")));
  const char* where = result.inexact_islands ? "in agreement outside islands: " : "in agreement: ";
  string text = agree.empty() ? "" : where + listed(agree, agree.size());
  if (differ.empty()) return text;
  if (!text.empty()) text += "; ";
  return text + "in disagreement: " + listed(differ, differ.size());
}

string motion_text(const BenchResult& result) {
  if (!result.chaotic)
    return fmt::format("regular: rounding moves no body by more than {}", quantity(result.rounding, "m"));
  return fmt::format(
      "chaotic: rounding moves bodies by up to {}; trajectories are compared until {}, statistics with those of {} "
      "runs that differ by rounding (these deviate by up to {} as well)",
      quantity(result.rounding, "m"), quantity(result.horizon, "s"), result.members, significant_deviation);
}

Cells heading(const BenchResult& result) {
  Cells cells = {"engine",   "step s",    "CPU s",  "position m", "velocity m/s",
                 "energy J", "overlap m", "missed", "invented"};
  if (result.chaotic) cells.push_back("deviation");
  return cells;
}

Cells cells_of(const BenchRow& row, bool chaotic) {
  const StepChoice& steps = row.method.steps;
  Cells cells = {name_of(row.method), steps.length      ? digits(*steps.length)
                                      : steps.error > 0 ? "to " + steps_text(row.method)
                                                        : ""};

  if (!row.failure.empty()) {
    cells.push_back("failed");
    cells.resize(chaotic ? 10 : 9);
    return cells;
  }

  cells.push_back(digits(row.cpu_s));
  if (row.errors) {
    for (const double error : {row.errors->position, row.errors->velocity, row.errors->energy})
      cells.push_back(digits(error));
  } else {
    cells.insert(cells.end(), 3, "");
  }

  cells.push_back(digits(max(row.max_overlap, 0.0)));
  cells.push_back(row.errors ? grouped(row.errors->missed) : "");
  cells.push_back(row.errors ? grouped(row.errors->invented) : "");
  if (chaotic) cells.push_back(digits(row.deviation.value));
  return cells;
}

/// "0.21 +- 0.05" %, or nothing.
string percent_text(const MeanError& error) {
  if (!isfinite(error.value)) return "";
  return fmt::format("{:.2f} +- {:.2f}", 100 * error.value, 100 * error.spread);
}

void describe(Block& block, const QualityCurve& curve) {
  block.line("qualities", fmt::format("of lasting contact of many bodies: means of {} runs, against `{}`", curve.runs,
                                      name_of(curve.rows.back().level)));
  vector<Cells> rows = {{"quality", "CPU s", "energy lost %", "height %", "made J", "unsolved %", "overlap m"}};
  for (const QualityRow& row : curve.rows)
    rows.push_back({string(name_of(row.level)), digits(row.cpu_s), percent_text(row.dissipated),
                    percent_text(row.height), digits(row.made), digits(100 * row.unsolved), digits(row.max_overlap)});
  block.table(rows);
}

}  // namespace

void describe(Block& block, const PlannedScene& planned, const BenchResult& result) {
  block.line("reference", reference_text(result));
  if (result.horizon > 0) block.line("checked by", witnesses_text(result));
  if (result.inexact_islands)
    block.line("islands",
               "no independent check: all methods move bodies in lasting contact and on strings by the same code");
  block.line("motion", motion_text(result));

  vector<Cells> rows = {heading(result)};
  for (const BenchRow& row : result.rows) rows.push_back(cells_of(row, result.chaotic));
  block.table(rows);
  if (!result.qualities.rows.empty()) describe(block, result.qualities);

  for (const string& line : result.left_out) block.line("left out", line);
  for (const BenchRow& row : result.rows)
    if (!row.failure.empty()) block.line("failed", fmt::format("{}: {}", full_name_of(row.method), row.failure));
  block.line("wrote", fmt::format("{}: {}", printable(planned.folder), listed(files_in(planned.folder), 100)));
  block.line("time", fmt::format("{} of CPU time", wait_text(result.cpu_s)));
}

Json bench_json(const BenchResult& result) {
  Json reference = method_json(result.reference);
  reference.update(differences_json(result.reference_error));
  reference["held_against"] = witnesses_json(result.witnesses);
  reference["islands_unchecked"] = result.inexact_islands;
  Json json = {{"reference", reference},
               {"rounding_m", result.rounding},
               {"chaotic", result.chaotic},
               {"compared_until_s", result.horizon}};

  if (result.chaotic) {
    json["ensemble"] = statistics_json(result.mean);
    json["ensemble"]["runs"] = result.members;
  }
  json["rows"] = Json::array();
  for (const BenchRow& row : result.rows) {
    Json& entry = json["rows"].emplace_back(row_json(row, result.chaotic));
    if (!row.failure.empty()) entry["errors"] = errors_json(error_of_text(row.failure));
  }

  if (!result.qualities.rows.empty()) {
    json["qualities"] = Json::array();
    json["quality_runs"] = result.qualities.runs;
    for (const QualityRow& row : result.qualities.rows) json["qualities"].push_back(quality_json(row));
  }
  json["left_out"] = result.left_out;
  json["cpu_s"] = result.cpu_s;
  return json;
}

}  // namespace carom
