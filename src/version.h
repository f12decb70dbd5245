#pragma once
// The version of the program. It stands in one source, so that another version compiles one file.

namespace carom {

/// Such as 0.2.0. Files that runs write have it, and runs of another version are not up to date. No file has the
/// commit: builds of one version count as one program.
extern const char* const program_version;

/// Such as "carom 0.2.0".
extern const char* const program_and_version;

}  // namespace carom
