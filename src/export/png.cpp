// Writes PNG (ISO/IEC 15948) by the filter `sub`: a pixel becomes its difference to the one on its left.
// Of the five filters it gives the smallest files of rendered pictures, and a loop that compilers turn into vectors.
#include "export/png.h"

#include <isa-l/crc.h>

#include "files/export_error.h"
#include "std.h"

namespace carom {
namespace {

constexpr uint8_t filter_sub = 1;

void put_number(string& file, uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) file += char(number >> shift & 255);
}

/// A chunk: the length of its data, its type, the data that `put_data` appends, and the checksum of both.
template <typename Data>
void put_chunk(string& file, string_view type, const Data& put_data) {
  const size_t begin = file.size();
  put_number(file, 0);
  file += type;
  put_data();
  const size_t length = file.size() - begin - 8;
  string number;
  put_number(number, uint32_t(length));
  file.replace(begin, number.size(), number);
  put_number(file, crc32_gzip_refl(0, reinterpret_cast<const uint8_t*>(file.data()) + begin + 4, length + 4));
}

/// The row's difference to itself, moved by one pixel. `to` is another memory.
void filter_row(const uint8_t* row, size_t size, size_t pixel, uint8_t* __restrict to) {
  constexpr size_t block = 16;  // a number that compilers see, for vectors
  to = std::copy_n(row, pixel, to);
  const uint8_t* left = row;
  row += pixel;
  for (size -= pixel; size >= block; size -= block, row += block, left += block, to += block)
    for (size_t i = 0; i < block; ++i) to[i] = uint8_t(row[i] - left[i]);
  for (size_t i = 0; i < size; ++i) to[i] = uint8_t(row[i] - left[i]);
}

}  // namespace

void PngEncoder::take(const Image& image) {
  if (!image.is_whole()) throw ExportError("cannot write a picture: its size does not fit its pixels");
  width_ = image.width;
  height_ = image.height;
  channels_ = image.channels;
  const size_t size = image.row_size();
  rows_.resize((size + 1) * size_t(height_));
  uint8_t* to = rows_.data();
  for (int y = 0; y < height_; ++y, to += size) {
    *to++ = filter_sub;
    filter_row(image.row(y), size, size_t(channels_), to);
  }
}

size_t PngEncoder::compress() {
  // Not the room that is left of a larger picture: the bytes may depend on this size.
  const size_t most = Deflation::most(rows_.size());
  if (most > room_size_) {
    room_ = std::make_unique_for_overwrite<uint8_t[]>(most);
    room_size_ = most;
  }
  const size_t size = deflation_.pack(rows_, room_.get(), most, Deflation::Format::zlib);
  if (size == 0) throw ExportError("cannot compress a picture");
  return size;
}

const string& PngEncoder::encode() {
  file_ = "\x89PNG\r\n\x1a\n";
  put_chunk(file_, "IHDR", [&] {
    put_number(file_, uint32_t(width_));
    put_number(file_, uint32_t(height_));
    file_ += '\x08';                            // bits a channel
    file_ += channels_ == 4 ? '\x06' : '\x02';  // RGBA, RGB
    file_ += string_view("\0\0\0", 3);          // deflate, the five filters, rows in order
  });

  put_chunk(file_, "sRGB", [&] { file_ += '\0'; });  // perceptual

  put_chunk(file_, "IDAT", [&] {
    const size_t size = compress();
    file_.append(reinterpret_cast<const char*>(room_.get()), size);
  });
  put_chunk(file_, "IEND", [] {});
  return file_;
}

string encode_png(const Image& image) {
  PngEncoder encoder;
  encoder.take(image);
  return encoder.encode();
}

}  // namespace carom
