#pragma once
// A sweep file, or --grid of the command line, to its list of runs: the paths of the base scene and their values.

#include "scene/load.h"
#include "std.h"

namespace carom {

/// A value of a path, as YAML on one line.
struct SweepValue {
  string text;   // "0.7", "[0, 1, 0]", "\"#ff0000\""
  string where;  // "falls.yaml:7:3", the place of the path or of the value
};

/// One value for each of several paths (indices into Sweep::paths).
struct SweepCase {
  vector<pair<uint32_t, SweepValue>> values;
};

/// What varies independently: a path of a grid, the paths of a zip, a list, or samples of ranges.
struct SweepAxis {
  enum class Kind : uint8_t { grid, zip, list, samples };
  Kind kind = Kind::grid;
  vector<SweepCase> cases;
};

/// Every combination of its axes' cases without those skipped. The last axis varies fastest.
struct SweepBlock {
  vector<SweepAxis> axes;
  vector<uint32_t> kept;  // indices of combinations
  /// The keys that draw its samples, as lines of YAML. Empty: none.
  string samples;
  /// The rule that skips combinations, as YAML on one line. Empty: none.
  string skip;
};

struct SweepChart {
  string x, y, by;  // `by` is empty if absent
  string where;
};

struct SweepMeasure {
  string name, where;
};

/// One run of a sweep.
struct SweepRun {
  string id;  // "r0001"
  /// By Sweep::paths, as YAML. None: the base's own.
  vector<optional<string>> values;
  /// Those of all runs, then its own.
  vector<Setting> settings;
};

/// The content of a sweep file, with its ranges expanded. Run numbers, ids and values depend on it alone.
class Sweep {
 public:
  string file;  // as given on the command line
  string title;
  /// The scene file, relative to the working folder.
  string base;
  vector<SweepValue> set_values;  // "path=value", applied to every run
  /// The paths that vary, in the order of the file. With repeats the last one is `seed`.
  vector<string> paths;
  vector<SweepBlock> blocks;
  /// The seed of samples. None: nothing is drawn.
  optional<uint64_t> seed;
  /// Whether runs whose scene is invalid are left out. The others keep their ids.
  bool skip_invalid = false;
  /// For each combination. 0: no repeats.
  uint64_t seeds = 0;
  optional<uint64_t> first_seed;
  /// Outputs. Empty: those of the base.
  vector<SweepValue> only;
  vector<SweepMeasure> measures;
  vector<SweepChart> charts;
  bool collisions = false;  // whether the workbook has a sheet of them

  size_t size() const;
  SweepRun run(size_t number) const;  // number: from 0
  string id(size_t number) const;

  /// An equivalent sweep file for a base scene named `base_name` in the same folder.
  string resolved(string_view base_name) const;
};

inline constexpr size_t most_runs = 1'000'000;
/// Of all paths of a zip together.
inline constexpr size_t most_values = 10'000'000;

/// What the command line decides before numbers are drawn.
struct SweepOptions {
  /// Replaces the seed of samples.
  optional<uint64_t> seed;
  /// Of a scene: how many samples of the ranges without a count.
  optional<uint64_t> random, latin;
  /// Of a scene: so many seeds of each run.
  optional<uint64_t> repeat;
  bool color = false;  // colour in the texts of errors
};

/// Reads and checks a sweep file, as far as possible without its base. Throws SceneError, which holds every error.
Sweep load_sweep(const string& path, const SweepOptions& options = {});

/// The sweep of the --grid options. Each is "path=from:to:count" or "path=value,value,...", or, for samples,
/// "path=from:to" or "path=from:to:log". Throws SceneError.
Sweep grid_sweep(const string& base, const vector<string>& grids, const SweepOptions& options = {});

/// Whether a file begins like a sweep file: it has the key `sweep` and no key `scene`.
bool is_sweep_file(const string& path);

}  // namespace carom
