// Assembles the contact sheet in memory. Its layout is checked in the constructor, before the run starts.
#include "export/sheet.h"

#include "files/export_error.h"
#include "scene/sheet_layout.h"
#include "std.h"

namespace carom {
namespace {

constexpr uint8_t paper = 24;  // grey, sRGB

}  // namespace

Sheet::Sheet(const SheetOutput& sheet, Size shape) : columns_(sheet.columns), rows_(sheet.rows) {
  if (columns_ < 1 || rows_ < 1) throw ExportError("cannot make a contact sheet without pictures");
  if (const optional<SheetProblem> problem = problem_of(sheet, shape))
    throw ExportError("cannot make sheet.png: " + problem->message + "\n  " + problem->remedy);
  const SheetLayout layout = layout_of(sheet, shape);
  picture_ = {int(layout.width), int(layout.height)};
  whole_ = {int(layout.total_width), int(layout.total_height)};
  // What the division left over goes to both sides.
  const auto margin = [](int64_t total, int64_t count, int64_t side) {
    return int((total - count * side - (count - 1) * sheet_gap) / 2);
  };
  margin_ = {margin(layout.total_width, columns_, layout.width), margin(layout.total_height, rows_, layout.height)};
}

void Sheet::prepare(int channels) {
  if (!image_.pixels.empty()) return;
  image_.width = whole_.width;
  image_.height = whole_.height;
  image_.channels = channels;
  image_.pixels.assign(size_t(whole_.height) * image_.row_size(), channels == 4 ? 0 : paper);
}

void Sheet::put(int64_t number, const Image& picture) {
  if (number < 0 || number >= count() || picture.width != picture_.width || picture.height != picture_.height ||
      (!image_.pixels.empty() && picture.channels != image_.channels))
    throw ExportError("cannot put a picture into the contact sheet: it is of another size or number");
  prepare(picture.channels);
  const int left = margin_.width + int(number % columns_) * (picture_.width + sheet_gap);
  const int top = margin_.height + int(number / columns_) * (picture_.height + sheet_gap);
  for (int y = 0; y < picture.height; ++y) {
    const auto at = size_t(top + y) * image_.row_size() + size_t(left * image_.channels);
    std::copy_n(picture.row(y), picture.row_size(), image_.pixels.data() + at);
  }
}

const Image& Sheet::image() {
  prepare(3);
  return image_;
}

}  // namespace carom
