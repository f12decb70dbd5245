#pragma once
// Runs that are another's copy, and the removal of a run.
#include <string>

namespace carom {

/// Makes `to` a copy of the whole run in `from`, its manifest last. What another run left in `to` goes first. Not
/// synced. Throws ExportError.
void copy_run(const std::string& from, const std::string& to);

/// Removes the files of a run, by its manifest, and its folder if nothing else is in it.
void remove_run(const std::string& folder);

}  // namespace carom
