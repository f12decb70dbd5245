#pragma once
// A sweep and where it goes: its scenarios checked, what of them is done already, what is left to do, and the doing.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/run_folder.h"
#include "files/summary.h"
#include "run/measure.h"
#include "scene/load.h"
#include "scene/sweep.h"
#include "study/shard.h"
#include "study/workers.h"

namespace carom {

struct SweepSettings {
  LoadOptions load;  // without settings of its own
  std::size_t jobs = 1;
  Shard shard;
  bool force = false;                                           // run again what is done
  std::function<Output(const Output&, const Sweep&)> restrict;  // what of a scene's outputs is written
  std::function<void()> look;                                   // often, in every process; may throw
};

/// Whether a scenario may have a mesh, a file that can change without the sweep's doing. `base_text`: the base scene's.
bool may_have_meshes(const Sweep& sweep, const std::string& base_text);

enum class RunStatus : std::uint8_t { missing, done, failed };

/// A run that was looked at.
struct PlannedRun {
  std::array<char, 16> scene{}, motion{};  // digests: equal scenarios, scenarios that move alike
  FolderContent content = FolderContent::nothing;
  RunStatus status = RunStatus::missing;
};

struct SweepProgress {
  std::size_t done = 0, failed = 0, of = 0;  // runs of this shard that were to be done
};

class SweepJob {
 public:
  /// Reads the base; the first seed of repeats is its seed, unless the sweep says another. Throws SceneError.
  SweepJob(Sweep sweep, std::string folder, SweepSettings settings);

  const Sweep& sweep() const { return sweep_; }
  const std::string& base_text() const { return base_.text(); }
  /// A run's scenario, with the outputs that are written. Throws SceneError.
  Scene scene(std::size_t number);
  const std::string& folder() const { return folder_; }
  const std::vector<PlannedRun>& runs() const { return runs_; }
  std::string run_folder(std::size_t number) const;

  /// Loads every scenario and looks at its folder, several at a time. What is done and cannot tell the sweep's measures
  /// counts as missing. Throws SceneError with all that is wrong, each once (of a great many, the first).
  void plan(const std::function<void(const SweepProgress&)>& tell);

  /// The first run of this shard whose folder holds what it would overwrite: another scene's run, or more outputs.
  /// After plan().
  std::optional<std::size_t> other_content() const;

  /// The paths whose value makes no difference to the motion, though it is not of how the motion is looked at: runs
  /// that differ in nothing else move alike. After plan().
  std::vector<std::string> idle_paths() const;

  /// The runs of this shard, in order. After plan(), as all below.
  std::vector<std::size_t> of_part() const;
  /// How many of them are not done.
  std::size_t left() const;

  /// Does what is left: scenarios that move alike share one simulation, equal ones are run once and copied. A run that
  /// fails leaves `error.txt` in its folder. `failed` is called with each. Nothing is synced to the disk yet.
  void run(const std::function<void(const SweepProgress&)>& tell,
           const std::function<void(std::size_t number, const std::string& why)>& failed);

 private:
  struct Unit {
    std::vector<std::vector<std::size_t>> scenarios;  // each the runs of one scenario
    std::size_t like = none;                          // a run that is done and of the (only) scenario
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::string look_at(std::size_t first, std::size_t last);
  /// Runs that move alike.
  struct Motion {
    std::vector<std::size_t> runs;
    std::vector<Unit> units;  // what is to be done of them
  };
  static std::size_t first(const Motion& motion);  // its first run
  std::vector<Motion> motions() const;             // of this part
  std::vector<Unit> units() const;
  static std::size_t runs_in(const std::vector<Unit>& units);
  std::string work(const Unit& unit);

  Sweep sweep_;
  std::string folder_;
  SweepSettings settings_;
  SceneFile base_;
  std::vector<Measure> measures_;
  std::vector<PlannedRun> runs_;
};

}  // namespace carom
