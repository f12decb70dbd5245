// Every #include below src/ against the table of allowed includes in src/README.md.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "architecture/source_tree.h"
#include "paths.h"
#include "std.h"

namespace carom::testing {
namespace {

/// The table's rule for one folder of src/ ("main" for main.cpp).
struct Rule {
  bool all = false;
  set<string> folders;    // if all: those that it may not
  set<string> headers;    // single headers of other folders
  set<string> libraries;  // that no other folder includes
};

/// The table's names for single headers, and for libraries with the start of their include paths.
const map<string, vector<string>> header_words = {
    {"scene's types",
     {"scene/scene.h", "scene/colors.h", "scene/film_layout.h", "scene/look.h", "scene/output.h", "scene/overlay.h"}},
    {"yaml's texts", {"yaml/joined.h", "yaml/letters.h", "yaml/other_case.h", "yaml/printable.h", "yaml/value_json.h"}},
    {"the version", {"version.h"}},
    {"the program's place", {"program_file.h"}},
    {"render's Image", {"render/image.h"}},
    {"render's Model", {"render/model.h"}}};
const map<string, vector<string>> library_words = {
    {"Eigen", {"Eigen/"}},
    {"vector intrinsics", {"immintrin.h"}},
    {"yaml-cpp", {"yaml-cpp/"}},
    {"OSMesa/OpenGL", {"GL/", "KHR/", "EGL/"}},
    {"assimp", {"assimp/"}},
    {"libpng", {"png.h"}},
    {"libjpeg", {"jpeglib.h", "jerror.h"}},
    {"FreeType", {"freetype/"}},
    {"nettle", {"nettle/"}},
    {"ISA-L", {"isa-l/"}},
    {"libxlsxwriter", {"xlsxwriter"}},
    {"minizip", {"minizip/"}},
    {"CLI11", {"CLI/"}},
    {"the pipes of ffmpeg and gnuplot", {}},  // not a header: see OnlyExportStartsOtherPrograms
};
/// Names of the standard library, for every folder.
constexpr const char* own_vocabulary = "std.h";
/// Includes allowed in any folder: text and JSON, and the system's own headers.
const vector<string> free_libraries = {"fmt/",   "nlohmann/", "sys/",     "dirent.h", "dlfcn.h", "fcntl.h",
                                       "poll.h", "sched.h",   "signal.h", "spawn.h",  "unistd.h"};

vector<string> split(const string& text, char at) {
  vector<string> parts(1);

  for (char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else if (c != '`') {
      parts.back() += c;
    }
  }

  for (string& part : parts) {
    part = std::regex_replace(part, std::regex("^ +| +$"), "");
  }
  std::erase_if(parts, [](const string& part) { return part.empty() || part == "–"; });
  return parts;
}

/// Throws at an unknown word, so that no cell is ignored.
Rule read_rule(const string& may_include, const string& only_place) {
  Rule rule;

  for (const string& word : split(may_include, ',')) {
    if (word == "all") {
      rule.all = true;
    } else if (word.starts_with("all but ")) {
      rule.all = true;
      rule.folders.insert(word.substr(8));
    } else if (header_words.contains(word)) {
      rule.headers.insert(header_words.at(word).begin(), header_words.at(word).end());
    } else if (std::filesystem::is_directory(SOURCE_DIR "/src/" + word)) {
      rule.folders.insert(word);
    } else {
      throw runtime_error("the table says \"" + word + "\", which is no folder");
    }
  }

  for (const string& word : split(only_place, ',')) {
    if (!library_words.contains(word)) {
      throw runtime_error("the table says \"" + word + "\", a library that this test does not know");
    }
    rule.libraries.insert(word);
  }
  return rule;
}

/// The table, by folder.
map<string, Rule> read_table() {
  map<string, Rule> table;
  bool inside = false;

  for (const string& line : read_source("src/README.md").lines()) {
    if (line.starts_with("| folder | may include | the only place that includes |")) {
      inside = true;
    } else if (!line.starts_with("|")) {
      inside = false;
    } else if (inside && !line.starts_with("| ---")) {
      const size_t second = line.find('|', 1);
      const size_t third = line.find('|', second + 1);
      const size_t last = line.find('|', third + 1);
      const Rule rule =
          read_rule(line.substr(second + 1, third - second - 1), line.substr(third + 1, last - third - 1));

      for (string folder : split(line.substr(1, second - 1), ',')) {
        if (folder.ends_with('/')) folder.pop_back();
        table[folder] = rule;
      }
    }
  }

  return table;
}

struct Include {
  string path;
  bool own;  // in quotes
};

vector<Include> includes_of(const SourceFile& file) {
  static const std::regex directive(R"(^\s*#\s*include\s*(["<])([^">]+)[">].*)");
  vector<Include> includes;
  for (const string& line : file.lines()) {
    if (std::smatch match; std::regex_match(line, match, directive)) {
      includes.push_back({match[2], match[1] == "\""});
    }
  }
  return includes;
}

/// "physics" of "physics/world.h", "simulate/path" of "simulate/path/flight.h", "main" of "main.cpp".
string folder_of(const string& below_src) {
  const size_t slash = below_src.rfind('/');
  return below_src.substr(0, slash == string::npos ? below_src.find('.') : slash);
}

string folder_of(const SourceFile& file) {
  return folder_of(file.path.substr(4));
}

/// The folder of src/ that a folder is, or is within.
string top_of(const string& folder) {
  return folder.substr(0, folder.find('/'));
}

bool starts_with_any(const string& path, const vector<string>& starts) {
  return any_of(starts, [&](const string& start) { return path.starts_with(start); });
}

/// All own headers that a file includes, directly or through others.
void add_reach(const SourceFile& file, set<string>& reach) {
  for (const Include& include : includes_of(file)) {
    if (include.own && reach.insert(include.path).second) {
      for (const SourceFile& other : program_files()) {
        if (other.path == "src/" + include.path) {
          add_reach(other, reach);
        }
      }
    }
  }
}

TEST(Includes, EveryFolderHasARowInTheTable) {
  const auto table = read_table();
  ASSERT_FALSE(table.empty())
      << "src/README.md has no table that begins | folder | may include | the only place that includes |";
  for (const SourceFile& file : program_files()) {
    EXPECT_TRUE(table.contains(folder_of(file)) || file.path == string("src/") + own_vocabulary) << file.path;
  }
}

TEST(Includes, OwnHeadersOnlyAsTheTableAllows) {
  const auto table = read_table();
  for (const SourceFile& file : program_files()) {
    if (file.path == string("src/") + own_vocabulary) {
      continue;
    }

    const Rule& rule = table.at(folder_of(file));
    for (const Include& include : includes_of(file)) {
      if (!include.own || include.path == own_vocabulary) {
        continue;
      }
      EXPECT_TRUE(std::filesystem::exists(SOURCE_DIR "/src/" + include.path))
          << file.path << " includes \"" << include.path << "\", which is not below src/";
      const string folder = folder_of(include.path);
      EXPECT_TRUE(folder == folder_of(file) || rule.headers.contains(include.path) ||
                  (rule.all ? !rule.folders.contains(top_of(folder)) : rule.folders.contains(folder)))
          << file.path << " includes " << include.path;
    }
  }
}

TEST(Includes, LibrariesOnlyAtTheirOnlyPlace) {
  const auto table = read_table();
  for (const SourceFile& file : program_files()) {
    for (const Include& include : includes_of(file)) {
      const bool standard = include.path.find_first_of("/.") == string::npos;
      if (include.own || standard || starts_with_any(include.path, free_libraries)) {
        continue;
      }

      bool placed = false;
      for (const auto& [folder, rule] : table) {
        for (const string& library : rule.libraries) {
          if (starts_with_any(include.path, library_words.at(library))) {
            placed = placed || folder == folder_of(file);
          }
        }
      }

      EXPECT_TRUE(placed) << file.path << " includes <" << include.path << ">, which the table does not place there";
    }
  }
}

TEST(Includes, OfTheVocabularyAreNotRepeated) {
  set<string> standard;
  for (const Include& include : includes_of(read_source(string("src/") + own_vocabulary)))
    standard.insert(include.path);

  for (const SourceFile& file : program_files()) {
    const vector<Include> includes = includes_of(file);
    if (none_of(includes, [](const Include& include) { return include.path == own_vocabulary; })) continue;
    for (const Include& include : includes) {
      EXPECT_FALSE(standard.contains(include.path)) << file.path << ": <" << include.path << "> is in std.h";
    }
  }
}

TEST(Includes, OnlyExportStartsOtherPrograms) {
  for (const SourceFile& file : program_files()) {
    for (const char* program : {"\"ffmpeg\"", "\"gnuplot\""}) {
      EXPECT_TRUE(file.text.find(program) == string::npos || folder_of(file) == "export") << file.path;
    }
  }
}

TEST(Includes, SimulatorsExportsAndLoaderNeverReachOneAnother) {
  const map<string, vector<string>> never = {{"simulate", {"export/", "files/", "scene/", "yaml/"}},
                                             {"export", {"simulate/", "scene/load.h"}},
                                             {"files", {"simulate/", "export/", "scene/load.h"}},
                                             {"scene", {"simulate/", "export/", "files/"}}};

  for (const SourceFile& file : program_files()) {
    const auto banned = never.find(top_of(folder_of(file)));
    if (banned == never.end()) {
      continue;
    }

    set<string> reach;
    add_reach(file, reach);
    for (const string& header : reach) {
      EXPECT_FALSE(starts_with_any(header, banned->second)) << file.path << " reaches " << header;
    }
  }
}

}  // namespace
}  // namespace carom::testing
