#pragma once
// The files of a sweep besides its runs: sweep.yaml and base.yaml, which determine the runs, then the comparison.
// The comparison is summary.csv, the workbook, and last manifest.json.
// Equal sweeps give equal bytes, however many parts they were computed in.

#include "compare/comparison.h"
#include "files/folder_writer.h"
#include "files/output_file.h"
#include "scene/sweep.h"
#include "std.h"
#include "study/run_status.h"

namespace carom {

inline constexpr const char* stored_sweep = "sweep.yaml";
inline constexpr const char* stored_base = "base.yaml";
/// A row for each run that is left out: its id, and the errors of its scene.
inline constexpr const char* stored_skipped = "skipped.csv";

enum class SweepContent {
  nothing,  // absent or empty
  /// This very sweep, complete: nothing to do.
  this_sweep,
  /// All or some runs of this sweep, perhaps with another comparison.
  same_runs,
  /// Another sweep's, or files that no sweep wrote.
  other
};

/// The content of `folder`. `base_text`: the text of the base scene. Changes nothing. Throws ExportError.
/// Runs with files untouched since the sweep's manifest was written are not read again.
/// Changes of mesh files that the scene names are not detected.
SweepContent inspect_sweep_folder(const string& folder, const Sweep& sweep, const string& base_text);

/// Whether the folder's sweep has ended: its manifest is that of its sweep.yaml and base.yaml. All runs there are
/// synced. Times of files do not count, so that this holds for a copy too.
bool is_ended_sweep(const string& folder);

/// The text of stored_skipped. Empty: none is left out, and there is no such file.
string skipped_text(const Sweep& sweep, const string& base_text, const vector<InvalidRun>& invalid);

/// The runs that a folder's stored_skipped lists: id and errors.
vector<pair<string, string>> stored_skips(const string& folder);

/// The failed runs of a sweep, according to its manifest.
vector<string> stored_failures(const string& folder);

/// A run of a sweep, with its folder `folder`.
/// A value that its block does not set comes from its scene, and is empty if the scene lacks it.
ComparedRun compared_run(const Sweep& sweep, size_t number, const string& folder);

/// The plan of the comparison of a sweep's runs. `base_text`: the text of the base scene.
ComparisonPlan comparison_plan(const Sweep& sweep, const string& base_text);

class SweepFolder {
 public:
  enum class Use {
    /// No other process may write into it.
    exclusive,
    /// Shared with other parts of the same sweep.
    part
  };
  /// Makes the folder if needed and locks it. Writes sweep.yaml, base.yaml and skipped.csv unless they exist.
  /// `skipped`: the text of the latter.
  /// Runs of another sweep are removed: ask inspect_sweep_folder before. Waits up to 30 s for other processes that do
  /// the same. `stop_check` is called meanwhile and may throw. Throws ExportError, as all functions of this class do.
  SweepFolder(const string& path, Use use, const Sweep& sweep, const string& base_text, const string& skipped,
              const function<void()>& stop_check);

  /// Reads every run's folder and writes the comparison and the manifest. `statuses`: by run.
  /// Runs that are left out have no row.
  void finish(const Sweep& sweep, const vector<RunStatus>& statuses, const ComparisonWatch& watch);

 private:
  bool lock(LockKind kind, const function<void()>& stop_check) const;
  void begin(const Sweep& sweep, const string& base_text, const string& skipped);
  bool has(const char* name, const string& text) const;
  void remove_runs() const;
  void put(const char* name, const string& text);

  Descriptor folder_;
  FilePlace place_;
  string base_text_;
  vector<FileRecord> begun_;
};

}  // namespace carom
