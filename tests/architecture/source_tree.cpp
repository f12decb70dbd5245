#include "architecture/source_tree.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

/// Paths below `folder` of the root; folders named in `skip` are not entered.
std::vector<std::string> walk(const std::string& folder, const std::vector<std::string>& skip) {
  std::vector<std::string> paths;
  for (auto i = fs::recursive_directory_iterator(fs::path(SOURCE_DIR) / folder);
       i != fs::recursive_directory_iterator(); ++i) {
    std::string path = fs::relative(i->path(), SOURCE_DIR).generic_string();
    if (std::count(skip.begin(), skip.end(), path)) {
      i.disable_recursion_pending();
    } else if (i->is_regular_file()) {
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

/// Empty where there is no git or no repository. (safe.directory: the tree may belong to another user than the
/// tester.)
std::vector<std::string> git_paths() {
  std::vector<std::string> paths;
  std::string text;
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

std::vector<SourceFile> read_all(std::vector<std::string> paths) {
  std::sort(paths.begin(), paths.end());
  std::vector<SourceFile> files;
  std::transform(paths.begin(), paths.end(), std::back_inserter(files), read_source);
  return files;
}

}  // namespace

std::vector<std::string> SourceFile::lines() const {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

SourceFile read_source(const std::string& path) {
  std::ifstream in(fs::path(SOURCE_DIR) / path, std::ios::binary);
  return {path, std::string(std::istreambuf_iterator<char>(in), {})};
}

const std::vector<SourceFile>& tracked_files() {
  static const std::vector<SourceFile> files = [] {
    std::vector<std::string> paths = git_paths();
    return read_all(paths.empty() ? walk("", {".git", "build", "output"}) : paths);
  }();
  return files;
}

const std::vector<SourceFile>& program_files() {
  static const std::vector<SourceFile> files = [] {
    std::vector<std::string> paths = walk("src", {});
    std::erase_if(paths, [](const std::string& path) {
      return !path.ends_with(".h") && !path.ends_with(".cpp") && !path.ends_with(".inc");
    });
    return read_all(paths);
  }();
  return files;
}

}  // namespace carom::testing
