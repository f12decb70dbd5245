#pragma once
// A sweep file, or --grid of the command line -> the runs it asks for: which paths of the base scene get which values.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/load.h"

namespace carom {

/// A value of a path, as YAML in one line.
struct SweepValue {
  std::string text;   // "0.7", "[0, 1, 0]", "\"#ff0000\""
  std::string where;  // "falls.yaml:7:3", of its path or of itself
};

/// One value for each of some paths (numbers into Sweep::paths).
struct SweepCase {
  std::vector<std::pair<std::uint32_t, SweepValue>> values;
};

/// What varies by itself: a path of a grid, the paths of a zip, a list.
struct SweepAxis {
  enum class Kind : std::uint8_t { grid, zip, list };
  Kind kind = Kind::grid;
  std::vector<SweepCase> cases;
};

/// Every combination of its axes' cases, the last axis' varying fastest, but for those left out.
struct SweepBlock {
  std::vector<SweepAxis> axes;
  std::vector<std::uint32_t> kept;  // numbers of combinations
  std::string skip;                 // the rule that leaves some out, as YAML in one line; empty: none
};

struct SweepChart {
  std::string x, y, by;  // by: empty if there is none
  std::string where;
};

struct SweepMeasure {
  std::string name, where;
};

/// One run of a sweep.
struct SweepRun {
  std::string id;                                  // "r0001"
  std::vector<std::optional<std::string>> values;  // by Sweep::paths, as YAML; none: the base's own
  std::vector<Setting> settings;                   // those of all runs, then its own
};

/// What a sweep file says, with its ranges spelled out. Run numbers, ids and values depend on it alone.
class Sweep {
 public:
  std::string file;  // as named on the command line
  std::string title;
  std::string base;                    // the scene file, a path that opens from the working folder
  std::vector<SweepValue> set_values;  // "path=value", of every run
  std::vector<std::string> paths;      // that vary, in the order of the file; with repeats, `seed` is the last
  std::vector<SweepBlock> blocks;
  std::uint64_t seeds = 0;  // of each combination; 0: no repeats
  std::optional<std::uint64_t> first_seed;
  std::vector<SweepValue> only;  // outputs; empty: what the base asks for
  std::vector<SweepMeasure> measures;
  std::vector<SweepChart> charts;

  std::size_t size() const;
  SweepRun run(std::size_t number) const;  // number: from 0
  std::string id(std::size_t number) const;

  /// A sweep file that says the same of the base `base` beside it.
  std::string resolved(std::string_view base_name) const;
};

inline constexpr std::size_t most_runs = 1'000'000;
inline constexpr std::size_t most_values = 10'000'000;  // of all paths that go in step

/// Reads and checks a sweep file, as far as it can be without its base. Throws SceneError, which holds every error.
/// `color`: in the texts of errors.
Sweep load_sweep(const std::string& path, bool color = false);

/// The sweep that --grid asks for: each "path=from:to:count" or "path=value,value,...". Throws SceneError.
Sweep grid_sweep(const std::string& base, const std::vector<std::string>& grids, bool color = false);

/// Whether a file begins like a sweep file (has the key `sweep` and no key `scene`).
bool is_sweep_file(const std::string& path);

}  // namespace carom
