// Walks the chunks of the container (RFC 9649, 2.3 and 2.7): an ANMF chunk has the duration of its picture in ms.
// The encoder rounds each picture's time, and not its duration, so that the sum is off by at most 1 ms.
#include "export/webp.h"

#include <unistd.h>

#include "files/stored_file.h"
#include "numerics/whole.h"
#include "std.h"

namespace carom {
namespace {

constexpr uint64_t container_head = 12, chunk_head = 8, duration_at = 12;  // bytes

/// The bytes at a place, fewer at the end of the file.
template <size_t size>
string_view bytes_at(int file, uint64_t place, array<char, size>& bytes) {
  const ssize_t got = pread(file, bytes.data(), size, off_t(place));
  return {bytes.data(), size_t(got > 0 ? got : 0)};
}

/// The least significant byte first.
uint64_t little_endian(string_view bytes) {
  uint64_t number = 0;
  for (size_t i = bytes.size(); i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}

}  // namespace

optional<uint64_t> webp_frames(const FilePlace& place, const string& name, double fps) {
  const Descriptor file = open_stored(place.folder, name);
  const optional<uint64_t> size = stored_size(place.folder, name);
  if (!file || !size) return 0;

  array<char, chunk_head + 16> bytes;
  if (const string_view head = bytes_at(file.get(), 0, bytes);
      head.size() < container_head || !head.starts_with("RIFF") || head.substr(8, 4) != "WEBP")
    return 0;

  // Each chunk has a head and, after an odd number of bytes, one to fill up.
  uint64_t milliseconds = 0, animated = 0, still = 0;
  for (uint64_t at = container_head; at < *size;) {
    const string_view chunk = bytes_at(file.get(), at, bytes);
    if (chunk.size() < chunk_head) return 0;
    const string_view type = chunk.substr(0, 4);
    const uint64_t length = little_endian(chunk.substr(4, 4));
    if (length > *size - at - chunk_head) return 0;

    if (type == "ANMF" && chunk.size() == bytes.size()) {
      ++animated;
      milliseconds += little_endian(chunk.substr(chunk_head + duration_at, 3));
    }
    if (type == "VP8 " || type == "VP8L") ++still;
    at += chunk_head + length + length % 2;
  }

  if (animated == 0) return still == 1 ? nullopt : optional<uint64_t>(0);
  return uint64_t(nearest_whole(double(milliseconds) * fps / 1000));
}

}  // namespace carom
