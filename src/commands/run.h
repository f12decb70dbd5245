#pragma once
// carom run: scenes -> folders of results.
#include <functional>
#include <string_view>
#include <vector>

#include "commands/command_line.h"
#include "commands/plan.h"
#include "commands/scene_outcome.h"

namespace carom {

const CommandText& run_text();
/// The program's exit code. Throws UsageError, Interrupted.
int run_command(const Options& options);

/// What becomes of a planned scene. Throws Interrupted.
using SceneWork = std::function<SceneOutcome(const PlannedScene&)>;

/// Runs planned scenes and reports them; `command`: for the document of --json. Returns the program's exit code.
/// `work`: done in place of a run. May be empty.
int run_planned(const Options& options, std::string_view command, std::vector<PlannedScene> scenes,
                const SceneWork& work = {});

}  // namespace carom
