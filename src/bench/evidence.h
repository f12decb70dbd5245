#pragma once
// Chooses, from several methods' runs of one scene, the reference for all others.
//
// Each method's finest run has an estimate of its own error.
// The estimate is the effect of rounding, and the difference of a coarser run of the method.
// Two runs agree if these estimates explain their difference.
// The reference is the finest run that another method confirms.
// Where no two agree, the first run is the reference, with at least the smallest difference as its error.

#include "bench/differences.h"
#include "bench/method.h"
#include "bench/recorded_run.h"
#include "std.h"

namespace carom {

/// The result of a method's finest run.
struct Finding {
  SimulationMethod method;
  RecordedRun run;
  Differences error;  // the method's own estimate
};

/// Another method's run, compared with the reference.
struct Witness {
  SimulationMethod method;
  double apart = 0;  // m: the greatest difference
  bool agrees = false;
};

/// The conclusion from all findings.
struct Verdict {
  size_t reference = 0;       // index of a finding
  Differences error;          // of its run
  vector<Witness> witnesses;  // all others
};

class Evidence {
 public:
  /// Runs are compared at `instants` (s) until `until` (s).
  /// `rounding`: the effect of rounding on the first finding's run. `last_digit`: its effect on a position, m.
  /// The first finding is the reference unless others contradict it.
  Evidence(const World& world, const vector<double>& instants, double until, const Differences& rounding,
           double last_digit, Finding first);

  /// Adds another method's run.
  void add(Finding finding);
  /// Adds a run with half the step of the previous one, unless the method changes.
  /// For a converging method, its finding is the run that differs least from the previous one.
  /// A run with the same bits as the first finding is ignored.
  void add_halved(const SimulationMethod& method, RecordedRun run);

  const vector<Finding>& findings() const { return findings_; }
  /// `settled`: the first finding is the reference whatever the others show.
  Verdict verdict(bool settled = false) const;

 private:
  Differences between(const RecordedRun& a, const RecordedRun& b) const {
    return differences(world_, a, b, instants_, until_);
  }
  void keep(const Finding& finding);
  bool agree(const Finding& a, const Finding& b, double apart) const;

  const World& world_;
  const vector<double>& instants_;  // s
  double until_;                    // s
  Differences rounding_;
  double last_digit_;  // m
  vector<Finding> findings_;
  // The present series of halved steps:
  optional<Finding> last_;
  /// In m: the difference from the previous run. Infinity: there is none.
  double change_ = 0;
  /// Index of the series' finding. 0: none so far.
  size_t best_ = 0;
};

}  // namespace carom
