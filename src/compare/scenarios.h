#pragma once
// Few scenarios that stand for all runs: spread over the values of the parameters, with names by these values.

#include "compare/outcomes.h"
#include "std.h"

namespace carom {

/// The scenarios that are shown over time.
struct ChosenScenarios {
  static constexpr size_t most = 8;
  static constexpr uint32_t none = 0xFFFFFFFF;
  vector<string> names;     // "restitution = 0.5, position.z = 0.1 m"; the run's id if nothing varies
  vector<uint32_t> of_run;  // by run: an index of `names`, or `none`
  size_t all = 0;           // scenarios
};

/// `point_of_run`: by run, its point of the outcomes, or Outcomes::no_point. `unrelated`: names are ids.
/// Each scenario after the first is the one farthest from all before it. Values count by their order.
ChosenScenarios chosen_scenarios(const ComparisonPlan& plan, const Outcomes& outcomes,
                                 const vector<size_t>& point_of_run, bool unrelated);

/// A number with at most five digits, or the text.
string shown_value(const Cell& cell);

/// For each path its last words, as many as tell it from the others: "restitution", "position.z".
vector<string> short_names(const vector<string>& paths);

}  // namespace carom
