#include "export/stored_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

namespace carom {
namespace {

/// Reads on; 0 at the end, negative on failure.
ssize_t read_some(int file, char* to, std::size_t size) {
  ssize_t n;
  do n = read(file, to, size);
  while (n < 0 && errno == EINTR);
  return n;
}

}  // namespace

Descriptor open_stored(int folder, const std::string& name) {
  // O_NONBLOCK: opening a named pipe must not wait for its writer.
  Descriptor file(openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (file && (fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode))) file.reset();
  return file;
}

std::optional<std::uint64_t> stored_size(int folder, const std::string& name) {
  struct stat info {};
  if (fstatat(folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
  return static_cast<std::uint64_t>(info.st_size);
}

std::optional<FileRecord> read_record(int folder, const std::string& name) {
  const Descriptor file = open_stored(folder, name);
  if (!file) return std::nullopt;
  FileRecord record{name, 0, {}};
  Sha256 hash;
  std::vector<char> buffer(std::size_t{256} * 1024);
  ssize_t n;
  while ((n = read_some(file.get(), buffer.data(), buffer.size())) > 0) {
    hash.add({buffer.data(), static_cast<std::size_t>(n)});
    record.bytes += static_cast<std::uint64_t>(n);
  }
  if (n < 0) return std::nullopt;
  record.sha256 = hash.hex();
  return record;
}

std::optional<std::string> read_text(int folder, const std::string& name, std::uint64_t most) {
  const Descriptor file = open_stored(folder, name);
  if (!file) return std::nullopt;
  std::string text;
  std::vector<char> buffer(std::size_t{64} * 1024);
  ssize_t n;
  while ((n = read_some(file.get(), buffer.data(), buffer.size())) > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
    if (text.size() > most) return std::nullopt;
  }
  return n < 0 ? std::nullopt : std::optional(text);
}

}  // namespace carom
