// By ISA-L. Its reader gives the whole of a member before its checksum, so a damaged file is an error only at the end
// of the damaged member. What was read until then is not used.
#include "files/gzip.h"

#include <isa-l/igzip_lib.h>
#include <unistd.h>

#include <cerrno>

#include "numerics/processor.h"
#include "std.h"

namespace carom {
namespace {

/// Bytes of a member before compression. Larger ones are hardly smaller.
constexpr size_t member_size = size_t{256} * 1024;

constexpr size_t unpacked_size = size_t{256} * 1024;
constexpr uint8_t gzip_magic = 0x1f;  // the first byte of a member

class GzipReader {
 public:
  GzipReader(int from, int to, const FilePlace& place, const string& name)
      : from_(from), to_(to), place_(place), name_(name), in_(unpacked_size), out_(unpacked_size) {
    isal_inflate_init(&state_);
  }

  void run() {
    if (!more()) damaged();
    do member();
    while (more());
  }

 private:
  [[noreturn]] void damaged() const { fail("read", place_, name_, "it is damaged, or cut off"); }

  /// Whether there are bytes to read. Reads some where the last ones are used up.
  bool more() {
    if (state_.avail_in > 0) return true;
    ssize_t n;
    do n = read(from_, in_.data(), in_.size());
    while (n < 0 && errno == EINTR);
    if (n < 0) fail("read", place_, name_);
    state_.next_in = in_.data();
    state_.avail_in = uint32_t(n);
    return n > 0;
  }

  void member() {
    isal_inflate_reset(&state_);
    state_.crc_flag = ISAL_GZIP;
    if (state_.next_in[0] != gzip_magic) damaged();

    do {
      // A member may end with bytes that are already read.
      if (!more() && state_.avail_out > 0) damaged();
      state_.next_out = out_.data();
      state_.avail_out = uint32_t(out_.size());
      const int result = isal_inflate(&state_);
      end_wide_vectors();
      if (result != ISAL_DECOMP_OK && result != ISAL_END_INPUT) damaged();
      put(out_.size() - state_.avail_out);
    } while (state_.block_state != ISAL_BLOCK_FINISH);
  }

  void put(size_t size) const {
    for (size_t done = 0; done < size;) {
      const ssize_t n = write(to_, out_.data() + done, size - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail("unpack", place_, name_);
      done += size_t(n);
    }
  }

  const int from_, to_;
  const FilePlace& place_;
  const string& name_;
  vector<uint8_t> in_, out_;
  inflate_state state_{};
};

}  // namespace

void GzipMembers::put(string_view bytes, const Take& take) {
  packed_.resize(Deflation::most(bytes.size()));
  const size_t size = deflation_.pack({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, packed_.data(),
                                      packed_.size(), Deflation::Format::gzip);
  take({reinterpret_cast<const char*>(packed_.data()), size});
}

void GzipMembers::add(string_view bytes, const Take& take) {
  while (rest_.size() + bytes.size() >= member_size) {
    const size_t now = member_size - rest_.size();
    if (rest_.empty()) {
      put(bytes.substr(0, now), take);
    } else {
      rest_ += bytes.substr(0, now);
      put(rest_, take);
      rest_.clear();
    }
    bytes.remove_prefix(now);
  }
  rest_ += bytes;
}

void GzipMembers::end(const Take& take) {
  if (!rest_.empty()) put(rest_, take);
  rest_.clear();
}

void unpack_gzip(int from, int to, const FilePlace& place, const string& name) {
  GzipReader(from, to, place, name).run();
}

}  // namespace carom
