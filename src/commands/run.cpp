// Plans all scenes, and runs them unless one is wrong.
#include "commands/commands.h"

#include "commands/batch.h"
#include "commands/watch.h"
#include "numerics/processors.h"

namespace carom {
namespace {

int run_scenes(const Options& options) {
  if (options.execution.threads) use_threads(*options.execution.threads);
  if (options.execution.watch) return watch_scenes(options);
  return run_planned(options, plan_scenes(options));
}

}  // namespace

const Command run_command = {
    "run",
    run_scenes,
    "simulates scenes and writes their outputs",
    "  carom run scenes/two_bowling_balls.yaml\n"
    "  carom run scene.yaml --only trajectory,collisions     data only, no pictures\n"
    "  carom run scene.yaml --set balls.red.restitution=0.5 -o output/half\n"
    "  carom run scenes/*.yaml -o results                    results/<scene file's stem>/...\n"
    "  carom run scene.yaml --watch                          again at each save\n"
    "  carom run - -o output/made < scene.json               a scene from standard input, in YAML or JSON\n",
    "Without -o a scene's run goes to output/<scene file's stem>/. All scenes are checked before\n"
    "the first is run. A folder that holds this very run is up to date and costs nothing. A run of the\n"
    "same scene file from before it was edited is replaced, if nothing in its folder was changed.\n"
    "A run that simulates for more than a minute goes on by the same command after an interrupt or a\n"
    "kill, with the same result. With pictures by a given camera it needs flights for that.\n"
    "\n"
    "Exit codes: 0 done or up to date, 1 a run failed, 2 the command line or a scene is wrong,\n"
    "130 or 143 interrupted.",
    {{"--output"},
     {"--set"},
     {"--only"},
     {"--seed"},
     {"--jobs"},
     {"--threads"},
     {"--checkpoint"},
     {"--watch"},
     {"--force"},
     {"--verbose"},
     {"--progress"}}};

}  // namespace carom
