#pragma once
// Named folders to the runs in them, and to the values in which their scenes differ.

#include "compare/comparison.h"
#include "scene/sweep.h"
#include "std.h"

namespace carom {

/// A run's folder, and its id among the runs.
struct ListedRun {
  string id, folder;
  /// False: it failed, according to its error.txt.
  bool done = false;
};

/// The runs of folders. Each is the folder of a run, or of a sweep, which stands for its runs/*.
/// Ids are the names of folders, with more of the path where two are equal.
/// Throws ExportError with a text that lists every folder that is neither.
/// `stop_check`: called often, may throw. The same holds below.
vector<ListedRun> list_runs(
    const vector<string>& folders, const function<void()>& stop_check = [] {});

/// SHA-256 of what identifies these runs: ids and manifests.
string digest_of(
    const vector<ListedRun>& runs, const function<void()>& stop_check = [] {});

/// Runs and their varied values.
class RunSet {
 public:
  /// The values in which their scenes differ, found with one scene in memory. Title, caption and outputs are not
  /// parameters.
  explicit RunSet(
      vector<ListedRun> runs, const function<void()>& stop_check = [] {});
  /// The values that the sweep of these runs varied, according to its file.
  RunSet(vector<ListedRun> runs, Sweep sweep);

  const vector<Parameter>& parameters() const { return parameters_; }
  /// The index of the seed among the parameters, if it distinguishes repeats of the same scenario.
  optional<size_t> seed() const { return seed_; }
  const vector<ListedRun>& runs() const { return runs_; }
  /// Whether the runs are those of a sweep, numbered by it.
  bool is_sweep() const { return sweep_.has_value(); }
  /// Run `number` with its values. Those that its scene lacks are empty.
  ComparedRun run(size_t number) const;

 private:
  vector<ListedRun> runs_;
  vector<Parameter> parameters_;
  map<string, size_t> numbers_;  // indices of parameters, by path
  optional<size_t> seed_;
  optional<Sweep> sweep_;
  /// By run: its number in the sweep.
  vector<size_t> in_sweep_;
};

/// The sweep of this folder, if all these runs belong to it. None: it is not a sweep's folder, or a run is not of it.
optional<Sweep> sweep_of(const string& folder, const vector<ListedRun>& runs);

}  // namespace carom
