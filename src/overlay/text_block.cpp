// Long lines are broken first. What then does not fit is made smaller, and cut off only where letters would be too
// small to read.
#include "overlay/text_block.h"

#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

constexpr double shrink = 0.9;

unique_ptr<Canvas> drawn(const Font& font, const vector<string>& lines, double padding) {
  double width = 0;
  for (const string& line : lines) width = max(width, font.width(line));
  const double height = font.line() * double(lines.size() - 1) + font.ascent() + font.descent();

  auto canvas = make_unique<Canvas>(int(ceil(width + 2 * padding)), int(ceil(height + 2 * padding)));
  Coverage coverage(canvas->width(), canvas->height());
  double y = padding + font.ascent();
  for (const string& line : lines) {
    font.draw(line, padding, y, coverage);
    y += font.line();
  }

  canvas->add_plate(padding);
  canvas->add(coverage, text_color);
  return canvas;
}

}  // namespace

WrappedText wrapped(const Font& font, const string& text, double width) {
  WrappedText result;
  string line;
  for (size_t i = 0; i < text.size();) {
    const size_t word = min(text.find_first_not_of(' ', i), text.size());
    const size_t end = min(text.find(' ', word), text.size());
    if (word == end) break;
    const string longer = (line.empty() ? "" : line + text.substr(i, word - i)) + text.substr(word, end - word);

    if (!line.empty() && font.width(longer) > width) {
      result.lines.push_back(line);
      line = text.substr(word, end - word);
    } else {
      line = longer;
    }

    result.fits = result.fits && font.width(line) <= width;
    i = end;
  }
  if (!line.empty()) result.lines.push_back(line);
  return result;
}

string shortened(const Font& font, const string& text, double width) {
  if (font.width(text) <= width) return text;
  const string ellipsis = "\u2026";
  string best;
  for (size_t i = 0; i < text.size();) {
    char32_t code = 0;
    i += size_t(max(utf8_length(text, i, code), 1));
    string shorter = text.substr(0, i) + ellipsis;
    if (font.width(shorter) > width) break;
    best = std::move(shorter);
  }
  return best;
}

TextBlock::TextBlock(Font& font, const string& text, double size, int width, int height)
    : size_(max(size, least_size)) {
  for (;; size_ = max(least_size, shrink * size_)) {
    font.resize(size_);
    const double padding = padding_of(size_), space = width - 2 * padding - 1;
    const double one = font.ascent() + font.descent();
    const double most = floor((height - 2 * padding - one - 1) / font.line()) + 1;

    WrappedText text_lines = wrapped(font, text, space);
    vector<string>& lines = text_lines.lines;
    if (lines.empty()) return;
    const bool fits = text_lines.fits && double(lines.size()) <= most;
    if (!fits && size_ > least_size) continue;

    // At the least size the text is cut off.
    if (!fits) {
      if (!(most >= 1)) return;
      if (double(lines.size()) > most) {
        lines.resize(size_t(most));
        lines.back() += " \u2026";
      }
      for (string& line : lines) line = shortened(font, line, space);
      std::erase(lines, "");
      if (lines.empty()) return;
    }

    canvas_ = drawn(font, lines, padding);
    return;
  }
}

}  // namespace carom
