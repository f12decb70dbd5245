#pragma once
// The project's pages as data: README.md and the README.md of the folders, and scenes/format.md.
#include <filesystem>
#include <string>
#include <vector>

namespace carom::testing {

/// A fenced block.
struct PageBlock {
  std::string language;
  std::string text;  // whole lines
};

struct Page {
  std::string path;  // from the root, with '/'
  std::string text;
  bool generated() const { return path == "scenes/format.md"; }
  std::string folder() const;  // "src/physics", "" at the root
  std::vector<PageBlock> blocks() const;
  std::vector<std::string> blocks(const std::string& language) const;
  /// The lines from a heading to the next one of its level or above.
  std::string section(const std::string& heading) const;
  /// GitHub's anchors of its headings.
  std::vector<std::string> anchors() const;
};

/// README.md first, then by path.
const std::vector<Page>& pages();

/// The page of this path; there must be one.
const Page& page_at(const std::string& path);

/// The bytes of a file.
std::string read_file(const std::filesystem::path& path);

/// A text in one line, with single spaces.
std::string one_line(const std::string& text);

/// The number after `phrase`, which must occur once on all pages written by hand. Otherwise a failure and NaN.
double stated(const std::string& phrase);

}  // namespace carom::testing
