#pragma once
// Legends as a picture.

#include "overlay/canvas.h"
#include "overlay/font.h"
#include "overlay/legend.h"
#include "std.h"

namespace carom {

/// A rectangle of pixels of a canvas.
struct PixelBox {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Legends one below another on a plate.
class LegendBlock {
 public:
  /// At most `width` times `height` pixels: letters of `size` pixels, or smaller ones where the legends do not fit.
  /// Changes the font's size. Throws RenderError.
  LegendBlock(Font& font, const vector<Legend>& legends, double size, int width, int height);

  const Canvas* canvas() const { return canvas_.get(); }  // null: letters would be below 5 pixels
  /// By legend: its strip of colours. The first and the last column have the colours of the map's ends.
  const vector<PixelBox>& strips() const { return strips_; }

 private:
  unique_ptr<Canvas> canvas_;
  vector<PixelBox> strips_;
};

}  // namespace carom
