// What a scene does not request is not computed: a Drawing of it has a camera and nothing else.
#include "overlay/drawing_maker.h"

#include <variant>

#include "overlay/moment.h"
#include "overlay/springs.h"
#include "overlay/strings.h"
#include "overlay/trails.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

bool has_springs(const World& world) {
  return !world.springs.empty() ||
         any_of(world.forces, [](const Force& force) { return std::holds_alternative<Spring>(force.law); });
}

bool has_strings(const Scene& scene) {
  return scene.world.strings.size() > scene.overlay.hidden_strings.size();
}

}  // namespace

DrawingMaker::DrawingMaker(const Scene& scene, const History& history, Size size, const FilmClock& clock)
    : scene_(scene),
      world_(scene.world),
      history_(history),
      size_(size),
      clock_(clock),
      colors_(scene),
      arrows_(arrow_scales(scene)),
      scales_(mark_scales(scene)),
      strokes_(scene.overlay.trails || !arrows_.empty() || has_springs(scene.world) || has_strings(scene)) {}

Drawing DrawingMaker::at(const State& state, const Camera& camera) {
  Drawing drawing;
  drawing.camera = camera;
  drawing.body_colors = colors_.at(state, history_);
  if (scene_.overlay.flash) drawing.glow = glow(state.time);
  if (!strokes_) return drawing;
  const Moment moment{scene_, world_.at(state.fired), state, history_, colors_, Eye(drawing.camera, size_)};
  add_trails(moment, drawing.strokes);
  add_springs(moment, drawing.strokes);
  add_strings(moment, drawing.strokes);
  add_arrows(moment, arrows_, drawing.strokes);
  return drawing;
}

Marks DrawingMaker::marks(const State& state, const Camera& camera) {
  return marks_of({scene_, world_.at(state.fired), state, history_, colors_, Eye(camera, size_)}, scales_);
}

vector<float> DrawingMaker::glow(double time) const {
  vector<float> values(scene_.world.body_count());
  const double now = clock_.plain(time), length = flash_length * clock_.speed();
  for (Entity i = 0; i < values.size(); ++i)
    values[i] = float(max(0.0, 1 - (now - clock_.plain(history_.last_collision(i))) / length));
  return values;
}

}  // namespace carom
