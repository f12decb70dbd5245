#pragma once
// Draws marks onto pictures of one size.

#include "overlay/canvas.h"
#include "overlay/font.h"
#include "overlay/legend_block.h"
#include "overlay/marks.h"
#include "std.h"

namespace carom {

class MarkPainter {
 public:
  /// Numbers have 1/38 of the picture's height, but at least 7.5 pixels. Throws RenderError.
  explicit MarkPainter(Size size);

  /// The width of the column at the right edge that the bar and the sum of momenta may need, in its lower three fifths.
  static int column_width(Size size);

  /// `taken`: where other text is. A label stands beside its body where it covers neither that nor another label, and
  /// as little of other bodies as possible. One without such a place is left out.
  void draw(const Marks& marks, span<const PixelBox> taken, Image& image);

 private:
  PixelBox draw_bar(const ScaleBar& bar, Image& image);
  PixelBox draw_sum(const MomentumSum& sum, int bottom, Image& image);
  /// `light`: the picture is; letters are then dark.
  void draw_label(const vector<string>& lines, const PixelBox& box, bool light, Image& image);

  Size size_;
  Font font_;
  int margin_;  // pixels
};

}  // namespace carom
