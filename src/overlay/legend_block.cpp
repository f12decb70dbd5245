// Lays legends out once to measure them, and once more to draw them, by the same functions.
#include "overlay/legend_block.h"

#include "overlay/text_block.h"
#include "std.h"

namespace carom {
namespace {

constexpr double strip_width = 9, strip_height = 0.7;  // of the size of letters
constexpr double swatch = 0.75;                        // of the size of letters
constexpr double shrink = 0.9;

/// The pen moves down the block. Without a canvas it only measures.
class LegendPen {
 public:
  LegendPen(const Font& font, double padding, Canvas* canvas, vector<PixelBox>* strips)
      : font_(font), left_(padding), y_(padding), canvas_(canvas), strips_(strips) {
    if (canvas != nullptr) coverage_.emplace(canvas->width(), canvas->height());
  }

  void add(const vector<Legend>& legends) {
    for (const Legend& legend : legends) {
      if (&legend != &legends.front()) y_ += 0.6 * font_.size();
      if (!legend.title.empty()) line(legend.title, 0);
      if (legend.entries.empty()) strip(legend);
      for (const Legend::Entry& entry : legend.entries) item(entry);
    }
    if (coverage_) canvas_->add(*coverage_, text_color);
  }

  double width() const { return width_; }  // pixels, from the left edge
  double height() const { return y_; }     // pixels, from the upper edge

 private:
  /// A line of text, `x` pixels from the left.
  void line(const string& text, double x) {
    write(text, left_ + x);
    y_ += font_.line();
  }

  void write(const string& text, double x) {
    width_ = max(width_, x + font_.width(text));
    if (coverage_) font_.draw(text, x, y_ + font_.ascent(), *coverage_);
  }

  /// The strip, and below it the numbers of its ends.
  void strip(const Legend& legend) {
    const double numbers = font_.width(legend.min) + font_.width(legend.max) + font_.size();
    const PixelBox box{int(left_), int(ceil(y_)), int(max(strip_width * font_.size(), numbers)),
                       max(2, int(strip_height * font_.size()))};
    width_ = max(width_, double(box.left + box.width));

    if (canvas_ != nullptr)
      for (int x = 0; x < box.width; ++x)
        fill({box.left + x, box.top, 1, box.height}, color_in(legend.map, double(x) / max(box.width - 1, 1)));
    if (strips_ != nullptr) strips_->push_back(box);

    // The numbers below its ends.
    y_ = box.top + box.height + 0.15 * font_.size();
    write(legend.min, left_);
    write(legend.max, box.left + box.width - font_.width(legend.max));
    y_ += font_.line();
  }

  void item(const Legend::Entry& entry) {
    const int side = max(2, int(swatch * font_.size()));
    const double middle = y_ + (font_.ascent() + font_.descent()) / 2;
    if (canvas_ != nullptr) fill({int(left_), int(max(0.0, middle - 0.5 * side)), side, side}, entry.color);
    line(entry.name, 1.4 * side);
  }

  void fill(const PixelBox& box, const Color& color) {
    for (int y = box.top; y < box.top + box.height; ++y)
      for (int x = box.left; x < box.left + box.width; ++x) canvas_->add(x, y, color);
  }

  const Font& font_;
  double left_, y_, width_ = 0;
  Canvas* canvas_;
  vector<PixelBox>* strips_;
  optional<Coverage> coverage_;
};

}  // namespace

LegendBlock::LegendBlock(Font& font, const vector<Legend>& legends, double size, int width, int height) {
  if (legends.empty()) return;
  for (; size >= TextBlock::least_size; size *= shrink) {
    font.resize(size);
    const double padding = ceil(TextBlock::padding_of(size));

    LegendPen measure(font, padding, nullptr, nullptr);
    measure.add(legends);
    const int needed_width = int(ceil(measure.width() + padding));
    const int needed_height = int(ceil(measure.height() + padding));
    if (needed_width > width || needed_height > height) continue;

    canvas_ = make_unique<Canvas>(needed_width, needed_height);
    canvas_->add_plate(padding);
    LegendPen(font, padding, canvas_.get(), &strips_).add(legends);
    return;
  }
}

}  // namespace carom
