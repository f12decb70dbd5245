#pragma once
// The folder of a failed run of a sweep.
#include <string>

namespace carom {

/// Makes the folder if needed, removes what another run left in it, and writes the reason to failure_file.
/// That is then the only file in it. Throws ExportError.
void store_failure(const std::string& folder, const std::string& why);

/// Whether a run failed because the disk, or the user's part of it, is full. Every further run would fail as well.
bool names_full_disk(const std::string& why);

/// The reason why the run failed. Empty: it did not fail, or the reason is unknown.
std::string stored_failure(const std::string& folder);

}  // namespace carom
