#pragma once
// Compression by deflate (RFC 1951).

#include "std.h"

namespace carom {

/// Compresses bytes quickly, one text after another. The same bytes give the same ones on all x86-64 processors with
/// SSE4.2, wherever they are in memory.
class Deflation {
 public:
  enum class Format { plain, zlib, gzip };  // RFC 1951, RFC 1950, RFC 1952

  /// The most bytes that so many become.
  static size_t most(size_t size);
  /// Writes the compressed bytes to `to`, which has `room` bytes, and gives their number. 0: they have no room. The
  /// result may depend on `room`.
  size_t pack(span<const uint8_t> bytes, uint8_t* to, size_t room, Format format);

 private:
  vector<uint8_t> work_;
};

}  // namespace carom
