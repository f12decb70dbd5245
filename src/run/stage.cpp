// Writes what is due at an instant, then draws what is due.
// The state is computed only if an output is due, and a renderer is made only for its first picture.
#include "run/stage.h"

#include "render/glb.h"
#include "render/still_things.h"
#include "run/stopwatch.h"

namespace carom {

Stage::Stage(const Show& show, Durability durability)
    : scene(*show.scene),
      exports(scene, show.folder, durability, {still_things, glb}, show.renewed),
      renderers_(exports.pictures().size()) {
  facts.load_s = show.load_s;
  more = exports.timeline().advance();
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
      // Made at the first picture that is due. A scene without pictures needs no OpenGL context and reads no mesh.
      if (!renderers_[i]) renderers_[i] = std::make_unique<Renderer>(scene, streams[i].size, streams[i].samples);
      const std::uint64_t before = renderers_[i]->drawn();
      image = &renderers_[i]->draw(state);
      again = renderers_[i]->drawn() == before;
    }
    {
      const Stopwatch stopwatch(facts.export_s);
      exports.picture(i, *image, again);
    }
    watch.report_progress();
  }
}

}  // namespace carom
