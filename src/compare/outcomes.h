#pragma once
// What came out, by what was varied: a point for each run, or for each scenario where runs are its repeats.
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/comparison.h"
#include "compare/workbook.h"

namespace carom {

/// Mean and spread of what was added, in one pass (Welford 1962, Technometrics 4(3), 419).
class Spread {
 public:
  void add(double value);  // one that is not a number does not count
  std::size_t count() const { return count_; }
  // Undefined (not a number) where there are too few values: none, or of sd one.
  double mean() const { return count_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN(); }
  double sd() const;  // with n - 1
  double min() const { return count_ > 0 ? min_ : std::numeric_limits<double>::quiet_NaN(); }
  double max() const { return count_ > 0 ? max_ : std::numeric_limits<double>::quiet_NaN(); }

 private:
  std::size_t count_ = 0;
  double mean_ = 0, squares_ = 0, min_ = 0, max_ = 0;
};

/// A parameter's values, each once, and which of them a point has.
struct Varied {
  std::size_t parameter = 0;  // its number in the plan
  std::vector<Cell> values;   // in order: of size where all are numbers, else as they came
  std::vector<std::uint32_t> of_point;
  bool numeric = true;
};

/// Of a run without repeats a few numbers are kept: 8 bytes a measure, 4 a parameter and its id.
class Outcomes {
 public:
  /// So many points at most are kept; of more runs without repeats, evenly chosen ones.
  static constexpr std::size_t most_points = 100'000;

  Outcomes(const ComparisonPlan& plan, std::size_t measures, std::size_t runs);
  void add(std::size_t number, const ComparedRun& run, bool done, const std::vector<double>& measures);
  /// After the last add().
  void finish();

  std::size_t points() const { return runs_.size(); }
  /// Of a point's run, or of its first one.
  std::string_view id(std::size_t point) const;
  /// How many of its runs are whole.
  std::size_t runs(std::size_t point) const { return runs_[point]; }
  Spread spread(std::size_t point, std::size_t measure) const;
  /// By the plan's parameters; the seed of repeats has no values.
  const std::vector<Varied>& varied() const { return varied_; }
  std::size_t every() const { return stride_; }  // 1: each run counts

  /// Numbers of the parameters that vary, none of which follows from one before it.
  std::vector<std::size_t> independent() const;

 private:
  bool follows(const Varied& a, const Varied& b) const;

  std::optional<std::size_t> seed_;
  std::size_t measures_, stride_;
  std::vector<Varied> varied_;
  std::vector<std::map<std::string, std::uint32_t>> numbers_;  // of values, by parameter
  std::map<std::vector<std::uint32_t>, std::size_t> scenarios_;
  std::vector<std::uint32_t> runs_;  // by point, as all below
  std::string ids_;                  // one after the other
  std::vector<std::size_t> id_ends_;
  std::vector<double> values_;   // of measures; of repeats: none
  std::vector<Spread> spreads_;  // of repeats
};

/// repeats.csv: a row a scenario: its parameters, n, and the mean, sd, min and max of each measure.
void write_repeats(OutputFile& file, const ComparisonPlan& plan, const std::vector<Measure>& measures,
                   const Outcomes& outcomes);
/// The same as a sheet.
void write_repeats(Worksheet& sheet, const ComparisonPlan& plan, const std::vector<Measure>& measures,
                   const Outcomes& outcomes);

}  // namespace carom
