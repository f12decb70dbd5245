#include "run/motion_record.h"

#include "export/flights_file.h"
#include "run/replay.h"
#include "scene/scene.h"

namespace carom {

std::function<std::unique_ptr<Simulator>()> recorded_motion(const Scene& scene, const EngineChoice& engine,
                                                            const FilePlace& place,
                                                            const std::function<void()>& stop_check) {
  const auto file = std::make_shared<FlightsFile>(place, scene, FlightsFile::nameless);
  RecordSink sink(scene.simulate.duration, [&file](const Simulator& simulator) {
    file->record(simulator.collisions());
    file->record_paths(simulator.paths());
  });

  const auto simulator = make_simulator(scene, {.collisions = file->has_collisions(), .paths = true}, engine.steps);
  MotionSink* const sinks[] = {&sink};
  carry_through(*simulator, sinks, scene.simulate.duration,
                [](std::size_t, const std::function<void()>& work) { work(); },
                {.stop_check = stop_check, .advanced = [](const Simulator&) {}});
  simulator->state();
  file->end(simulator->tally());
  return
      [file, &scene] { return replay_from(std::make_unique<FlightsReader>(file->reopened(), "", scene), scene.world); };
}

}  // namespace carom
