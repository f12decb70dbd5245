#include "run/motion_record.h"

#include "export/flights_file.h"
#include "run/replay.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

RecordSink record_into(FlightsFile& file, double end) {
  return RecordSink(end, [&file](const Simulator& simulator) {
    file.record(simulator.collisions());
    file.record_paths(simulator.paths());
  });
}

function<unique_ptr<Simulator>()> recorded_motion(const Scene& scene, const EngineChoice& engine,
                                                  const FilePlace& place, const function<void()>& stop_check) {
  const auto file = make_shared<FlightsFile>(place, scene, FlightsFile::nameless);
  RecordSink sink = record_into(*file, scene.simulate.duration);
  const auto simulator = make_simulator(scene, {.collisions = file->has_collisions(), .paths = true}, engine.steps);
  MotionSink* const sinks[] = {&sink};
  carry_through(*simulator, sinks, scene.simulate.duration, unguarded, {.stop_check = stop_check});
  simulator->state();  // the tally's sums are then those of the end
  file->end(simulator->tally());
  return [file, &scene] { return replay_from(make_unique<FlightsReader>(file->reopened(), "", scene), scene.world); };
}

}  // namespace carom
