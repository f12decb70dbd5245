#include "overlay/title_card.h"

#include "overlay/pen.h"
#include "overlay/text_block.h"
#include "std.h"

namespace carom {
namespace {

constexpr double title_letters = 1.0 / 10;  // of the picture's height
constexpr double title_width = 0.84;        // of the picture's width
constexpr size_t most_title_lines = 4;
constexpr double title_shrink = 0.92;
constexpr double card_fade = 0.4;  // s
constexpr double dimness = 0.7, shadow_opacity = 0.5;

/// The lines of a text of at most this width, as equal in length as their number allows.
vector<string> even_lines(const Font& font, const string& text, double width) {
  const vector<string> lines = wrapped(font, text, width).lines;
  double least = 0, enough = width;
  for (int i = 0; i < 12; ++i) {
    const double middle = (least + enough) / 2;
    const WrappedText tried = wrapped(font, text, middle);
    (tried.fits && tried.lines.size() <= lines.size() ? enough : least) = middle;
  }
  return wrapped(font, text, enough).lines;
}

Coverage card_text(const string& title, int width, int height) {
  Font font(find_font(), max(height * title_letters, TextBlock::least_size));
  const double space = title_width * width;
  WrappedText text = wrapped(font, title, space);
  while ((!text.fits || text.lines.size() > most_title_lines) && font.size() > TextBlock::least_size) {
    font.resize(max(title_shrink * font.size(), TextBlock::least_size));
    text = wrapped(font, title, space);
  }
  if (text.fits) text.lines = even_lines(font, title, space);

  Coverage coverage(width, height);
  double y = (height - font.line() * double(text.lines.size())) / 2 + font.ascent();
  for (const string& each : text.lines) {
    const string line = shortened(font, each, space);
    font.draw(line, (width - font.width(line)) / 2, y, coverage);
    y += font.line();
  }
  return coverage;
}

}  // namespace

TitleCard::TitleCard(const string& title, const Image& first)
    : first_(first),
      text_(card_text(title, first.width, first.height)),
      shadow_(outline_of(text_, max(1.0, first.height * title_letters / 14))) {}

const Image& TitleCard::picture(double left) {
  const double part = clamp(left / card_fade, 0.0, 1.0), shown = part * part * (3 - 2 * part);
  if (shown == shown_) return picture_;
  shown_ = shown;
  const auto opacity = [shown](double whole) { return int(std::lround(255 * shown * whole)); };

  Canvas canvas(first_.width, first_.height);
  const Color black{0, 0, 0};
  for (int y = 0; y < first_.height; ++y) {
    for (int x = 0; x < first_.width; ++x) {
      canvas.add(x, y, black, opacity(dimness));
      if (const uint8_t value = shadow_.at(x, y); value > 0)
        canvas.add(x, y, black, opacity(shadow_opacity * value / 255));
      if (const uint8_t value = text_.at(x, y); value > 0) canvas.add(x, y, text_color, opacity(value / 255.0));
    }
  }
  picture_ = first_;
  canvas.lay_onto(picture_, 0, 0);
  return picture_;
}

}  // namespace carom
