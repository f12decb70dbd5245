// Plans all scenes, refuses wrong ones, runs each and reports.
#include "commands/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "commands/batch.h"
#include "commands/outcome_list.h"
#include "commands/report.h"
#include "commands/run_one.h"
#include "commands/text.h"
#include "commands/watch.h"
#include "files/processors.h"
#include "run/stages.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

int refuse(const Options& options, string_view command, const vector<PlannedScene>& scenes, const string& errors) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const PlannedScene& planned : scenes) {
    write_err(planned.error);
    entries.push_back(planned.errors > 0 ? wrong_scene(planned).entry
                                         : without_run(planned, scene_status::not_run).entry);
  }
  complain(options, errors + "; nothing was run");
  if (options.json) write_out(document(command, entries));
  return 2;
}

/// "2/3 two_bowling_balls", or the name alone.
string label(const vector<PlannedScene>& scenes, const PlannedScene& planned) {
  const auto number = static_cast<size_t>(&planned - scenes.data()) + 1;
  const string name = printable(planned.name);
  return scenes.size() == 1 ? name : fmt::format("{}/{} {}", number, scenes.size(), name);
}

RunAhead run_ahead(const PlannedScene& planned) {
  const Scene& scene = *planned.scene;
  return {.duration = scene.simulate.duration,
          .pictures = planned.forecast.frames,
          .crowd = crowd_ahead(scene, planned.engine.engine),
          .draw_s = planned.forecast.seconds,
          .draws_after = draws_after_motion(scene)};
}

}  // namespace

const CommandText& run_text() {
  static const CommandText text = {
      "run",
      "simulates scenes and writes their outputs",
      "  carom run scenes/two_bowling_balls.yaml\n"
      "  carom run scene.yaml --only trajectory,collisions     data only, no pictures\n"
      "  carom run scene.yaml --set balls.red.restitution=0.5 -o output/half\n"
      "  carom run scenes/*.yaml -o results                    results/<scene file's stem>/...\n"
      "  carom run scene.yaml --watch                          again at each save\n",
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
  return text;
}

int run_command(const Options& options) {
  if (options.execution.threads) use_threads(*options.execution.threads);
  if (options.watch) return watch_scenes(options);
  return run_planned(options, "run", plan_scenes(options));
}

int run_planned(const Options& options, string_view command, vector<PlannedScene> scenes) {
  return run_planned(options, command, std::move(scenes),
                     [&](const PlannedScene& planned, const Style& style, Progress& progress) {
                       return run_one(planned, options, style, progress);
                     });
}

int run_planned(const Options& options, string_view command, vector<PlannedScene> scenes, const SceneWork& work) {
  refuse_other_content(scenes, options);
  if (const string errors = error_count(scenes); !errors.empty()) return refuse(options, command, scenes, errors);
  for (const PlannedScene& planned : scenes)
    for (const string& note : planned.notes) remark(options, fmt::format("{}: {}", printable(planned.file), note));
  const auto start = std::chrono::steady_clock::now();
  const Style style{Palette(uses_color(options.color, STDOUT_FILENO)), terminal_width(STDOUT_FILENO)};
  OutcomeList list(options);
  Batch batch;
  batch.is_up_to_date = [&](const PlannedScene& planned) { return is_up_to_date(planned, options); };
  batch.up_to_date = [&](const PlannedScene& planned) { return run_up_to_date(planned, style); };
  batch.run = [&](const PlannedScene& planned, ProgressChoice choice, std::atomic<double>* done) {
    Progress progress(choice, uses_color(options.color, STDERR_FILENO), label(scenes, planned));
    progress.share(done);
    progress.expect(run_ahead(planned));
    return work(planned, style, progress);
  };
  batch.settle = [&](SceneOutcome outcome) { list.add(std::move(outcome)); };
  const int code = run_batch(batch, scenes, options, command);
  list.end(command, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return code != 0 ? code : list.count(scene_status::failed) > 0 ? 1 : 0;
}

}  // namespace carom
