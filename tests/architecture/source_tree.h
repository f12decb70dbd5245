#pragma once
// The project's own files as data, for the tests that hold the tree against its rules.
#include <string>
#include <vector>

namespace carom::testing {

struct SourceFile {
  std::string path;  // from the root, with '/'
  std::string text;
  std::vector<std::string> lines() const;
};

/// Empty if it is not there.
SourceFile read_source(const std::string& path);

/// What git tracks; without git, every file outside of build/ and output/. Sorted.
const std::vector<SourceFile>& tracked_files();

/// The .h, .cpp and .inc files below src/, tracked or not yet. Sorted.
const std::vector<SourceFile>& program_files();

}  // namespace carom::testing
