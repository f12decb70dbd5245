#pragma once
// carom run: scenes -> folders of results.

#include "commands/command_line.h"
#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/scene_outcome.h"
#include "std.h"

namespace carom {

const CommandText& run_text();
/// The program's exit code. Throws UsageError, Interrupted.
int run_command(const Options& options);

/// Settles one planned scene. May throw Interrupted.
using SceneWork = function<SceneOutcome(const PlannedScene&, const Style&, Progress&)>;

/// Settles planned scenes, each by `work`, and reports them; `command`: for the document of --json.
/// Returns the program's exit code.
int run_planned(const Options& options, string_view command, vector<PlannedScene> scenes, const SceneWork& work);
/// The same by running them.
int run_planned(const Options& options, string_view command, vector<PlannedScene> scenes);

}  // namespace carom
