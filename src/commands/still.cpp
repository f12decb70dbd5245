// The picture is no part of the run: its folder's manifest does not name it, and the run stays up to date.
#include "commands/still.h"

#include <fmt/format.h>

#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/run_one.h"
#include "commands/text.h"
#include "engine/accuracy.h"
#include "export/png.h"
#include "files/folder_writer.h"
#include "overlay/history.h"
#include "run/motion_record.h"
#include "run/slow_spot.h"
#include "run/still.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// A motion that is simulated once: for a camera that frames it into a record, because it is followed twice.
function<unique_ptr<Simulator>()> simulated(const Scene& scene, const EngineChoice& engine, const FilePlace& place) {
  if (frames_motion(scene)) return recorded_motion(scene, engine, place, stop_if_interrupted);
  return [&scene, &engine] {
    const OverlayNeeds needs = picture_needs(scene);
    return make_simulator(scene, {.collisions = needs.collisions || needs.collision_counts, .paths = needs.paths},
                          engine.steps);
  };
}

string draw(const PlannedScene& planned, double time, bool quiet) {
  Scene& scene = *planned.scene;
  FolderWriter folder(planned.folder);
  EngineChoice engine = planned.price.engine;
  const function<unique_ptr<Simulator>(const Scene&)> replay = replay_of(planned, picture_needs(scene), quiet);
  function<unique_ptr<Simulator>()> motion = [&] { return replay(scene); };

  if (!replay) {
    settle_steps(scene, engine, stop_if_interrupted);
    motion = simulated(scene, engine, folder.place());
  }

  // The camera frames the instants of the film, too.
  if (frames_motion(scene) && slows_down(scene))
    scene.known.slows_at = find_slowdown(scene, motion, stop_if_interrupted);

  const string picture =
      encode_png(draw_still(scene, name_of_folder(planned.folder), time, motion, stop_if_interrupted));

  OutputFile file(folder.place(), fmt::format("still_{}s.png", shortest(time)));
  file.write(picture);
  file.publish();
  folder.keep();
  return file.record().name;
}

}  // namespace

SceneOutcome still_of(const PlannedScene& planned, const Options& options) {
  try {
    SceneOutcome outcome = without_run(planned, scene_status::done);
    const string name = draw(planned, *options.at, options.quiet);
    outcome.entry["files"] = {name};
    outcome.out = fmt::format("{}/{}\n", printable(planned.folder), printable(name));
    return outcome;
  } catch (const std::exception& error) {
    return run_failed(planned, reason_of(error));
  }
}

}  // namespace carom
