#pragma once
// sheet.png: a contact sheet of pictures at evenly spaced instants of the run.

#include "render/image.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

class Sheet {
 public:
  /// A sheet of the size that `sheet` gives, whose pictures fill it.
  /// Otherwise pictures with the aspect ratio of `shape`, each at most 480 pixels wide, and a row of them up to 1920.
  /// Throws ExportError if the sheet would be too large, or its pictures too small.
  Sheet(const SheetOutput& sheet, Size shape);

  Size picture_size() const { return picture_; }
  int64_t count() const { return int64_t{columns_} * rows_; }
  /// Copies picture `number` to its place. Numbers run row by row, from the left.
  void put(int64_t number, const Image& picture);
  const Image& image();

 private:
  void prepare(int channels);

  int columns_, rows_;
  Size picture_, whole_;
  Size margin_;  // left of the pictures and above them, pixels
  Image image_;  // allocated at the first picture
};

}  // namespace carom
