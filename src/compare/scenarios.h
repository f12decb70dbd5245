#pragma once
// Few scenarios that stand for all runs: spread over the values of the parameters, with names by these values.
#include <cstdint>
#include <string>
#include <vector>

#include "compare/outcomes.h"

namespace carom {

/// The scenarios that are shown over time.
struct ChosenScenarios {
  static constexpr std::size_t most = 8;
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<std::string> names;     // "restitution = 0.5, position.z = 0.1 m"; the run's id if nothing varies
  std::vector<std::uint32_t> of_run;  // by run: an index of `names`, or `none`
  std::size_t all = 0;                // scenarios
};

/// `point_of_run`: by run, its point of the outcomes, or Outcomes::no_point. `unrelated`: names are ids.
/// Each scenario after the first is the one farthest from all before it. Values count by their order.
ChosenScenarios chosen_scenarios(const ComparisonPlan& plan, const Outcomes& outcomes,
                                 const std::vector<std::size_t>& point_of_run, bool unrelated);

/// For each path its last words, as many as tell it from the others: "restitution", "position.z".
std::vector<std::string> short_names(const std::vector<std::string>& paths);

}  // namespace carom
