// A caption has the upper two fifths of a picture, and legends have the lower three, so that they do not meet.
#include "overlay/inscription.h"

#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr double letters = 1.0 / 28;                     // of the picture's height
constexpr double legend_letters = 0.75;                  // of a caption's letters
constexpr double caption_part = 0.4, legend_part = 0.6;  // of the picture's height

double letters_of(Size size) {
  return max(size.height * letters, 2 * TextBlock::least_size);
}

/// A film that slows down says so, also without a caption of the scene.
bool has_caption(const Scene& scene) {
  return !scene.overlay.caption.empty() || (scene.output.video && scene.output.video->slow);
}

bool has_text(const Scene& scene) {
  const Overlay& overlay = scene.overlay;
  const optional<VideoOutput>& video = scene.output.video;
  return has_caption(scene) || overlay.labels || overlay.scale_bar || (video && (video->title || video->chart)) ||
         !legends_of(scene).empty();
}

}  // namespace

void check_font(const Scene& scene) {
  if (has_text(scene)) find_font();
}

Inscription::Inscription(const Scene& scene, Size size)
    : scene_(scene), size_(size), margin_(int(0.4 * letters_of(size))), captioned_(has_caption(scene)) {
  const vector<Legend> legends = legends_of(scene);
  if (has_marks(scene)) painter_ = make_unique<MarkPainter>(size);
  if (!captioned_ && legends.empty()) return;
  font_ = make_unique<Font>(find_font());
  if (legends.empty()) return;
  const bool corner = scene.overlay.scale_bar || scene.overlay.momentum_arrows;
  const int width = size.width - 2 * margin_ - (corner ? MarkPainter::column_width(size) : 0);
  legends_ = make_unique<LegendBlock>(*font_, legends, legend_letters * letters_of(size), width,
                                      int(legend_part * size.height) - margin_);
  if (legends_->canvas() == nullptr) legends_.reset();
}

int Inscription::legends_top() const {
  return size_.height - margin_ - legends_->canvas()->height();
}

void Inscription::write(const CaptionValues& values, Image& image, const Marks& marks) {
  vector<PixelBox> taken;
  if (captioned_) {
    string text = caption_text(scene_.overlay.caption, values);
    if (caption_ == nullptr || text != text_) {
      text_ = std::move(text);
      caption_ = make_unique<TextBlock>(*font_, text_, letters_of(size_), size_.width - 2 * margin_,
                                        int(caption_part * size_.height) - margin_);
    }
    if (const Canvas* canvas = caption_->canvas()) {
      canvas->lay_onto(image, margin_, margin_);
      taken.push_back({margin_, margin_, canvas->width(), canvas->height()});
    }
  }

  if (legends_ != nullptr) {
    const Canvas& canvas = *legends_->canvas();
    canvas.lay_onto(image, margin_, legends_top());
    taken.push_back({margin_, legends_top(), canvas.width(), canvas.height()});
  }
  if (painter_ != nullptr) painter_->draw(marks, taken, image);
}

}  // namespace carom
