// By ISA-L. Its bytes are the same with SSE4.2, AVX2 and AVX-512, by its functions for each of them. Without SSE4.2,
// and on arm64, it has other functions, and so other bytes. The first bytes are compressed by themselves: its function
// for many bytes (2.30, `.write_first_byte` of igzip_icf_body_h1_gr_bt.asm) takes the hash of the third byte of all
// from what a register was left with, the address of its state.
#include "files/deflation.h"

#include <isa-l/igzip_lib.h>

#include "numerics/processor.h"
#include "std.h"

namespace carom {
namespace {

/// Those that are left to ISA-L's function for few bytes.
constexpr size_t first = 16;

}  // namespace

size_t Deflation::most(size_t size) {
  // Bytes that do not shrink are stored, in blocks of up to 65535 with 5 more each. The first ones have their own.
  constexpr size_t block = 65535, block_head = 5, head_and_checksum = 18, block_of_first = 2 * first;
  return size + block_head * (size / block + 1) + block_of_first + head_and_checksum;
}

size_t Deflation::pack(span<const uint8_t> bytes, uint8_t* to, size_t room, Format format) {
  work_.resize(ISAL_DEF_LVL1_DEFAULT);
  isal_zstream stream;
  isal_deflate_init(&stream);
  // The largest window. ISA-L 2.30 initialises all but this.
  stream.hist_bits = 0;
  stream.level = 1;
  stream.level_buf = work_.data();
  stream.level_buf_size = uint32_t(work_.size());
  stream.gzip_flag = format == Format::zlib ? IGZIP_ZLIB : format == Format::gzip ? IGZIP_GZIP : IGZIP_DEFLATE;
  stream.next_in = const_cast<uint8_t*>(bytes.data());
  stream.next_out = to;
  stream.avail_out = uint32_t(room);

  // First the first bytes.
  const size_t few = min(first, bytes.size());
  stream.avail_in = uint32_t(few);
  stream.flush = SYNC_FLUSH;
  bool packed = isal_deflate(&stream) == COMP_OK;

  // Then the others.
  stream.avail_in += uint32_t(bytes.size() - few);
  stream.flush = NO_FLUSH;
  stream.end_of_stream = 1;
  packed = packed && isal_deflate(&stream) == COMP_OK && stream.internal_state.state == ZSTATE_END;

  // ISA-L 2.30 does not. Without it the next picture of 100,000 balls takes a tenth longer to draw.
  end_wide_vectors();
  return packed ? stream.total_out : 0;
}

}  // namespace carom
