#pragma once
// Pictures as PNG.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "export/deflation.h"
#include "render/image.h"

namespace carom {

/// Makes PNG files of 8 bits a channel, RGB or RGBA, marked as sRGB.
/// The same picture gives the same bytes on all x86-64 processors with SSE4.2.
class PngEncoder {
 public:
  /// Copies a picture, so that encode() may follow on another thread. Throws ExportError.
  void take(const Image& image);
  /// Encodes the picture taken. The text of the file is valid until the next call.
  const std::string& encode();
  /// The file of the last encode().
  const std::string& file() const { return file_; }

 private:
  /// Makes a zlib stream (RFC 1950) of the rows, and gives its size.
  std::size_t compress();

  int width_ = 0, height_ = 0, channels_ = 0;
  std::vector<std::uint8_t> rows_;  // filtered
  Deflation deflation_;
  std::unique_ptr<std::uint8_t[]> room_;  // for the largest stream of so many rows
  std::size_t room_size_ = 0;             // bytes
  std::string file_;
};

/// A single picture. Throws ExportError.
std::string encode_png(const Image& image);

}  // namespace carom
