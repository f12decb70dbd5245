#include "fuzz/memory_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "std.h"

namespace carom::fuzz {

namespace fs = std::filesystem;

namespace {

void write_all(int file, string_view bytes) {
  if (ftruncate(file, 0) != 0 || pwrite(file, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw runtime_error("the input cannot be written");
}

}  // namespace

MemoryFile::MemoryFile(string_view bytes)
    : file_(memfd_create("input", MFD_CLOEXEC)), path_("/proc/self/fd/" + to_string(file_.get())) {
  write_all(file_.get(), bytes);
}

Descriptor MemoryFile::open() const {
  return Descriptor(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
}

OwnFolder::OwnFolder() {
  // In memory where the system lets this user write there.
  const fs::path shared = "/dev/shm";
  const bool writable = access(shared.c_str(), W_OK | X_OK) == 0;
  path_ = ((writable ? shared : fs::temp_directory_path()) / "carom_fuzz_XXXXXX").string();
  if (mkdtemp(path_.data()) == nullptr) throw runtime_error("no folder for inputs");
  folder_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

OwnFolder::~OwnFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void OwnFolder::put(const string& name, string_view bytes) const {
  const Descriptor file(openat(descriptor(), name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  write_all(file.get(), bytes);
}

string bytes_of(const string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

vector<string> files_below(const string& folder, const string& ending) {
  vector<string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ending) paths.push_back(entry.path().string());
  ranges::sort(paths);
  return paths;
}

}  // namespace carom::fuzz
