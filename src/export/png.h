#pragma once
// Pictures as PNG.
#include <cstdint>
#include <string>
#include <vector>

#include "export/deflate.h"
#include "render/image.h"

namespace carom {

/// Makes PNG files of 8 bits a channel, RGB or RGBA, marked as sRGB. The same picture gives the same bytes everywhere.
class PngEncoder {
 public:
  /// Copies a picture, so that encode() may follow on another thread. Throws ExportError.
  void take(const Image& image);
  /// Encodes the picture taken. The text of the file is valid until the next call.
  const std::string& encode();
  /// The file of the last encode().
  const std::string& file() const { return file_; }

 private:
  int width_ = 0, height_ = 0, channels_ = 0;
  std::vector<std::uint8_t> rows_;  // filtered
  Deflater deflater_;
  std::string file_;
};

/// A single picture. Throws ExportError.
std::string encode_png(const Image& image);

}  // namespace carom
