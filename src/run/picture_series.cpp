// A picture is repeated if it shows the same drawing as the last one, alone, with the same text.
#include "run/picture_series.h"

#include <fmt/format.h>

#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A state so much later (s) as if all bodies went straight on.
State later(const State& state, double time) {
  State moved = state;
  moved.time += time;
  for (size_t i = 0; i < moved.position.size(); ++i) moved.position[i] += time * moved.velocity[i];
  return moved;
}

}  // namespace

PictureSeries::PictureSeries(const Scene& scene, const PictureStream& stream, const History& history, string run)
    : scene_(scene),
      stream_(stream),
      history_(history),
      run_(std::move(run)),
      camera_(scene, stream.size),
      shutter_(scene.overlay.shutter * stream.interval) {
  if (stream.charted) chart_ = make_unique<FilmChart>(scene);
}

void PictureSeries::aim(optional<double> picture) {
  if (shutter_.is_used() && picture) shutter_.aim(*picture, stream_.clock.pace(*picture));
}

const Image& PictureSeries::draw(const State& state) {
  if (!renderer_) renderer_ = make_unique<Renderer>(scene_, stream_.size, stream_.samples);
  if (!maker_) maker_.emplace(scene_, history_, stream_.size, stream_.clock);
  Drawing drawing = maker_->at(state, camera_.at(state));
  drawing.faded = camera_.faded();
  return renderer_->draw(state, std::move(drawing));
}

void PictureSeries::expose(const State& state) {
  if (shutter_.opens()) {
    const Eye opening(camera_.at(state), stream_.size);
    const Eye closing =
        camera_.stands_still() ? opening : Eye(camera_.at(later(state, shutter_.length())), stream_.size);
    shutter_.open_for(exposures_of(scene_, state, shutter_.length(), opening, closing));
    return;
  }
  shutter_.pass();
  mean_.add(draw(state));
  ++exposed_;
}

/// The picture without text.
const Image& PictureSeries::light(const State& state) {
  const Image& last = draw(state);
  if (exposed_ == 0) return last;
  mean_.add(last);
  exposed_ = 0;
  return mean_.take();
}

const Image& PictureSeries::picture(const State& state, const Tally& tally) {
  const bool several = exposed_ > 0;
  const Image& image = light(state);
  const uint64_t drawn = renderer_->drawn();
  repeated_ = alone_ && !several && drawn == shown_ && !chart_;
  alone_ = !several;
  shown_ = drawn;
  const Image& written = with_text(image, state, tally);
  return chart_ ? chart_->beside(written, state) : written;
}

const Image& PictureSeries::with_text(const Image& image, const State& state, const Tally& tally) {
  if (!inscription_) inscription_.emplace(scene_, stream_.size);
  if (!inscription_->any()) return image;
  CaptionValues values{scene_.title, fmt::format("{:.{}f}", state.time, stream_.decimals), run_,
                       to_string(tally.collisions()), stream_.clock.text(state.time)};
  const auto text = [&](const CaptionValues& its) { return caption_text(scene_.overlay.caption, its); };

  Marks marks;
  if (has_marks(scene_)) marks = maker_->marks(state, camera_.at(state));
  repeated_ = repeated_ && text(values) == text(values_) && marks == marks_;
  values_ = std::move(values);
  marks_ = std::move(marks);
  if (repeated_) return image_;
  image_ = image;
  inscription_->write(values_, image_, marks_);
  return image_;
}

}  // namespace carom
