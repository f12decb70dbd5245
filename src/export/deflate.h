#pragma once
// Compression of filtered pictures, fast and with the same bytes on every machine.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "export/deflate_block.h"

namespace carom {

class Deflater {
 public:
  Deflater();

  /// Appends `bytes`, less than 2 GiB, to `out` as a zlib stream (RFC 1950). `pixel`: bytes of a pixel, from 1 to 8.
  void compress(std::span<const std::uint8_t> bytes, std::size_t pixel, std::string& out);

 private:
  std::vector<std::uint32_t> places_;  // where 8 bytes with each hash were last
  DeflateBlock block_;
};

}  // namespace carom
