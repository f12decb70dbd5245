#pragma once
// What a comparison shows at a glance: the kind of variation, best and worst runs, and which parameter matters.

#include "compare/outcomes.h"
#include "run/measure.h"
#include "std.h"

namespace carom {

/// How the runs vary. It decides which charts show them best.
enum class Variety {
  runs,    // nothing orders them: nothing varies, or scenes with little in common
  line,    // one parameter, or several in step
  plane,   // a grid of two parameters
  samples  // points between which there are no lines: samples, and grids of more parameters
};

/// What the values of one measure show. Points are those of Outcomes; those without a value do not count.
struct MeasureFinding {
  static constexpr size_t most_ranked = 10;

  size_t measure = 0;
  size_t points = 0;  // with a value
  /// Whether all values are equal up to rounding.
  bool is_constant = false;
  /// The points with the highest values, the highest first. Equal ones are in the order of the runs.
  vector<size_t> highest;
  /// Those with the lowest ones, the lowest first. Points of `highest` are not among them.
  vector<size_t> lowest;
  /// The first points with the very highest and the very lowest value. Differences by rounding do not count.
  size_t top = 0, bottom = 0;
  /// How many points have the very highest and the very lowest value.
  size_t at_highest = 0, at_lowest = 0;
  /// Of repeats: the standard deviation between those of a point, the root of the mean square over all points. NaN: no
  /// repeats.
  double spread_of_repeats = numeric_limits<double>::quiet_NaN();
  /// By Findings::parameters: Spearman's rank correlation of the measure with it. NaN: undefined, or values that are
  /// no numbers.
  vector<double> correlations;
  /// The place in Findings::parameters of the strongest correlation. None: none is beyond chance.
  optional<size_t> strongest;
};

struct Findings {
  Variety variety = Variety::runs;
  /// The parameters that vary independently, by their index in the plan.
  vector<size_t> parameters;
  /// By the measures of the comparison.
  vector<MeasureFinding> measures;
};

/// `unrelated`: the scenes have little in common.
Findings findings_of(const Outcomes& outcomes, size_t measures, bool unrelated);

/// The measures that differ between runs, at most so many. Of unrelated runs those that all runs have come alone, if
/// there are any.
vector<const MeasureFinding*> shown_findings(const Findings& findings, size_t most);

/// How the points vary; of related runs.
Variety variety_of(const Outcomes& outcomes);

/// "let.angle from 10 to 82 (25 values), let.speed from 2 m/s to 14 m/s (25 values), 3 repeats".
string varied_ranges(const ComparisonPlan& plan, const Outcomes& outcomes);

}  // namespace carom
