#pragma once
// The work of a sweep: checks its scenarios, determines which runs are done, and does the others.

#include "files/run_folder.h"
#include "files/summary.h"
#include "run/measure.h"
#include "run/requirements.h"
#include "run/run_settings.h"
#include "scene/load.h"
#include "scene/sweep.h"
#include "std.h"
#include "study/run_status.h"
#include "study/shard.h"
#include "study/workers.h"

namespace carom {

struct SweepSettings {
  LoadOptions load;  // without --set options
  size_t jobs = 1;
  Shard shard;
  bool force = false;                                      // also run what is done
  double checkpoint_s = RunSettings{}.checkpoint_s;        // of each run
  bool checks_requirements = false;                        // whether this machine makes the outputs
  function<Output(const Output&, const Sweep&)> restrict;  // selects the outputs to write
  /// Called often, in every process. May throw.
  function<void()> stop_check;
};

/// Whether a scenario may have a mesh or begin with a former run: files that can change independently of the sweep.
/// `base_text`: the text of the base scene.
bool may_read_files(const Sweep& sweep, const string& base_text);

/// A run after planning.
struct PlannedRun {
  /// Digests. Scenarios with equal `scene` are equal, and those with equal `motion` move alike. Those with equal
  /// `measured` have the same measures of their motion.
  array<char, 16> scene{}, motion{}, measured{};
  FolderContent content = FolderContent::nothing;
  RunStatus status = RunStatus::missing;
};

struct SweepProgress {
  /// Numbers of runs to do in this shard.
  size_t done = 0, failed = 0, of = 0;
};

class SweepJob {
 public:
  /// Reads the base. The first seed of repeats is the base's, unless the sweep sets another. Throws SceneError.
  SweepJob(Sweep sweep, string folder, SweepSettings settings);

  const Sweep& sweep() const { return sweep_; }
  const string& base_text() const { return base_.text(); }
  /// A run's scenario, with the outputs to write. Throws SceneError.
  Scene scene(size_t number);
  const string& folder() const { return folder_; }
  const vector<PlannedRun>& runs() const { return runs_; }
  string run_folder(size_t number) const;

  /// Loads every scenario and inspects its folder, several at a time.
  /// A finished run from which the sweep's measures cannot be determined counts as missing.
  /// Throws SceneError with all errors, each once. Of a large number, only the first ones are given.
  /// If the sweep leaves out invalid runs, it throws only if all are invalid, or this machine lacks something.
  void plan(const function<void(const SweepProgress&)>& report_progress);

  /// The runs that are left out, by number. They belong to no part.
  const vector<InvalidRun>& invalid() const { return invalid_; }

  /// The first run of this shard that would overwrite other content: another scene's run, more outputs, or a changed
  /// file. Call it after plan().
  optional<size_t> other_content() const;

  /// The paths that affect neither the motion nor measures, although they are not settings of appearance or output.
  /// Runs that differ only in such a path move alike. Call it after plan().
  vector<string> idle_paths() const;

  /// The runs of this shard, in order. Call it and the functions below after plan().
  vector<size_t> of_part() const;
  /// The number of these runs that are not done.
  size_t left() const;

  /// Does the remaining runs. Scenarios that move alike share one simulation, and equal ones are run once and copied.
  /// A failed run leaves `error.txt` in its folder, and `failed` is called with it. On a full disk no further run
  /// begins, and ExportError is thrown.
  /// The last results are not yet synced to disk.
  void run(const function<void(const SweepProgress&)>& report_progress,
           const function<void(size_t number, const string& why)>& failed);

 private:
  struct Unit {
    vector<vector<size_t>> scenarios;  // for each scenario its runs
    /// A finished run of the (only) scenario.
    size_t like = none;
  };
  static constexpr size_t none = size_t(-1);

  string examine(size_t first, size_t last);
  /// Runs that move alike.
  struct Motion {
    vector<size_t> runs;
    vector<Unit> units;  // the remaining work
  };
  static size_t first(const Motion& motion);  // its first run
  vector<Motion> motions() const;             // of this part
  vector<Unit> units() const;
  static size_t runs_in(const vector<Unit>& units);
  string work(const Unit& unit);

  Sweep sweep_;
  string folder_;
  SweepSettings settings_;
  SceneFile base_;
  Requirements requirements_;
  vector<Measure> measures_;
  vector<PlannedRun> runs_;
  vector<InvalidRun> invalid_;
};

}  // namespace carom
