// Opens files with O_NOFOLLOW and O_NONBLOCK, so that neither a link nor a named pipe in a folder can mislead or block.
#include "files/stored_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "files/folders.h"
#include "files/gzip.h"

#include "std.h"

namespace carom {
namespace {

constexpr size_t read_size = size_t{64} * 1024;

/// Whether this errno of openat() means that there is no regular file of this name. A link or a socket counts as none.
bool is_no_file(int error) {
  return is_absent(error) || error == ELOOP || error == ENXIO;
}

}  // namespace

size_t read_some(int file, char* to, size_t size) {
  ssize_t n;
  do n = read(file, to, size);
  while (n < 0 && errno == EINTR);
  if (n < 0) fail("read", place_of(file), "");
  return size_t(n);
}

Descriptor open_stored(int folder, const string& name) {
  // O_NONBLOCK keeps the opening of a named pipe from waiting for its writer.
  Descriptor file(openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file && !is_no_file(errno)) fail("read", place_of(folder), name);
  struct stat info {};
  if (file && fstat(file.get(), &info) != 0) fail("read", place_of(folder), name);
  if (file && !S_ISREG(info.st_mode)) file.reset();
  return file;
}

optional<string> stored_table(int folder, const string& name) {
  for (const string& stored : {name, name + string(gzip_ending)})
    if (stored_size(folder, stored)) return stored;
  return nullopt;
}

Descriptor open_stored_table(int folder, const string& name) {
  if (Descriptor file = open_stored(folder, name)) return file;
  const string packed = name + string(gzip_ending);
  const Descriptor file = open_stored(folder, packed);
  if (!file) return Descriptor();

  const FilePlace place = place_of(folder);
  Descriptor table;
  try {
    table = nameless_file(place);
  } catch (const ExportError&) {
    const string temporary = std::filesystem::temp_directory_path().string();
    const Descriptor other = open_folder(AT_FDCWD, temporary, true);
    if (!other) throw;
    table = nameless_file({other.get(), temporary});
  }

  unpack_gzip(file.get(), table.get(), place, packed);
  if (lseek(table.get(), 0, SEEK_SET) != 0) fail("read", place, packed);
  return table;
}

uint64_t file_size(int file) {
  struct stat info {};
  if (fstat(file, &info) != 0) fail("read", place_of(file), "");
  return uint64_t(info.st_size);
}

optional<uint64_t> stored_size(int folder, const string& name) {
  struct stat info {};
  if (fstatat(folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) {
    if (!is_absent(errno)) fail("read", place_of(folder), name);
    return nullopt;
  }
  if (!S_ISREG(info.st_mode)) return nullopt;
  return uint64_t(info.st_size);
}

optional<FileRecord> read_record(int folder, const string& name) {
  const Descriptor file = open_stored(folder, name);
  if (!file) return nullopt;
  FileRecord record{name, 0, {}};
  Sha256 hash;
  vector<char> buffer(4 * read_size);
  while (const size_t n = read_some(file.get(), buffer.data(), buffer.size())) {
    hash.add({buffer.data(), n});
    record.bytes += n;
  }
  record.sha256 = hash.hex();
  return record;
}

optional<string> read_text(int folder, const string& name, uint64_t most) {
  const Descriptor file = open_stored(folder, name);
  if (!file) return nullopt;
  string text;
  vector<char> buffer(read_size);
  while (const size_t n = read_some(file.get(), buffer.data(), buffer.size())) {
    text.append(buffer.data(), n);
    if (text.size() > most) return nullopt;
  }
  return text;
}

}  // namespace carom
