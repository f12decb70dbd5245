#pragma once
// All checks of all scenes on the command line, which come before the first is simulated and change nothing.
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands/command_line.h"
#include "export/forecast.h"
#include "files/run_folder.h"
#include "run/engine.h"
#include "run/former_run.h"

namespace carom {

/// A scene of the command line, checked: either `scene` and what follows from it, or `error`.
struct PlannedScene {
  std::string file;    // as on the command line
  std::string name;    // the file's stem
  std::string folder;  // where its run goes
  std::string error;   // for the terminal, whole lines; empty: none
  std::size_t errors = 0;
  std::unique_ptr<Scene> scene;
  double load_s = 0;  // wall time
  EngineChoice engine;
  Forecast forecast;
  FolderContent content = FolderContent::nothing;
  std::shared_ptr<const FormerRun> former{};  // a run whose motion is drawn again; in its own folder: renewed there
};

enum class Purpose { run, bench };

/// Loads and checks every scene, a wrong one too far as it goes, so that all errors of all files are shown in one run.
/// Throws UsageError where two scenes would share a folder.
std::vector<PlannedScene> plan_scenes(const Options& options, Purpose purpose = Purpose::run);

/// The same for scenes that have a file, a name and a folder: `check` fills in the rest, or throws what is wrong.
std::vector<PlannedScene> plan_scenes(std::vector<PlannedScene> scenes,
                                      const std::function<void(PlannedScene&)>& check);

/// How scenes of a command line are read. With `lifted` pictures and rows are not limited: hold_to_budget does that.
LoadOptions load_options(const Options& options, bool lifted);

/// Throws ExportError if a run would draw or write too much. `asker`: "--only asks for".
void hold_to_budget(const Scene& scene, const Forecast& forecast, std::string_view asker);

/// Makes an error of each folder that holds something else, unless --force.
void refuse_other_content(std::vector<PlannedScene>& scenes, const Options& options);

/// "2 errors in 1 of 3 scenes", or empty if there is none.
std::string error_count(const std::vector<PlannedScene>& scenes);

}  // namespace carom
