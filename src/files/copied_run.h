#pragma once
// Copies of runs, and the removal of a run.

#include "std.h"

namespace carom {

/// Makes `to` a copy of the complete run in `from`, its manifest last. Files of another run in `to` are removed first.
/// The copy is not synced. Throws ExportError.
void copy_run(const string& from, const string& to);

/// Removes the files named in a run's manifest, and the folder if it is then empty.
void remove_run(const string& folder);

}  // namespace carom
