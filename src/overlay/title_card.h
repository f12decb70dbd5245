#pragma once
// The pictures before a film: its title over the first picture, dimmed.

#include "overlay/canvas.h"
#include "overlay/font.h"
#include "render/image.h"
#include "std.h"

namespace carom {

class TitleCard {
 public:
  /// `first`: the film's first picture. Letters have 1/10 of its height, and less where the title would have more than
  /// four lines or a word would not fit. Throws RenderError.
  TitleCard(const string& title, const Image& first);

  /// The card's picture `left` seconds before the film's first one. During the last 0.4 s it fades into that.
  /// Valid until the next call.
  const Image& picture(double left);

 private:
  const Image& first_;
  Coverage text_, shadow_;
  double shown_ = -1;  // how much of the card the picture below shows
  Image picture_;
};

}  // namespace carom
