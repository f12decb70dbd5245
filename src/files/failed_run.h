#pragma once
// The folder of a failed run of a sweep.

#include "std.h"

namespace carom {

/// Makes the folder if needed, removes what another run left in it, and writes the reason to failure_file.
/// That is then the only file in it. Throws ExportError.
void store_failure(const string& folder, const string& why);

/// Whether a run failed because the disk, or the user's part of it, is full. Every further run would fail as well.
bool names_full_disk(const string& why);

/// The reason why the run failed. Empty: it did not fail, or the reason is unknown.
string stored_failure(const string& folder);

}  // namespace carom
