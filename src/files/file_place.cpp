#include "files/file_place.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "std.h"

namespace carom {

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    reset();
    number_ = other.release();
  }
  return *this;
}

int Descriptor::release() {
  const int number = number_;
  number_ = -1;
  return number;
}

void Descriptor::reset() {
  if (number_ >= 0) close(number_);
  number_ = -1;
}

FilePlace place_of(int descriptor) {
  if (descriptor == AT_FDCWD) return {descriptor, ""};
  array<char, 4096> path{};
  const ssize_t size = readlink(fmt::format("/proc/self/fd/{}", descriptor).c_str(), path.data(), path.size());
  return {descriptor, size > 0 ? string(path.data(), size_t(size)) : "a file"};
}

bool is_absent(int error) {
  return error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG;
}

void fail(const string& what, const FilePlace& place, string_view name, const string& reason) {
  const string why = reason.empty() ? std::strerror(errno) : reason;
  const string slash = name.empty() || place.path.empty() || place.path.ends_with('/') ? "" : "/";
  throw ExportError("cannot " + what + " " + place.path + slash + string(name) + ": " + why);
}

}  // namespace carom
