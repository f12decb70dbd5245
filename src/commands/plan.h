#pragma once
// Checks all scenes of the command line before the first is simulated. Changes nothing.

#include "commands/options.h"
#include "engine/engine.h"
#include "export/forecast.h"
#include "files/run_folder.h"
#include "run/former_run.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

/// By which engine a scene is run, and what that takes and makes.
struct Price {
  EngineChoice engine;
  Forecast forecast;
};
Price price_of(const Scene& scene);

/// What stands in the folder of a run.
struct FolderLook {
  FolderContent content = FolderContent::nothing;
  string obstacle{};  // what of another content must not be overwritten, where that is known
};
FolderLook look_into(const string& folder, const Scene& scene);
/// The same where the folder holds the run that is drawn again, and its other files are right: incomplete or touched.
FolderLook look_into_own(const string& folder);

/// A checked scene of the command line: either `scene` and what follows from it, or `error`.
struct PlannedScene {
  string file;    // as on the command line
  string name;    // the file's stem
  string folder;  // where its run goes
  string error;   // for the terminal, whole lines; empty: none
  size_t errors = 0;
  vector<ErrorRecord> records;  // of the error, in parts
  unique_ptr<Scene> scene;
  double load_s = 0;  // wall time
  Price price;
  FolderLook found;
  SceneOrigin origin{};  // of a scene that is run; its settings as UTF-8
  /// What the user may not expect of this command, for the terminal.
  vector<string> notes{};
  shared_ptr<const FormerRun> former{};  // a run to draw again; in its own folder: renewed there
};

enum class Purpose { run, bench };

/// The scenes of the command line, each with its file, name and folder.
vector<PlannedScene> named_scenes(const Options& options, Purpose purpose = Purpose::run);

/// Loads and checks every scene, wrong ones as far as possible, so that one run shows all errors of all files.
/// Throws UsageError where two scenes would share a folder.
vector<PlannedScene> plan_scenes(const Options& options, Purpose purpose = Purpose::run);

/// The same for some of named_scenes(). `inspected`: called for each scene of which the folder's content is known,
/// which it may change. May be unset.
vector<PlannedScene> plan_scenes(vector<PlannedScene> scenes, const Options& options, Purpose purpose = Purpose::run,
                                 const function<void(PlannedScene&)>& inspected = {});

/// The same for scenes with a file, a name and a folder: `check` fills in the rest, or throws the error.
vector<PlannedScene> plan_scenes(vector<PlannedScene> scenes, const function<void(PlannedScene&)>& check);

/// The runs that the operands name by their folders, each with the folder that is to be written: the run's own, that of
/// --output, or for several runs one in it.
vector<PlannedScene> planned_folders(const Options& options);

/// Options to load scenes of a command line. `lifted`: no limit on pictures and rows; hold_to_budget checks these.
LoadOptions load_options(const Options& options, bool lifted);

/// Throws ExportError if a run would draw or write too much. `asker`: "--only requests".
void hold_to_budget(const Scene& scene, const Forecast& forecast, string_view asker);

/// What of a folder must not be overwritten, for use after "holds". Empty: nothing was changed.
string obstacle_of(const FolderChanges& changes);

/// Whether the folder holds this very run, and --force does not ask for it again.
bool is_up_to_date(const PlannedScene& planned, const Options& options);

/// Throws ExportError if something else has the folder's name.
void refuse_other_file(const string& folder);

/// Adds an error for each folder that holds something else, unless --force.
void refuse_other_content(vector<PlannedScene>& scenes, const Options& options);

/// "2 errors in 1 of 3 scenes", or empty if there is none.
string error_count(const vector<PlannedScene>& scenes);

}  // namespace carom
