#include "readme/pages.h"

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "paths.h"
#include "std.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

Page read_page(const string& path) {
  return {path, read_file(fs::path(SOURCE_DIR) / path)};
}

vector<Page> read_pages() {
  vector<string> paths;
  paths.push_back("output/README.md");
  for (const string folder : {"scenes", "src", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(SOURCE_DIR "/" + folder))
      if (entry.path().extension() == ".md") paths.push_back(fs::relative(entry.path(), SOURCE_DIR).generic_string());
  }
  ranges::sort(paths);
  paths.insert(paths.begin(), "README.md");
  vector<Page> all;
  for (const string& path : paths) all.push_back(read_page(path));
  return all;
}

/// 2 of "## Units"; 0: no heading.
size_t level_of(const string& line) {
  const size_t level = line.find_first_not_of('#');
  return level != string::npos && level > 0 && line[level] == ' ' ? level : 0;
}

/// Lower case, spaces as hyphens, no other marks.
string anchor_of(const string& heading) {
  string anchor;
  for (const char c : heading) {
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return anchor;
}

/// A page's lines outside of fenced blocks.
vector<string> prose_lines(const Page& page) {
  vector<string> lines;
  std::istringstream in(page.text);
  bool fenced = false;
  for (string line; std::getline(in, line);) {
    if (line.starts_with("```"))
      fenced = !fenced;
    else if (!fenced)
      lines.push_back(line);
  }
  return lines;
}

}  // namespace

string Page::folder() const {
  const size_t slash = path.rfind('/');
  return slash == string::npos ? "" : path.substr(0, slash);
}

vector<PageBlock> Page::blocks() const {
  vector<PageBlock> found;
  std::istringstream in(text);

  bool inside = false;
  for (string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), ""});
    } else if (inside) {
      found.back().text += line + "\n";
    }
  }

  EXPECT_FALSE(inside) << path << " leaves a block open";
  return found;
}

vector<string> Page::blocks(const string& language) const {
  vector<string> found;
  for (const PageBlock& block : blocks())
    if (block.language == language) found.push_back(block.text);
  return found;
}

string Page::section(const string& heading) const {
  string found;
  size_t level = 0;
  for (const string& line : prose_lines(*this)) {
    const size_t other = level_of(line);
    if (level > 0 && other > 0 && other <= level) break;
    if (other > 0 && line.substr(other + 1) == heading) level = other;
    if (level > 0) found += line + "\n";
  }
  EXPECT_GT(level, 0u) << path << " has no section " << heading;
  return found;
}

vector<string> Page::anchors() const {
  vector<string> found;
  map<string, int> times;
  for (const string& line : prose_lines(*this)) {
    const size_t level = level_of(line);
    if (level == 0) continue;
    const string anchor = anchor_of(line.substr(level + 1));
    const int before = times[anchor]++;
    found.push_back(before == 0 ? anchor : anchor + "-" + to_string(before));
  }
  return found;
}

const vector<Page>& pages() {
  static const vector<Page> all = read_pages();
  return all;
}

const Page& page_at(const string& path) {
  for (const Page& one : pages())
    if (one.path == path) return one;
  throw runtime_error("there is no page " + path);
}

string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

string one_line(const string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

double stated(const string& phrase) {
  vector<string> found;  // what follows the phrase
  for (const Page& one : pages()) {
    if (one.generated()) continue;
    const string line = one_line(one.text);
    for (size_t at = line.find(phrase); at != string::npos; at = line.find(phrase, at + 1))
      found.push_back(line.substr(at + phrase.size(), 40));
  }
  if (found.size() != 1) {
    ADD_FAILURE() << "on all pages " << found.size() << " times, not once: " << phrase;
    return std::nan("");
  }
  return std::stod(found[0]);
}

}  // namespace carom::testing
