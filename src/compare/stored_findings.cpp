// The table has all that is needed, so that a comparison that is up to date is described like a new one.
#include "compare/stored_findings.h"

#include <fcntl.h>
#include <fmt/format.h>

#include "compare/scenarios.h"
#include "files/folders.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "std.h"

namespace carom {
namespace {

/// Adds each row of the table to the outcomes. Returns whether the scenes have little in common.
bool add_rows(StoredTable& table, const ComparisonPlan& plan, const vector<Measure>& measures, Outcomes& outcomes) {
  // The name of an expression has a guard in the table.
  const auto find = [&](const string& name) -> optional<size_t> {
    const vector<string>& names = table.columns();
    const auto found = ranges::find_if(names, [&](const string& column) { return without_guard(column) == name; });
    return found == names.end() ? nullopt : optional(size_t(found - names.begin()));
  };
  const auto id = table.find("run"), status = table.find("status");
  vector<optional<size_t>> parameters, columns;
  for (const Parameter& parameter : plan.parameters) parameters.push_back(find(parameter.path));
  for (const Measure& measure : measures) columns.push_back(find(measure.name));

  AbsentValues absent(plan.parameters.size());
  for (size_t number = 0; table.next() != nullptr; ++number) {
    ComparedRun run{string(table.cell(id)), {}, {}};
    for (const auto& column : parameters) run.values.push_back(without_guard(table.cell(column)));
    absent.add(run.values);

    vector<double> values;
    for (const auto& column : columns)
      values.push_back(number_in(table.cell(column)).value_or(numeric_limits<double>::quiet_NaN()));
    outcomes.add(number, run, table.cell(status) != "failed", values);
  }

  outcomes.finish();
  return absent.unrelated();
}

FoundRun found_run(size_t point, size_t equal, const MeasureFinding& finding, const Findings& findings,
                   const ComparisonPlan& plan, const Outcomes& outcomes) {
  const Spread spread = outcomes.spread(point, finding.measure);
  FoundRun run{string(outcomes.id(point)), spread.mean(), spread.count(), equal - min<size_t>(equal, 1)};
  for (const size_t p : findings.parameters) {
    const Parameter& parameter = plan.parameters[p];
    run.values.emplace_back(
        parameter.path, shown_value(outcomes.value(point, p)) + (parameter.unit.empty() ? "" : " " + parameter.unit));
  }
  return run;
}

}  // namespace

vector<FoundMeasure> stored_findings(const string& folder, const ComparisonPlan& plan, string_view always) {
  const Descriptor place = open_folder(AT_FDCWD, folder, true);
  if (!place) return {};
  Descriptor file = open_stored(place.get(), summary_name);
  if (!file) return {};
  StoredTable table(std::move(file));

  const vector<Measure> measures = measures_of(plan);
  Outcomes outcomes(plan, measures.size(), 0);
  const bool unrelated = add_rows(table, plan, measures, outcomes);
  const Findings findings = findings_of(outcomes, measures.size(), unrelated);

  vector<string> paths;
  for (const size_t p : findings.parameters) paths.push_back(plan.parameters[p].path);
  const vector<string> names = short_names(paths);

  vector<FoundMeasure> found;
  const vector<const MeasureFinding*> shown = shown_findings(findings, measures.size());
  for (const MeasureFinding& finding : findings.measures) {
    const string& name = measures[finding.measure].name;
    if (finding.points == 0 || (name != always && !contains(shown, &finding))) continue;

    FoundMeasure& one = found.emplace_back();
    one.name = name;
    one.highest = found_run(finding.top, finding.at_highest, finding, findings, plan, outcomes);
    one.lowest = found_run(finding.bottom, finding.at_lowest, finding, findings, plan, outcomes);
    if (!finding.strongest) continue;
    one.strongest = plan.parameters[findings.parameters[*finding.strongest]].path;
    one.strongest_name = names[*finding.strongest];
    one.correlation = finding.correlations[*finding.strongest];
  }
  return found;
}

}  // namespace carom
