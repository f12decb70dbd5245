#pragma once
// The outcome of a scene: for the terminal, and as an entry of the document of --json.
#include <nlohmann/json.hpp>

#include "commands/options.h"
#include "commands/plan.h"
#include "commands/report.h"
#include "run/run_scene.h"
#include "std.h"

namespace carom {

namespace scene_status {
inline constexpr const char *done = "done", *up_to_date = "up to date", *failed = "failed",
                            *interrupted = "interrupted", *not_run = "not run";
}

struct SceneOutcome {
  string status;
  nlohmann::ordered_json entry;  // of the document of --json
  string out;                    // for stdout
  string complaint;              // for stderr; empty: none
};

SceneOutcome without_run(const PlannedScene& planned, string_view status);
SceneOutcome wrong_scene(const PlannedScene& planned);  // its error has been printed already
SceneOutcome run_done(const PlannedScene& planned, const RunResult& result, const Options& options);
SceneOutcome run_up_to_date(const PlannedScene& planned, const Options& options);
SceneOutcome run_failed(const PlannedScene& planned, string_view text);
SceneOutcome run_interrupted(const PlannedScene& planned);

/// As text, to pass between processes.
string packed(const SceneOutcome& outcome);
SceneOutcome unpacked(const string& text);

}  // namespace carom
