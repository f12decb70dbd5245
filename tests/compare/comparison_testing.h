#pragma once
// Folders of runs, made by running scenes; and a workbook read by an independent reader.
#include <fcntl.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/comparison.h"
#include "files/folder_writer.h"
#include "paths.h"
#include "run/run_scene.h"
#include "scene/load.h"
#include "std.h"

namespace carom::testing {

/// A temporary folder that removes itself.
class Place {
 public:
  Place() {
    string name = (std::filesystem::temp_directory_path() / "carom-study-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw runtime_error("no temporary folder");
    path_ = name;
  }
  ~Place() { std::filesystem::remove_all(path_); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  string operator/(const string& name) const { return (path_ / name).string(); }

  string read(const string& name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const string& name, const string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }

  /// Runs a scene with settings into a folder.
  RunResult run(const string& yaml, const string& folder, const vector<string>& set = {}) const {
    write(folder + ".yaml", yaml);
    LoadOptions options;
    options.set = set;
    const Scene scene = load_scene(*this / (folder + ".yaml"), options);
    return run_scene({&scene, *this / folder, 0}, choose_engine(scene), {}, {[] {}, [](const RunProgress&) {}});
  }

  /// Compares runs into the folder `out`.
  void compare(const ComparisonPlan& plan, const vector<ComparedRun>& runs, const string& out) const {
    std::filesystem::create_directories(path_ / out);
    const Descriptor folder = open_folder(AT_FDCWD, *this / out, true);
    const auto files =
        write_comparison({folder.get(), *this / out}, plan, runs.size(), [&](size_t number) { return runs[number]; });
    for (const auto& file : files) file->publish();
  }

  /// The workbook of the folder `out`, by openpyxl; brief: without its cells.
  nlohmann::json workbook(const string& out, bool brief = false) const {
    const string command = "/usr/bin/python3 '" SOURCE_DIR "/tests/compare/workbook_as_json.py' '" +
                           (*this / (out + "/comparison.xlsx")) + (brief ? "' brief" : "'") + " > '" +
                           (*this / "book.json") + "'";
    if (std::system(command.c_str()) != 0) throw runtime_error("openpyxl cannot read the workbook");
    return nlohmann::json::parse(read("book.json"));
  }

 private:
  std::filesystem::path path_;
};

/// Rows of a CSV text without quotes.
inline vector<vector<string>> rows_of(const string& text) {
  vector<vector<string>> rows;
  std::istringstream lines(text);
  for (string line; std::getline(lines, line);) {
    rows.emplace_back();
    for (size_t begin = 0; begin <= line.size();) {
      const size_t end = std::min(line.find(',', begin), line.size());
      rows.back().push_back(line.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return rows;
}

/// Two balls that meet at 0.445 s, all tables.
const string two_balls =
    "scene: 1\n"
    "title: Two balls\n"
    "gravity: [0, 0, 0]\n"
    "restitution: {default: 0.5}\n"
    "balls:\n"
    "  red: {mass: 10, radius: 0.11, position: [-1, 0, 0], velocity: [2, 0, 0]}\n"
    "  blue: {mass: 10, radius: 0.11, position: [1, 0, 0], velocity: [-2, 0, 0]}\n"
    "simulate: {duration: 1}\n"
    "output: {trajectory: {every: 0.1}, collisions: true, energy: {every: 0.1}}\n";

/// Six runs of these by restitution and the mass of red, r1 to r6 in a folder below the place: "" or "runs/".
inline vector<ComparedRun> six_runs(const Place& place, const string& folder) {
  vector<ComparedRun> runs;
  for (const char* e : {"0.5", "0.75", "1"})
    for (const char* mass : {"10", "20"}) {
      const string id = "r" + to_string(runs.size() + 1);
      place.run(two_balls, folder + id, {string("restitution.default=") + e, string("balls.red.mass=") + mass});
      runs.push_back({id, place / (folder + id), {e, mass}});
    }
  return runs;
}

}  // namespace carom::testing
