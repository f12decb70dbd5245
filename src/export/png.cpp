// Writes PNG (ISO/IEC 15948) by the filter `sub`: a pixel becomes its difference to the one on its left.
// Of the five filters it gives the smallest files of rendered pictures, and a loop that compilers turn into vectors.
//
// ISA-L compresses. Its bytes are the same with SSE4.2, AVX2 and AVX-512, by its functions for each of them. Without
// SSE4.2 it has another hash, and so other bytes. The first bytes are compressed by themselves: its function for many
// bytes (2.30, `.write_first_byte` of igzip_icf_body_h1_gr_bt.asm) takes the hash of the third byte of all from what a
// register was left with, the address of its state.
#include "export/png.h"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <string_view>

#include "files/run_folder.h"
#include "numerics/processor.h"

namespace carom {
namespace {

constexpr std::uint8_t filter_sub = 1;

void put_number(std::string& file, std::uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) file += static_cast<char>(number >> shift & 255);
}

/// A chunk: the length of its data, its type, the data that `put_data` appends, and the checksum of both.
template <typename Data>
void put_chunk(std::string& file, std::string_view type, const Data& put_data) {
  const std::size_t begin = file.size();
  put_number(file, 0);
  file += type;
  put_data();
  const std::size_t length = file.size() - begin - 8;
  std::string number;
  put_number(number, static_cast<std::uint32_t>(length));
  file.replace(begin, number.size(), number);
  put_number(file, crc32_gzip_refl(0, reinterpret_cast<const std::uint8_t*>(file.data()) + begin + 4, length + 4));
}

/// The row's difference to itself, moved by one pixel. `to` is another memory.
void filter_row(const std::uint8_t* row, std::size_t size, std::size_t pixel, std::uint8_t* __restrict to) {
  constexpr std::size_t block = 16;  // a number that compilers see, for vectors
  to = std::copy_n(row, pixel, to);
  const std::uint8_t* left = row;
  row += pixel;
  for (size -= pixel; size >= block; size -= block, row += block, left += block, to += block)
    for (std::size_t i = 0; i < block; ++i) to[i] = static_cast<std::uint8_t>(row[i] - left[i]);
  for (std::size_t i = 0; i < size; ++i) to[i] = static_cast<std::uint8_t>(row[i] - left[i]);
}

}  // namespace

void PngEncoder::take(const Image& image) {
  if (!image.is_whole()) throw ExportError("cannot write a picture: its size does not fit its pixels");
  width_ = image.width;
  height_ = image.height;
  channels_ = image.channels;
  const std::size_t size = image.row_size();
  rows_.resize((size + 1) * static_cast<std::size_t>(height_));
  std::uint8_t* to = rows_.data();
  for (int y = 0; y < height_; ++y, to += size) {
    *to++ = filter_sub;
    filter_row(image.row(y), size, static_cast<std::size_t>(channels_), to);
  }
}

std::size_t PngEncoder::compress() {
  // Rows that do not shrink are stored, in blocks of up to 65535 bytes with 5 more each.
  constexpr std::size_t block = 65535, block_head = 5, head_and_checksum = 6;
  // Those that are left to ISA-L's function for few bytes, and what their own block takes at most.
  constexpr std::size_t first = 16, block_of_first = 2 * first;
  const std::size_t most = rows_.size() + block_head * (rows_.size() / block + 1) + block_of_first + head_and_checksum;
  if (most > room_size_) {
    room_ = std::make_unique_for_overwrite<std::uint8_t[]>(most);
    room_size_ = most;
  }
  work_.resize(ISAL_DEF_LVL1_DEFAULT);
  isal_zstream stream;
  isal_deflate_init(&stream);
  // The largest window. ISA-L 2.30 initialises all but this.
  stream.hist_bits = 0;
  stream.level = 1;
  stream.level_buf = work_.data();
  stream.level_buf_size = static_cast<std::uint32_t>(work_.size());
  stream.gzip_flag = IGZIP_ZLIB;
  stream.next_in = rows_.data();
  stream.next_out = room_.get();
  // Not the room that is left of a larger picture: the bytes may depend on this size.
  stream.avail_out = static_cast<std::uint32_t>(most);

  // First the first bytes.
  const std::size_t few = std::min(first, rows_.size());
  stream.avail_in = static_cast<std::uint32_t>(few);
  stream.flush = SYNC_FLUSH;
  bool packed = isal_deflate(&stream) == COMP_OK;

  // Then the others.
  stream.avail_in = static_cast<std::uint32_t>(rows_.size() - few);
  stream.flush = NO_FLUSH;
  stream.end_of_stream = 1;
  packed = packed && isal_deflate(&stream) == COMP_OK && stream.internal_state.state == ZSTATE_END;
  if (!packed) throw ExportError("cannot compress a picture");
  return stream.total_out;
}

const std::string& PngEncoder::encode() {
  file_ = "\x89PNG\r\n\x1a\n";
  put_chunk(file_, "IHDR", [&] {
    put_number(file_, static_cast<std::uint32_t>(width_));
    put_number(file_, static_cast<std::uint32_t>(height_));
    file_ += '\x08';                            // bits a channel
    file_ += channels_ == 4 ? '\x06' : '\x02';  // RGBA, RGB
    file_ += std::string_view("\0\0\0", 3);     // deflate, the five filters, rows in order
  });
  put_chunk(file_, "sRGB", [&] { file_ += '\0'; });  // perceptual
  put_chunk(file_, "IDAT", [&] {
    const std::size_t size = compress();
    file_.append(reinterpret_cast<const char*>(room_.get()), size);
  });
  put_chunk(file_, "IEND", [] {});
  // ISA-L 2.30 does not. Without it the next picture of 100,000 balls takes a tenth longer to draw.
  end_wide_vectors();
  return file_;
}

std::string encode_png(const Image& image) {
  PngEncoder encoder;
  encoder.take(image);
  return encoder.encode();
}

}  // namespace carom
