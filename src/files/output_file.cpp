// Buffers writes in pieces, and hashes and writes each piece on a background thread of long files.
// The data is hashed on the way, so that it never has to be read back.
#include "files/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "files/folder_names.h"
#include "physics/archive.h"
#include "std.h"

namespace carom {
namespace {

/// Large enough to make system calls negligible, and small enough to stay in cache during hashing.
constexpr size_t least_block = size_t{256} * 1024;

/// The number of pieces after which a file starts a thread.
constexpr uint64_t pieces_alone = 8;

/// The number of bytes after which the system is requested to begin writing to disk.
/// The sync at the end then has little left to do.
constexpr uint64_t early_size = uint64_t{32} * 1024 * 1024;

}  // namespace

OutputFile::OutputFile(const FilePlace& place, string name)
    : PartFile(place, std::move(name)),
      has_name_(true),
      pieces_([this](const Piece& piece) { put(piece); }, pieces_alone) {
  open_part();
}

OutputFile::OutputFile(const FilePlace& place, string name, CsvDialect dialect) : OutputFile(place, std::move(name)) {
  dialect_ = dialect;
  if (record_.name.ends_with(gzip_ending)) gzip_.emplace();
}

void OutputFile::open_part() {
  // What an interrupted run has left is no link, and has no other name.
  struct stat info {};
  if (place_.goes_on && fstatat(place_.folder, part().c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0) {
    if (S_ISREG(info.st_mode) && info.st_nlink == 1) {
      hand_over();
      file_ = Descriptor(openat(place_.folder, part().c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC));
      if (!file_) fail("write", place_, record_.name);
      return;
    }
    remove_entry(place_, part());
  }

  file_ = Descriptor(openat(place_.folder, part().c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!file_) fail("write", place_, record_.name);
}

OutputFile::OutputFile(const FilePlace& place, Descriptor nameless)
    : PartFile(place),
      file_(std::move(nameless)),
      has_name_(false),
      pieces_([this](const Piece& piece) { put(piece); }, pieces_alone) {}

void OutputFile::write(string_view bytes) {
  while (used_ + bytes.size() > size_) {
    if (used_ == size_) make_room(1);
    const size_t now = min(bytes.size(), size_ - used_);
    std::memcpy(data_ + used_, bytes.data(), now);
    used_ += now;
    bytes.remove_prefix(now);
  }
  if (bytes.empty()) return;
  std::memcpy(data_ + used_, bytes.data(), bytes.size());
  used_ += bytes.size();
}

void OutputFile::make_room(size_t size) {
  flush();
  vector<char>& bytes = pieces_.item().bytes;
  if (bytes.size() < size) bytes.resize(max(size, least_block));
  data_ = bytes.data();
  size_ = bytes.size();
}

void OutputFile::flush() {
  if (used_ == 0) return;
  pieces_.item().used = used_;
  used_ = 0;
  size_ = 0;
  pieces_.send();
}

void OutputFile::put(const Piece& piece) {
  const string_view bytes(piece.bytes.data(), piece.used);
  if (gzip_)
    gzip_->add(bytes, [this](string_view packed) { put_bytes(packed); });
  else
    put_bytes(bytes);
}

void OutputFile::put_bytes(string_view bytes) {
  if (has_name_) hash_.add(bytes);
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(file_.get(), bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("write", place_, record_.name);
    done += size_t(n);
  }

  record_.bytes += bytes.size();
  if (const uint64_t more = record_.bytes - on_the_way_; more >= early_size) {
    // If the file system does not support this, the sync at the end does all of it.
    sync_file_range(file_.get(), off_t(on_the_way_), off_t(more), SYNC_FILE_RANGE_WRITE);
    on_the_way_ = record_.bytes;
  }
}

void OutputFile::drain() {
  flush();
  pieces_.finish();
}

WrittenPart OutputFile::pause() {
  drain();
  hand_over();
  return {record_.bytes, Sha256(hash_).hex(), gzip_ ? gzip_->rest() : string()};
}

void OutputFile::go_on(const WrittenPart& part) {
  used_ = 0;
  size_ = 0;
  pieces_.finish();
  hash_ = {};

  // Hash what is there.
  vector<char> buffer(least_block);
  for (record_.bytes = 0; record_.bytes < part.bytes;) {
    const size_t most = min<uint64_t>(buffer.size(), part.bytes - record_.bytes);
    const ssize_t n = pread(file_.get(), buffer.data(), most, off_t(record_.bytes));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", place_, record_.name);
    if (n == 0) throw ArchiveError();
    hash_.add({buffer.data(), size_t(n)});
    record_.bytes += size_t(n);
  }
  if (Sha256(hash_).hex() != part.sha256) throw ArchiveError();
  if (gzip_) gzip_->set_rest(part.rest);

  on_the_way_ = record_.bytes;
  if (lseek(file_.get(), off_t(record_.bytes), SEEK_SET) < 0) fail("write", place_, record_.name);
}

void OutputFile::complete() {
  if (!file_) return;
  drain();
  if (gzip_) gzip_->end([this](string_view packed) { put_bytes(packed); });
  if (!has_name_) return;
  // An interrupted run may have written more.
  if (place_.goes_on && ftruncate(file_.get(), off_t(record_.bytes)) != 0) fail("write", place_, record_.name);
  record_.sha256 = hash_.hex();
  // Some file systems report a full disk only here.
  if (close(file_.release()) != 0) fail("write", place_, record_.name);
}

Descriptor OutputFile::reopened() {
  complete();
  Descriptor opened(has_name_ ? openat(place_.folder, part().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)
                              : open(fmt::format("/proc/self/fd/{}", file_.get()).c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened) fail("read", place_, record_.name);
  return opened;
}

void OutputFile::publish() {
  complete();
  PartFile::publish();
}

}  // namespace carom
