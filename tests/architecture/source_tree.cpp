#include "architecture/source_tree.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "paths.h"
#include "std.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

/// Paths below `folder` of the root; folders with a path in `skip` are not entered.
vector<string> walk(const string& folder, const vector<string>& skip) {
  vector<string> paths;
  for (auto i = fs::recursive_directory_iterator(fs::path(SOURCE_DIR) / folder);
       i != fs::recursive_directory_iterator(); ++i) {
    string path = fs::relative(i->path(), SOURCE_DIR).generic_string();
    if (ranges::count(skip, path)) {
      i.disable_recursion_pending();
    } else if (i->is_regular_file()) {
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

/// Empty where there is no git or no repository. (safe.directory: the tree may belong to another user than the
/// tester.)
vector<string> git_paths() {
  vector<string> paths;
  string text;
  FILE* git = popen("git -c safe.directory='*' -C '" SOURCE_DIR "' ls-files -z 2> /dev/null", "r");
  if (!git) {
    return paths;
  }

  for (int c; (c = std::getc(git)) != EOF;) {
    if (c != '\0') {
      text += static_cast<char>(c);
      continue;
    }
    if (fs::is_regular_file(fs::path(SOURCE_DIR) / text)) {  // not removed since
      paths.push_back(text);
    }
    text.clear();
  }

  pclose(git);
  return paths;
}

vector<SourceFile> read_all(vector<string> paths) {
  ranges::sort(paths);
  vector<SourceFile> files;
  std::transform(paths.begin(), paths.end(), std::back_inserter(files), read_source);
  return files;
}

}  // namespace

vector<string> SourceFile::lines() const {
  vector<string> lines;
  std::istringstream in(text);
  for (string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

SourceFile read_source(const string& path) {
  std::ifstream in(fs::path(SOURCE_DIR) / path, std::ios::binary);
  return {path, string(std::istreambuf_iterator<char>(in), {})};
}

const vector<SourceFile>& tracked_files() {
  static const vector<SourceFile> files = [] {
    vector<string> paths = git_paths();
    return read_all(paths.empty() ? walk("", {".git", "build", "output"}) : paths);
  }();
  return files;
}

const vector<SourceFile>& program_files() {
  static const vector<SourceFile> files = [] {
    vector<string> paths = walk("src", {});
    std::erase_if(paths, [](const string& path) {
      return !path.ends_with(".h") && !path.ends_with(".cpp") && !path.ends_with(".inc");
    });
    return read_all(paths);
  }();
  return files;
}

}  // namespace carom::testing
