#pragma once
// What a comparison reads of one run's folder.
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "files/output_file.h"
#include "files/stored_table.h"
#include "scene/scene.h"

namespace carom {

struct RunRecord {
  ComparedRun run;
  bool done = false;                 // false: it failed, and all below is empty
  Descriptor folder;                 // open
  std::vector<std::string> summary;  // cells, by summary_columns()
  std::vector<double> measures;      // not a number: undefined
};

/// Throws ExportError where there is neither a whole run nor a failed one, or a measure cannot be known; its text names
/// the remedy.
RunRecord read_run(ComparedRun run, const std::vector<Measure>& measures);

/// Whether all measures can be known of the whole run in this folder.
bool tells(const std::string& folder, const std::vector<Measure>& measures);

/// A table of the run; throws ExportError where it is not there.
StoredTable open_table(const RunRecord& run, const char* name);
/// Whether it is there.
bool has_file(const RunRecord& run, const char* name);

/// Where the six numbers of a body's motion stand in a row of trajectory.csv.
struct MotionColumns {
  std::size_t body = 0;            // long: the column of the name; the numbers follow it
  std::vector<std::size_t> first;  // wide, by body: the first of the six; none there: 0
  bool wide = false;
};
/// `bodies`: names as in trajectory.csv.
MotionColumns motion_columns(const StoredTable& trajectory, const std::vector<std::string>& bodies);

/// Reads six numbers from cell `first` on. False: a cell is empty, for the body has become part of another.
bool read_motion(const std::vector<std::string_view>& cells, std::size_t first, Vec3& position, Vec3& velocity);

/// A body's motion at the end.
struct EndMotion {
  std::string body;
  Vec3 position, velocity;  // m, m/s
};
/// All bodies of the last instant, in the order of the file. Only the file's end is read.
std::vector<EndMotion> end_of_trajectory(const RunRecord& run);

/// The scene that the run's folder keeps. Throws SceneError.
Scene load_run_scene(const std::string& folder);

}  // namespace carom
