// Assembles the contact sheet in memory. Its size is checked in the constructor, before the run starts.
#include "export/sheet.h"

#include <algorithm>
#include <cmath>

#include "files/run_folder.h"

namespace carom {
namespace {

constexpr int gap = 8;                             // pixels between the pictures and around them
constexpr int whole_width = 1920;                  // pixels, target
constexpr int most_width = 480;                    // pixels, of one picture
constexpr int least_width = 32;                    // pixels, of one picture; nothing is recognisable below
constexpr std::int64_t most_pixels = 100'000'000;  // 300 MB in memory
constexpr std::uint8_t paper = 24;                 // grey, sRGB

}  // namespace

Sheet::Sheet(const SheetOutput& sheet, Size shape) : columns_(sheet.columns), rows_(sheet.rows) {
  const std::int64_t columns = sheet.columns, rows = sheet.rows;
  const std::int64_t width = std::clamp<std::int64_t>(
      (whole_width - gap * (columns + 1)) / std::max<std::int64_t>(columns, 1), least_width, most_width);
  const double exact_height = static_cast<double>(width) * shape.height / std::max(shape.width, 1);
  const std::int64_t height = std::max<std::int64_t>(std::llround(std::min(exact_height, 1e6)), 1);
  const std::int64_t total_width = columns * (width + gap) + gap, total_height = rows * (height + gap) + gap;
  if (columns < 1 || rows < 1 || total_height > most_pixels || total_width * total_height > most_pixels)
    throw ExportError("cannot make a contact sheet of " + std::to_string(columns) + " x " + std::to_string(rows) +
                      " pictures: it would have " + std::to_string(total_width) + " x " + std::to_string(total_height) +
                      " pixels; use fewer columns or rows");
  picture_ = {static_cast<int>(width), static_cast<int>(height)};
  whole_ = {static_cast<int>(total_width), static_cast<int>(total_height)};
}

void Sheet::prepare(bool transparent) {
  if (!image_.pixels.empty()) return;
  image_.width = whole_.width;
  image_.height = whole_.height;
  image_.pixels.assign(static_cast<std::size_t>(whole_.width) * static_cast<std::size_t>(whole_.height) * 3, paper);
  if (transparent) image_.alpha.assign(image_.pixels.size() / 3, 0);
}

void Sheet::put(std::int64_t number, const Image& picture) {
  if (number < 0 || number >= count() || picture.width != picture_.width || picture.height != picture_.height)
    throw ExportError("cannot put a picture into the contact sheet: it is of another size or number");
  prepare(!picture.alpha.empty());
  const std::int64_t left = gap + number % columns_ * (picture_.width + gap);
  const std::int64_t top = gap + number / columns_ * (picture_.height + gap);
  const auto width = static_cast<std::size_t>(picture.width);
  for (int y = 0; y < picture.height; ++y) {
    const std::int64_t at = (top + y) * whole_.width + left;
    std::copy_n(picture.row(y), 3 * width, image_.pixels.begin() + at * 3);
    if (!image_.alpha.empty() && !picture.alpha.empty())
      std::copy_n(picture.alpha.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * width), width,
                  image_.alpha.begin() + at);
  }
}

const Image& Sheet::image() {
  prepare(false);
  return image_;
}

}  // namespace carom
