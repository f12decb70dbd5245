// Writes what is due at an instant, then draws what is due.
// The state is computed only if an output is due.
#include "run/stage.h"

#include "render/camera.h"
#include "render/glb.h"
#include "render/still_things.h"
#include "run/stopwatch.h"

namespace carom {

Stage::Stage(const Show& show, Durability durability)
    : scene(*show.scene),
      exports(scene, show.folder, durability,
              {still_things, glb, [this](const State& state) { return of_model_.at(state); }}, show.renewed),
      of_model_(scene, picture_size(scene.output)) {
  for (const PictureStream& stream : exports.pictures()) shots_.emplace_back(scene, stream.size, stream.samples);
  facts.load_s = show.load_s;
  more = exports.timeline().advance();
}

std::vector<MovingCamera*> Stage::cameras() {
  std::vector<MovingCamera*> cameras;
  for (Shot& shot : shots_) cameras.push_back(&shot.camera);
  if (scene.output.gltf) cameras.push_back(&of_model_);
  return cameras;
}

void Stage::sample(Simulator& simulator, const StageWatch& watch) {
  if (exports.needs_state()) {
    const State& state = simulator.state();
    {
      const Stopwatch stopwatch(facts.export_s);
      exports.sample(state, exports.needs_contacts() ? simulator.contacts() : std::span<const ContactForce>{});
    }
    draw_what_is_due(state, watch);
  }
  more = exports.timeline().advance();
}

void Stage::draw_what_is_due(const State& state, const StageWatch& watch) {
  const std::vector<PictureStream>& streams = exports.pictures();
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!exports.timeline().due(streams[i].timeline_stream)) continue;
    watch.stop_check();
    const Image* image = nullptr;
    bool again = false;
    {
      const Stopwatch stopwatch(facts.render_s);
      const std::uint64_t before = shots_[i].drawn();
      image = &shots_[i].draw(state);
      again = shots_[i].drawn() == before;
    }
    {
      const Stopwatch stopwatch(facts.export_s);
      exports.picture(i, *image, again);
    }
    watch.report_progress();
  }
}

}  // namespace carom
