#pragma once
// sheet.png: a contact sheet, pictures at even instants of the run side by side.
#include <cstdint>

#include "render/image.h"
#include "scene/output.h"

namespace carom {

class Sheet {
 public:
  /// Pictures of the shape of `shape`, as large as lets a row of them be 1920 pixels wide, at most 480 wide each.
  /// Throws ExportError if the sheet would be too large.
  Sheet(const SheetOutput& sheet, Size shape);

  Size picture_size() const { return picture_; }
  std::int64_t count() const { return std::int64_t{columns_} * rows_; }
  /// Puts picture `number` (row by row, from the left) into its place.
  void put(std::int64_t number, const Image& picture);
  const Image& image();

 private:
  void prepare();

  int columns_, rows_;
  Size picture_, whole_;
  Image image_;  // made with the first picture
};

}  // namespace carom
