#pragma once
// The project's own files as data, for the tests that hold the tree against its rules.

#include "std.h"

namespace carom::testing {

struct SourceFile {
  string path;  // from the root, with '/'
  string text;
  vector<string> lines() const;
};

/// Without text if it is not there.
SourceFile read_source(const string& path);

/// What git tracks; without git, every file outside of build/ and output/. Sorted.
const vector<SourceFile>& tracked_files();

/// The .h, .cpp and .inc files below src/, tracked or not yet. Sorted.
const vector<SourceFile>& program_files();

}  // namespace carom::testing
