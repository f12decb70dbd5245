#pragma once
// Text in lines that fit into a given space.

#include "overlay/canvas.h"
#include "overlay/font.h"
#include "std.h"

namespace carom {

/// Lines of at most `width` pixels, broken at spaces. `fits`: whether no word is longer than a line.
struct WrappedText {
  vector<string> lines;
  bool fits = true;
};
WrappedText wrapped(const Font& font, const string& text, double width);

/// The text up to the last letter that, with an ellipsis, fits into `width` pixels. Empty: not even that fits.
string shortened(const Font& font, const string& text, double width);

/// A text of several lines on a plate.
class TextBlock {
 public:
  /// At most `width` times `height` pixels: letters of `size` pixels, or smaller ones where the lines do not fit.
  /// Below 5 pixels text is cut off. Changes the font's size. Throws RenderError.
  TextBlock(Font& font, const string& text, double size, int width, int height);

  const Canvas* canvas() const { return canvas_.get(); }  // null: there is no text, or no space for a line
  double size() const { return size_; }                   // pixels, of letters

  /// Pixels between the canvas' edge and the text.
  static double padding_of(double size) { return 0.35 * size; }
  static constexpr double least_size = 5;  // pixels

 private:
  double size_;
  unique_ptr<Canvas> canvas_;
};

}  // namespace carom
