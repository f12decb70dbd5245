#pragma once
// What a finished comparison shows at a glance, from its summary.csv.

#include "compare/findings.h"
#include "std.h"

namespace carom {

/// A run, or the first of its repeats, with its values of the parameters that vary independently.
struct FoundRun {
  string id;
  double value = 0;                       // of the measure; of repeats their mean
  size_t repeats = 1;                     // with a value
  size_t others = 0;                      // runs with the same value
  vector<pair<string, string>> values{};  // paths, and values with their units
};

/// What is found of one measure.
struct FoundMeasure {
  string name;
  FoundRun highest, lowest;
  /// The parameter with the strongest rank correlation. Empty: none is beyond chance.
  string strongest;
  string strongest_name;  // its last words, as many as tell it from the others
  double correlation = 0;
};

/// Of the measures that differ between the runs, in their order, and of `always`. Empty: there is no such table.
/// Throws ExportError.
vector<FoundMeasure> stored_findings(const string& folder, const ComparisonPlan& plan, string_view always = {});

}  // namespace carom
