#pragma once
// Pictures as PNG.

#include "files/deflation.h"
#include "render/image.h"
#include "std.h"

namespace carom {

/// Makes PNG files of 8 bits a channel, RGB or RGBA, marked as sRGB.
/// The same picture gives the same bytes on all x86-64 processors with SSE4.2.
class PngEncoder {
 public:
  /// Copies a picture, so that encode() may follow on another thread. Throws ExportError.
  void take(const Image& image);
  /// Encodes the picture taken. The text of the file is valid until the next call.
  const string& encode();
  /// The file of the last encode().
  const string& file() const { return file_; }

 private:
  /// Makes a zlib stream (RFC 1950) of the rows, and gives its size.
  size_t compress();

  int width_ = 0, height_ = 0, channels_ = 0;
  vector<uint8_t> rows_;  // filtered
  Deflation deflation_;
  unique_ptr<uint8_t[]> room_;  // for the largest stream of so many rows
  size_t room_size_ = 0;        // bytes
  string file_;
};

/// A single picture. Throws ExportError.
string encode_png(const Image& image);

}  // namespace carom
