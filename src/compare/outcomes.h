#pragma once
// The results by what was varied: a point for each run, or for each scenario of repeated runs.

#include "compare/comparison_plan.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

/// Mean and spread of the values added, in one pass (Welford 1962, Technometrics 4(3), 419).
class Spread {
 public:
  void add(double value);  // ignores NaN and infinity
  size_t count() const { return count_; }
  // Undefined (NaN) for too few values: none for the mean, one for sd.
  double mean() const { return count_ > 0 ? mean_ : numeric_limits<double>::quiet_NaN(); }
  /// With n - 1 in the denominator.
  double sd() const;
  double min() const { return count_ > 0 ? min_ : numeric_limits<double>::quiet_NaN(); }
  double max() const { return count_ > 0 ? max_ : numeric_limits<double>::quiet_NaN(); }

 private:
  size_t count_ = 0;
  double mean_ = 0, squares_ = 0, min_ = 0, max_ = 0;
};

/// The distinct values of a parameter, and the value of each point.
struct Varied {
  size_t parameter = 0;  // its index in the plan
  /// Sorted by size if all are numbers, else in order of appearance.
  vector<Cell> values;
  vector<uint32_t> of_point;
  bool numeric = true;
};

/// Without repeats, a run keeps only a few numbers: 8 bytes for each measure, 4 for each parameter, and its id.
class Outcomes {
 public:
  /// The maximum number of points. Of more runs without repeats, evenly spaced ones are kept.
  static constexpr size_t most_points = 100'000;

  Outcomes(const ComparisonPlan& plan, size_t measures, size_t runs);
  static constexpr size_t no_point = size_t(-1);
  /// Returns the point of the run, or no_point if it is left out.
  size_t add(size_t number, const ComparedRun& run, bool done, const vector<double>& measures);
  /// To be called after the last add().
  void finish();

  size_t points() const { return runs_.size(); }
  /// The id of a point's run, or of its first run.
  string_view id(size_t point) const;
  /// The number of its complete runs.
  size_t runs(size_t point) const { return runs_[point]; }
  /// The greatest number of complete runs of a point.
  size_t most_runs() const { return runs_.empty() ? 0 : ranges::max(runs_); }
  Spread spread(size_t point, size_t measure) const;
  /// By the plan's parameters. The seed of repeats has no values.
  const vector<Varied>& varied() const { return varied_; }
  size_t every() const { return stride_; }  // 1: each run counts

  /// The value of a parameter at a point.
  const Cell& value(size_t point, size_t parameter) const {
    return varied_[parameter].values[varied_[parameter].of_point[point]];
  }

  /// The indices of parameters that vary, numbers first, without those that follow from an earlier one: numbers that
  /// rise or fall with it, and texts that each of its values decides.
  vector<size_t> independent() const;
  /// Whether the runs fill at least half of the grid of two parameters' values.
  bool is_grid(size_t a, size_t b) const;

 private:
  bool follows(const Varied& a, const Varied& b) const;
  uint32_t number_of(Cell value, size_t p);

  optional<size_t> seed_;
  size_t measures_, stride_;
  vector<Varied> varied_;
  vector<map<string, uint32_t>> numbers_;  // indices of values, by parameter
  map<vector<uint32_t>, size_t> scenarios_;
  vector<uint32_t> runs_;  // by point, as the members below
  string ids_;             // concatenated
  vector<size_t> id_ends_;
  /// Of measures. Empty for repeats.
  vector<double> values_;
  vector<Spread> spreads_;  // of repeats
};

/// Whether scenes have little in common: most parameters exist in some of them only.
class AbsentValues {
 public:
  explicit AbsentValues(size_t parameters) : is_absent_(parameters) {}
  /// The values of a run. Those of a failed run may all be absent, and say nothing.
  void add(const vector<string>& values);
  bool unrelated() const;

 private:
  vector<bool> is_absent_;
};

/// repeats.csv: a row for each scenario, with its parameters, n, and the mean, sd, min and max of each measure.
void write_repeats(OutputFile& file, const ComparisonPlan& plan, const vector<Measure>& measures,
                   const Outcomes& outcomes);
/// The same as a sheet.
void write_repeats(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                   const Outcomes& outcomes);

}  // namespace carom
