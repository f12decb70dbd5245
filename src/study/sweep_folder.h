#pragma once
// What a sweep writes beside its runs: sweep.yaml and base.yaml, which say what the runs are; then summary.csv, the
// workbook, and last manifest.json. Of equal sweeps these have equal bytes, however many parts they were made in.
#include <functional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "files/open_folder.h"
#include "files/output_file.h"
#include "scene/sweep.h"
#include "study/sweep_job.h"

namespace carom {

inline constexpr const char* stored_sweep = "sweep.yaml";
inline constexpr const char* stored_base = "base.yaml";

enum class SweepContent {
  nothing,     // it is not there, or empty
  this_sweep,  // this very sweep, whole: nothing to do
  incomplete,  // this sweep's runs, or some of them; it may compare them by something else
  other        // another one's, or files that no sweep wrote
};

/// What stands in `folder`. `base_text`: the base scene's. Changes nothing. Runs whose files are untouched since
/// the sweep's manifest was written are not read again; whether meshes that the scene names are still the same is not
/// looked at. Throws ExportError.
SweepContent inspect_sweep_folder(const std::string& folder, const Sweep& sweep, const std::string& base_text);

/// The runs of a sweep that failed, as its manifest says.
std::vector<std::string> stored_failures(const std::string& folder);

/// A sweep's run that lies in `folder`. What its block does not set is what its scene has; what that does not have
/// either is empty.
ComparedRun compared_run(const Sweep& sweep, std::size_t number, const std::string& folder);

/// What the comparison of a sweep's runs shows.
ComparisonPlan comparison_plan(const Sweep& sweep);

class SweepFolder {
 public:
  enum class Use {
    alone,  // no other process may write into it
    part    // other parts of the same sweep may
  };
  /// Makes the folder if need be, locks it and, unless they stand there, writes sweep.yaml and base.yaml; the runs of
  /// another sweep go. Waits a while for processes that write these at the same time; `look` is called meanwhile and
  /// may throw. Throws ExportError, as all of this class does.
  SweepFolder(const std::string& path, Use use, const Sweep& sweep, const std::string& base_text,
              const std::function<void()>& look);

  /// Reads every run's folder and writes what compares them, and the manifest. `statuses`: by run.
  void finish(const Sweep& sweep, const std::vector<RunStatus>& statuses, const ComparisonWatch& watch);

 private:
  bool lock(LockKind kind, const std::function<void()>& look) const;
  void begin(const Sweep& sweep, const std::string& base_text);
  bool has(const char* name, const std::string& text) const;
  void remove_runs() const;
  void put(const char* name, const std::string& text);

  Descriptor folder_;
  FilePlace place_;
  std::vector<FileRecord> begun_;
};

}  // namespace carom
