#pragma once
// What a run of a sweep leaves that failed.
#include <string>

namespace carom {

/// Makes the folder if need be; what another run left in it goes, and the reason is all that stands there:
/// failure_file. Throws ExportError.
void store_failure(const std::string& folder, const std::string& why);

/// Why the run failed; empty: it has not, or that is not known.
std::string stored_failure(const std::string& folder);

}  // namespace carom
