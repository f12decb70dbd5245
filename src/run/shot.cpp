#include "run/shot.h"

namespace carom {

const Image& Shot::draw(const State& state) {
  if (!renderer_) renderer_ = std::make_unique<Renderer>(camera.scene(), camera.size(), samples_);
  Drawing drawing;
  drawing.camera = camera.at(state);
  return renderer_->draw(state, drawing);
}

}  // namespace carom
