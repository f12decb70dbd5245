#pragma once
// Runs of a sweep that are another's copy, and runs that failed.
#include <string>

namespace carom {

/// What a failed run leaves in its folder: the reason, one text.
inline constexpr const char* failure_file = "error.txt";

/// Makes `to` a copy of the whole run in `from`, its manifest last. What another run left in `to` goes first. Not
/// synced. Throws ExportError.
void copy_run(const std::string& from, const std::string& to);

/// Removes the files of a run, by its manifest, and its folder if nothing else is in it.
void remove_run(const std::string& folder);

/// Makes the folder if need be. Throws ExportError.
void store_failure(const std::string& folder, const std::string& why);

/// Why the run failed; empty: it has not, or nobody knows.
std::string stored_failure(const std::string& folder);

}  // namespace carom
