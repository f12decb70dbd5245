// A failure becomes an outcome instead of an exception, so that the next scenes still run.
#include "commands/run_one.h"

#include <fmt/format.h>

#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/report.h"
#include "commands/text.h"
#include "files/earlier_run.h"
#include "overlay/history.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

Show show_of(const PlannedScene& planned) {
  Show show{planned.scene.get(), planned.folder, planned.load_s};
  show.origin = planned.origin;
  if (planned.former && planned.former->folder == planned.folder) show.renewed = &planned.former->manifest;
  return show;
}

/// A former run supplies the motion by its flights, and its warnings and measures unchanged.
RunSettings settings_of(const PlannedScene& planned, const Options& options) {
  RunSettings settings;
  settings.checkpoint_s = options.execution.checkpoint_s.value_or(settings.checkpoint_s);
  if (!planned.former) return settings;
  settings.former = &planned.former->manifest;
  settings.replay = replay_of(planned, overlay_needs(*planned.scene), options.quiet);
  return settings;
}

}  // namespace

function<unique_ptr<Simulator>(const Scene&)> replay_of(const PlannedScene& planned, const OverlayNeeds& needs,
                                                        bool quiet) {
  const FormerRun& former = *planned.former;
  const bool of_pictures = needs.collisions || needs.collision_counts;
  const bool collisions = of_pictures || slows_down(*planned.scene) || sounds(*planned.scene);
  if (collisions ? former.has_flights_with_collisions(*planned.scene) : former.has_flights())
    return [&former](const Scene& scene) { return former.replay(scene); };

  if (!quiet)
    write_err(fmt::format("{}: {}: simulating again\n", printable(former.folder),
                          !former.has_flights() ? "no flights are stored"
                          : of_pictures         ? "the pictures show collisions, which its flights do not hold"
                                                : "the film needs collisions, which its flights do not hold"));
  return {};
}

SceneOutcome run_one(const PlannedScene& planned, const Options& options, Progress& progress) {
  const RunWatch watch{stop_if_interrupted, [&](const RunProgress& now) { progress.update(now); },
                       [&](const string& text) {
                         progress.clear();
                         remark(options, fmt::format("{}: {}", printable(planned.file), text));
                       }};
  try {
    return run_done(planned, run_scene(show_of(planned), planned.price.engine, settings_of(planned, options), watch),
                    options);
  } catch (const std::exception& error) {
    return run_failed(planned, reason_of(error));
  }
}

}  // namespace carom
