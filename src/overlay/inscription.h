#pragma once
// The text of the pictures of one size: a caption at the upper left, legends at the lower left, and marks (marks.h).

#include "overlay/legend_block.h"
#include "overlay/mark_painter.h"
#include "overlay/text_block.h"
#include "render/image.h"
#include "scene/caption.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

struct Scene;

/// Throws RenderError with the remedy, if pictures of the scene have text and its font is missing.
void check_font(const Scene& scene);

class Inscription {
 public:
  /// `scene` must outlive this object. Letters of a caption have 1/28 of the picture's height, those of legends 3/4 of
  /// that, and less where the text would not fit. Throws RenderError.
  Inscription(const Scene& scene, Size size);

  bool any() const { return captioned_ || legends_ != nullptr || painter_ != nullptr; }
  /// Writes onto a picture of this size.
  void write(const CaptionValues& values, Image& image, const Marks& marks = {});

  /// Pixels from the upper left corner of the picture.
  int margin() const { return margin_; }
  const LegendBlock* legends() const { return legends_.get(); }
  int legends_top() const;

 private:
  const Scene& scene_;
  Size size_;
  int margin_;
  bool captioned_;
  unique_ptr<Font> font_;          // null: there is no text
  string text_;                    // of the caption below
  unique_ptr<TextBlock> caption_;  // of the last picture
  unique_ptr<LegendBlock> legends_;
  unique_ptr<MarkPainter> painter_;  // null: the scene has no marks
};

}  // namespace carom
