#pragma once
// sheet.png: a contact sheet of pictures at evenly spaced instants of the run.
#include <cstdint>

#include "render/image.h"
#include "scene/output.h"

namespace carom {

class Sheet {
 public:
  /// Pictures with the aspect ratio of `shape`.
  /// A row of them is up to 1920 pixels wide, and each is at most 480 pixels wide.
  /// Throws ExportError if the sheet would be too large.
  Sheet(const SheetOutput& sheet, Size shape);

  Size picture_size() const { return picture_; }
  std::int64_t count() const { return std::int64_t{columns_} * rows_; }
  /// Copies picture `number` to its place. Numbers run row by row, from the left.
  void put(std::int64_t number, const Image& picture);
  /// Where the pictures have opacity, the space between them is transparent.
  const Image& image();

 private:
  void prepare(bool transparent);

  int columns_, rows_;
  Size picture_, whole_;
  Image image_;  // allocated at the first picture
};

}  // namespace carom
