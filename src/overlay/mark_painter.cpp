// Labels are placed in the order of the bodies, each by the picture alone, so that a picture does not depend on others.
#include "overlay/mark_painter.h"

#include "overlay/pen.h"
#include "overlay/text_block.h"
#include "scene/label_size.h"
#include "std.h"

namespace carom {
namespace {

constexpr double bar_part = 0.2;     // of the picture's width: the longest bar (marks.h)
constexpr double panel_part = 0.26;  // of the picture's height: the side of the panel of momenta
constexpr double bar_height = 0.28;  // of the size of letters, as all below
constexpr double label_gap = 0.3;    // from the body to its label
constexpr double label_line = 1.15;
constexpr double outline_width = 0.14;
const Color outline_color{0.06, 0.07, 0.09};
constexpr double light_picture = 0.78;  // sRGB: above it labels are dark on light

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height && b.top < a.top + a.height;
}

/// The area in pixels that a box shares with a body's outline.
double shared(const PixelBox& box, const BodyBounds& body) {
  const double width = min(double(box.left + box.width), body.right) - max(double(box.left), body.left);
  const double height = min(double(box.top + box.height), body.bottom) - max(double(box.top), body.top);
  return width > 0 && height > 0 ? width * height : 0;
}

/// The places of a label around a body, in the order of preference: above, below, beside, at the corners.
array<PixelBox, 8> places_around(const BodyBounds& body, int width, int height, double gap) {
  const auto at = [&](double x, double y) { return PixelBox{int(std::lround(x)), int(std::lround(y)), width, height}; };
  const double middle_x = (body.left + body.right - width) / 2, middle_y = (body.top + body.bottom - height) / 2;
  const double left = body.left - gap - width, right = body.right + gap;
  const double top = body.top - gap - height, bottom = body.bottom + gap;
  return {at(middle_x, top), at(middle_x, bottom), at(right, middle_y), at(left, middle_y),
          at(right, top),    at(left, top),        at(right, bottom),   at(left, bottom)};
}

/// Whether a picture is so light that dark letters are read better. One answer for all of its labels.
bool is_light(const Image& image) {
  double sum = 0;
  size_t count = 0;
  for (int y = 0; y < image.height; y += 4) {
    const uint8_t* rgb = image.row(y);
    for (int x = 0; x < image.width; x += 4, rgb += 4 * size_t(image.channels)) {
      if (image.channels == 4 && rgb[3] < 128) continue;
      sum += 0.3 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2];
      ++count;
    }
  }
  return sum > light_picture * 255 * double(count);
}

using PixelLine = pair<PixelPoint, PixelPoint>;

/// The arrows of a sum of momenta, one after another. Each begins beside the tip of the one before, by a step to the
/// lower right, so that opposite arrows lie apart. The sum stands a step after the last one, and links join the ends.
struct SumLayout {
  /// `half`: of the side of the square around `middle` in which all is.
  SumLayout(const MomentumSum& sum, const PixelPoint& middle, double half, double width) {
    const PixelPoint step = 1.6 * width * PixelPoint{0.8, 1.4};
    const double steps = double(sum.parts.size());
    // The ends of the arrows, without the steps, lie within `reach` of one another.
    const double scale = max(0.0, 2 * half - 4 * width - steps * step.y) / sum.reach;  // pixels a kg m/s
    const auto way = [scale](const MomentumSum::Part& part) {
      return PixelPoint{scale * part.right, -scale * part.up};
    };

    // Around the sum of time 0 as long as that keeps all inside.
    const PixelPoint steps_way = steps * step;
    PixelPoint start = middle - 0.5 * way(sum.at_start) - 0.5 * steps_way;
    PixelPoint low = start, high = start, tip = start;
    for (const MomentumSum::Part& part : sum.parts) {
      tip = tip + way(part);
      low = {min(low.x, tip.x), min(low.y, tip.y)};
      high = {max(high.x, tip.x), max(high.y, tip.y)};
    }

    const PixelPoint end = start + way(sum.total);
    low = {min(low.x, end.x), min(low.y, end.y)};
    high = {max(high.x, end.x) + steps_way.x, max(high.y, end.y) + steps_way.y};

    const double room = half - 2 * width;
    const auto shift = [room](double least, double most, double at) {
      return max(0.0, at - room - least) - max(0.0, most - at - room);
    };
    start = start + PixelPoint{shift(low.x, high.x, middle.x), shift(low.y, high.y, middle.y)};

    tip = start;
    for (const MomentumSum::Part& part : sum.parts) {
      arrows.push_back({tip, tip + way(part)});
      links.push_back({tip + way(part), tip + way(part) + step});
      tip = links.back().second;
    }
    total = {start + steps_way, start + steps_way + way(sum.total)};
    links.push_back({start, total.first});
  }

  vector<PixelLine> arrows, links;
  PixelLine total;
};

}  // namespace

MarkPainter::MarkPainter(Size size)
    : size_(size), font_(find_font(), small_letters(size)), margin_(int(0.4 * max(size.height / 28.0, 10.0))) {}

int MarkPainter::column_width(Size size) {
  const double letters = small_letters(size);
  return int(max(bar_part * size.width + 2 * letters, panel_part * size.height) + letters);
}

void MarkPainter::draw(const Marks& marks, span<const PixelBox> taken, Image& image) {
  const bool light = !marks.labels.empty() && is_light(image);
  vector<PixelBox> full(taken.begin(), taken.end());
  if (marks.scale_bar) full.push_back(draw_bar(*marks.scale_bar, image));
  if (marks.momentum) {
    const int bottom = marks.scale_bar ? full.back().top - margin_ / 2 : size_.height - margin_;
    full.push_back(draw_sum(*marks.momentum, bottom, image));
  }

  for (const BodyLabel& label : marks.labels) {
    double widest = 0;
    for (const string& line : label.lines) widest = max(widest, font_.width(line));
    const int width = int(ceil(widest)), height = int(ceil(label_line * font_.size() * double(label.lines.size())));

    const PixelBox* best = nullptr;
    double least = infinity;
    const array<PixelBox, 8> places = places_around(label.body, width, height, label_gap * font_.size());
    for (const PixelBox& place : places) {
      const bool inside =
          place.left >= 0 && place.top >= 0 && place.left + width <= size_.width && place.top + height <= size_.height;
      if (!inside || any_of(full, [&](const PixelBox& box) { return overlap(box, place); })) continue;
      double covered = 0;
      for (const BodyBounds& body : marks.bounds) covered += shared(place, body);
      if (covered < least) least = covered, best = &place;
    }

    if (best == nullptr) continue;
    full.push_back(*best);
    draw_label(label.lines, *best, light, image);
  }
}

void MarkPainter::draw_label(const vector<string>& lines, const PixelBox& box, bool light, Image& image) {
  // Room for the outline, as far as the picture has it.
  const double wide = max(1.3, outline_width * font_.size());
  const int room = int(ceil(wide)) + 1;
  const int left = max(0, box.left - room), top = max(0, box.top - room);
  const int right = min(size_.width, box.left + box.width + room);
  const int bottom = min(size_.height, box.top + box.height + room);

  Coverage letters(right - left, bottom - top);
  double y = box.top - top + 0.92 * font_.size();
  for (const string& line : lines) {
    font_.draw(line, box.left - left + (box.width - font_.width(line)) / 2, y, letters);
    y += label_line * font_.size();
  }
  Canvas canvas(letters.width, letters.height);
  // Thin strokes of small letters cover pixels in part, and their outline as a whole.
  Coverage outline = outline_of(letters, wide);
  for (uint8_t& value : outline.values) value = uint8_t(min(255, 2 * value));
  canvas.add(outline, light ? text_color : outline_color);
  canvas.add(letters, light ? outline_color : text_color);
  canvas.lay_onto(image, left, top);
}

PixelBox MarkPainter::draw_bar(const ScaleBar& bar, Image& image) {
  const double letters = font_.size(), padding = TextBlock::padding_of(letters) + 1;
  const double width = max(bar.pixels, font_.width(bar.text)) + 2 * padding;
  const double high = max(2.0, std::round(bar_height * letters));
  const int height = int(ceil(2 * padding + label_line * letters + high + 0.2 * letters));
  PixelBox box{0, 0, int(ceil(width)), height};
  box.left = size_.width - margin_ - box.width;
  box.top = size_.height - margin_ - height;
  if (box.left < 0 || box.top < 0) return {};

  // The bar ends at a whole pixel on the right, so that its left end alone is smooth.
  Coverage ink(box.width, box.height);
  font_.draw(bar.text, (box.width - font_.width(bar.text)) / 2, padding + 0.9 * letters, ink);
  const double right = std::round((box.width + bar.pixels) / 2);
  draw_box({right - bar.pixels, height - padding - high}, {right, height - padding}, ink);
  Canvas canvas(box.width, box.height);
  canvas.add_plate(padding);
  canvas.add(ink, text_color);
  canvas.lay_onto(image, box.left, box.top);
  return box;
}

PixelBox MarkPainter::draw_sum(const MomentumSum& sum, int bottom, Image& image) {
  const double letters = font_.size(), padding = TextBlock::padding_of(letters) + 1;
  const double side = panel_part * size_.height;
  PixelBox box{0, 0, int(ceil(max(side, font_.width(sum.text) + 2 * padding))),
               int(ceil(side + 2 * label_line * letters))};
  box.left = size_.width - margin_ - box.width;
  box.top = bottom - box.height;
  if (box.left < 0 || box.top < 0) return {};
  Canvas canvas(box.width, box.height);
  canvas.add_plate(padding);

  const double width = max(1.5, letters / 6);
  const SumLayout layout(sum, {box.width / 2.0, label_line * letters + side / 2}, side / 2 - padding, width);
  const auto paint = [&](const Coverage& ink, const Color& color) {
    canvas.add(outline_of(ink, max(1.0, width / 3)), outline_color);
    canvas.add(ink, color);
  };

  // Thin lines from the ends of the bodies' arrows to those of the sum.
  Coverage lines(box.width, box.height);
  for (const auto& [from, to] : layout.links) draw_line(from, to, 1, lines);
  canvas.add(lines, Color{0.6, 0.6, 0.6});

  for (size_t i = 0; i < sum.parts.size(); ++i) {
    Coverage ink(box.width, box.height);
    draw_arrow(layout.arrows[i].first, layout.arrows[i].second, width, ink);
    paint(ink, sum.parts[i].color);
  }
  Coverage bold(box.width, box.height);
  draw_arrow(layout.total.first, layout.total.second, 1.7 * width, bold);
  draw_disc(layout.total.first, 1.2 * width, bold);
  paint(bold, text_color);

  Coverage text(box.width, box.height);
  const string title = "momentum";
  font_.draw(title, (box.width - font_.width(title)) / 2, padding + 0.9 * letters, text);
  font_.draw(sum.text, (box.width - font_.width(sum.text)) / 2, box.height - padding - 0.25 * letters, text);
  canvas.add(text, text_color);
  canvas.lay_onto(image, box.left, box.top);
  return box;
}

}  // namespace carom
