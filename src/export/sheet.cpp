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

std::int64_t with_gaps(std::int64_t count, std::int64_t side) {
  return count * (side + gap) + gap;
}

/// The side of a picture if `count` of them and the gaps fill `whole` as far as possible.
std::int64_t side_within(std::int64_t whole, std::int64_t count) {
  return (whole - gap * (count + 1)) / std::max<std::int64_t>(count, 1);
}

[[noreturn]] void refuse(const SheetOutput& sheet, const std::string& why) {
  throw ExportError("cannot make a contact sheet of " + std::to_string(sheet.columns) + " x " +
                    std::to_string(sheet.rows) + " pictures: " + why + "; use fewer columns or rows");
}

}  // namespace

Sheet::Sheet(const SheetOutput& sheet, Size shape) : columns_(sheet.columns), rows_(sheet.rows) {
  const std::int64_t columns = sheet.columns, rows = sheet.rows;
  std::int64_t width = 0, height = 0, total_width = 0, total_height = 0;
  if (sheet.size) {
    total_width = sheet.size->width;
    total_height = sheet.size->height;
    width = side_within(total_width, columns);
    height = side_within(total_height, rows);
    if (std::min(width, height) < least_width)
      refuse(sheet, "each would have " + std::to_string(std::max<std::int64_t>(width, 0)) + " x " +
                        std::to_string(std::max<std::int64_t>(height, 0)) + " pixels");
  } else {
    width = std::clamp<std::int64_t>(side_within(whole_width, columns), least_width, most_width);
    const double exact_height = static_cast<double>(width) * shape.height / std::max(shape.width, 1);
    height = std::max<std::int64_t>(std::llround(std::min(exact_height, 1e6)), 1);
    total_width = with_gaps(columns, width);
    total_height = with_gaps(rows, height);
  }
  if (columns < 1 || rows < 1 || total_height > most_pixels || total_width * total_height > most_pixels)
    refuse(sheet, "it would have " + std::to_string(total_width) + " x " + std::to_string(total_height) + " pixels");
  picture_ = {static_cast<int>(width), static_cast<int>(height)};
  whole_ = {static_cast<int>(total_width), static_cast<int>(total_height)};
  // What the division left over goes to both sides.
  margin_ = {static_cast<int>(gap + (total_width - with_gaps(columns, width)) / 2),
             static_cast<int>(gap + (total_height - with_gaps(rows, height)) / 2)};
}

void Sheet::prepare(int channels) {
  if (!image_.pixels.empty()) return;
  image_.width = whole_.width;
  image_.height = whole_.height;
  image_.channels = channels;
  image_.pixels.assign(static_cast<std::size_t>(whole_.height) * image_.row_size(), channels == 4 ? 0 : paper);
}

void Sheet::put(std::int64_t number, const Image& picture) {
  if (number < 0 || number >= count() || picture.width != picture_.width || picture.height != picture_.height ||
      (!image_.pixels.empty() && picture.channels != image_.channels))
    throw ExportError("cannot put a picture into the contact sheet: it is of another size or number");
  prepare(picture.channels);
  const int left = margin_.width + static_cast<int>(number % columns_) * (picture_.width + gap);
  const int top = margin_.height + static_cast<int>(number / columns_) * (picture_.height + gap);
  for (int y = 0; y < picture.height; ++y) {
    const auto at =
        static_cast<std::size_t>(top + y) * image_.row_size() + static_cast<std::size_t>(left * image_.channels);
    std::copy_n(picture.row(y), picture.row_size(), image_.pixels.data() + at);
  }
}

const Image& Sheet::image() {
  prepare(3);
  return image_;
}

}  // namespace carom
