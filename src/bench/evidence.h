#pragma once
// Which of several methods' runs of one scene is to be the reference that all are held against.
//
// Each method's finest run comes with an estimate of its own error: what rounding does, and by how much a coarser run
// of the method differs. Two runs agree if they differ by no more than these explain. The reference is the finest run
// that another method agrees with. Where no two agree it is the first, trusted to no less than the smallest difference.
#include <optional>
#include <vector>

#include "bench/differences.h"
#include "bench/method.h"
#include "bench/recorded_run.h"

namespace carom {

/// What a method's finest run says.
struct Finding {
  SimulationMethod method;
  RecordedRun run;
  Differences error;  // an estimate, of its own making
};

/// Another method's run, held against the reference.
struct Witness {
  SimulationMethod method;
  double apart = 0;  // m: at most
  bool agrees = false;
};

/// What the findings come to.
struct Verdict {
  std::size_t trusted = 0;         // a finding's number
  Differences error;               // of its run
  std::vector<Witness> witnesses;  // all others
};

class Evidence {
 public:
  /// Runs are compared at `instants` (s) until `until` (s). `rounding`: what it does to the first finding's run, and,
  /// in m, to a place (`last_digit`). The first finding is the reference unless others speak against it.
  Evidence(const World& world, const std::vector<double>& instants, double until, const Differences& rounding,
           double last_digit, Finding first);

  /// Another method's run.
  void add(Finding finding);
  /// A run with half the step of the one before, unless the method changes. A finding of a method that converges is
  /// its run that differs least from the one before. A run with the very bits of the first finding is none.
  void add_halved(const SimulationMethod& method, RecordedRun run);

  const std::vector<Finding>& findings() const { return findings_; }
  /// settled: the first finding is the reference whatever others say.
  Verdict verdict(bool settled = false) const;

 private:
  Differences between(const RecordedRun& a, const RecordedRun& b) const {
    return differences(world_, a, b, instants_, until_);
  }
  void keep(const Finding& finding);
  bool agree(const Finding& a, const Finding& b, double apart) const;

  const World& world_;
  const std::vector<double>& instants_;  // s
  double until_;                         // s
  Differences rounding_;
  double last_digit_;  // m
  std::vector<Finding> findings_;
  // The series of halved steps that is going on:
  std::optional<Finding> last_;
  double change_ = 0;     // m: by which it differs from the run before; infinity: it is the first
  std::size_t best_ = 0;  // the finding that it has made; 0: none so far
};

}  // namespace carom
