#pragma once
// The data of one run that a comparison reads from its folder.

#include "compare/comparison_plan.h"
#include "files/stored_table.h"
#include "std.h"

namespace carom {

struct RunRecord {
  ComparedRun run;
  /// False: it failed, and the members below are empty.
  bool done = false;
  Descriptor folder;        // the open run folder
  vector<string> summary;   // cells, by summary_columns()
  vector<double> measures;  // NaN: undefined, or a text
  vector<string> texts;     // by measure; empty: it is no text
};

/// Reads a run.
/// Throws ExportError if the folder has neither a complete nor a failed run, or if a measure cannot be determined.
/// The text names the remedy.
RunRecord read_run(ComparedRun run, const vector<Measure>& measures);

/// How the tables of a run are written, by its scene.yaml. None: it has none.
optional<CsvDialect> dialect_of(const ComparedRun& run);

/// Whether all measures can be determined from the complete run in this folder.
bool has_measures(const string& folder, const vector<Measure>& measures);

/// A table of the run. Throws ExportError if it is absent.
StoredTable open_table(const RunRecord& run, const char* name);
/// Whether the file exists, a table perhaps compressed.
bool has_file(const RunRecord& run, const char* name);

}  // namespace carom
