#pragma once
// The project's pages as data: README.md and the README.md of the folders, and scenes/format.md.
#include <filesystem>

#include "std.h"

namespace carom::testing {

/// A fenced block.
struct PageBlock {
  string language;
  string text;  // whole lines
};

struct Page {
  string path;  // from the root, with '/'
  string text;
  bool generated() const { return path == "scenes/format.md"; }
  string folder() const;  // "src/physics", "" at the root
  vector<PageBlock> blocks() const;
  vector<string> blocks(const string& language) const;
  /// The lines from a heading to the next one of its level or above.
  string section(const string& heading) const;
  /// GitHub's anchors of its headings.
  vector<string> anchors() const;
};

/// README.md first, then by path.
const vector<Page>& pages();

/// The page of this path; there must be one.
const Page& page_at(const string& path);

/// The bytes of a file.
string read_file(const std::filesystem::path& path);

/// A text in one line, with single spaces.
string one_line(const string& text);

/// The number after `phrase`, which must occur once on all pages written by hand. Otherwise a failure and NaN.
double stated(const string& phrase);

}  // namespace carom::testing
