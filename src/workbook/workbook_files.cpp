// lxw_tmpfile is the only function of the library that makes temporary files.
// By the rules of shared libraries, a function of that name in the program replaces it.
// check_archive() detects the case in which it does not.
#include "workbook/workbook_files.h"

#include <fmt/format.h>
#include <minizip/unzip.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <tuple>

#include "files/run_folder.h"
#include "std.h"

namespace carom {
namespace {

using File = WorkbookFiles::File;

WorkbookFiles* current = nullptr;

function<void()>& stop_check() {
  static function<void()> function = [] {};
  return function;
}

ssize_t failed() {
  current->record_error(errno);
  return -1;
}

// The callbacks of stdio.

ssize_t read_file(void* cookie, char* to, size_t size) {
  File& file = *static_cast<File*>(cookie);
  // The library, which is C, ends with an error.
  if (!current->goes_on()) return -1;
  ssize_t n;
  do n = pread(file.descriptor.get(), to, size, off_t(file.at));
  while (n < 0 && errno == EINTR);
  if (n < 0) return failed();
  const uint64_t expected = min<uint64_t>(size, file.size - min(file.at, file.size));
  if (n == 0 && expected > 0) {
    // The file has become shorter.
    errno = EIO;
    return failed();
  }
  file.at += uint64_t(n);
  return n;
}

ssize_t write_file(void* cookie, const char* from, size_t size) {
  File& file = *static_cast<File*>(cookie);
  if (file.at != file.size) {
    // All writing is sequential.
    errno = ESPIPE;
    failed();
    return 0;
  }

  for (size_t done = 0; done < size;) {
    const ssize_t n = pwrite(file.descriptor.get(), from + done, size - done, off_t(file.size + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      failed();
      return 0;
    }
    done += size_t(n);
  }

  file.crc = uint32_t(crc32(file.crc, reinterpret_cast<const unsigned char*>(from), unsigned(size)));
  file.at = file.size += size;
  return ssize_t(size);
}

int seek_file(void* cookie, off64_t* offset, int whence) {
  File& file = *static_cast<File*>(cookie);
  const auto from = static_cast<off64_t>(whence == SEEK_CUR ? file.at : whence == SEEK_END ? file.size : 0);
  if (from + *offset < 0) return -1;
  *offset += from;
  file.at = uint64_t(*offset);
  return 0;
}

int close_file(void* cookie) {
  File& file = *static_cast<File*>(cookie);
  file.descriptor.reset();
  file.stream = nullptr;
  return 0;
}

/// The properties of an archive's entry that are compared with what was written.
struct Entry {
  uint64_t size;
  uint32_t crc;
  friend bool operator<(const Entry& a, const Entry& b) { return tie(a.size, a.crc) < tie(b.size, b.crc); }
  friend bool operator==(const Entry& a, const Entry& b) = default;
};

/// All entries of an archive, each read to its end. `whole` becomes false if one cannot be read.
vector<Entry> entries_of(const string& path, bool& whole) {
  vector<Entry> entries;
  const unzFile archive = unzOpen64(path.c_str());
  whole = archive != nullptr;
  if (!whole) return entries;

  unz_global_info64 all{};
  whole = unzGetGlobalInfo64(archive, &all) == UNZ_OK;
  vector<char> piece(size_t{64} * 1024);
  int code = unzGoToFirstFile(archive);

  for (; whole && code == UNZ_OK; code = unzGoToNextFile(archive)) {
    unz_file_info64 info{};
    whole = unzGetCurrentFileInfo64(archive, &info, nullptr, 0, nullptr, 0, nullptr, 0) == UNZ_OK &&
            unzOpenCurrentFile(archive) == UNZ_OK;
    if (!whole) break;

    int n;
    while ((n = unzReadCurrentFile(archive, piece.data(), unsigned(piece.size()))) > 0) {
    }
    // Closing compares the bytes with the entry's checksum.
    whole = unzCloseCurrentFile(archive) == UNZ_OK && n == 0;
    entries.push_back({info.uncompressed_size, uint32_t(info.crc)});
  }

  whole = whole && code == UNZ_END_OF_LIST_OF_FILE && entries.size() == all.number_entry;
  unzClose(archive);
  return entries;
}

/// Whether an archive's last record ends the file. minizip accepts an archive that is cut within that record.
bool ends_whole(int archive) {
  constexpr string_view signature = "PK\x05\x06";
  // Bytes, without a comment.
  constexpr off_t record = 22;
  char begin[signature.size()] = {};
  const off_t size = lseek(archive, 0, SEEK_END);
  return size >= record && pread(archive, begin, sizeof begin, size - record) == ssize_t(sizeof begin) &&
         string_view(begin, sizeof begin) == signature;
}

}  // namespace

void check_while_packing(function<void()> function) {
  stop_check() = std::move(function);
}

void check_packing() {
  stop_check()();
}

WorkbookFiles::WorkbookFiles(const FilePlace& place, string name) : place_(place), name_(std::move(name)) {
  current = this;
}

WorkbookFiles::~WorkbookFiles() {
  // The library leaves files open if a workbook is abandoned.
  for (const auto& file : files_)
    if (file->stream != nullptr) std::fclose(file->stream);
  current = nullptr;
}

void WorkbookFiles::begin_parts() {
  rows_ = files_.size();
}

bool WorkbookFiles::goes_on() {
  try {
    if (!stopped_) check_packing();
  } catch (...) {
    stopped_ = std::current_exception();
  }
  return !stopped_;
}

void WorkbookFiles::check() const {
  if (stopped_) std::rethrow_exception(stopped_);
  if (error_ != 0) fail("write", place_, name_, std::strerror(error_));
}

void WorkbookFiles::check_archive(int archive) const {
  bool whole = true;
  vector<Entry> found = entries_of(fmt::format("/proc/self/fd/{}", archive), whole);
  vector<Entry> listed;
  for (size_t i = rows_; i < files_.size(); ++i) listed.push_back({files_[i]->size, files_[i]->crc});
  std::sort(found.begin(), found.end());
  std::sort(listed.begin(), listed.end());
  if (!whole || !ends_whole(archive) || found != listed)
    fail("write", place_, name_, "the workbook differs from what was written");
}

FILE* WorkbookFiles::make() {
  try {
    auto file = make_unique<File>();
    file->descriptor = nameless_file(place_);
    file->stream = fopencookie(file.get(), "w+", {read_file, write_file, seek_file, close_file});
    if (file->stream == nullptr) throw std::bad_alloc();
    return files_.emplace_back(std::move(file))->stream;
  } catch (const ExportError&) {
    record_error(errno != 0 ? errno : EIO);
  } catch (const std::bad_alloc&) {
    record_error(ENOMEM);
  }
  return nullptr;
}

void WorkbookFiles::record_error(int error) {
  if (error_ == 0) error_ = error;
}

}  // namespace carom

extern "C" FILE* lxw_tmpfile(char*) {
  return carom::current != nullptr ? carom::current->make() : nullptr;
}
