// Lists and removes entries by descriptor.
// Each listing opens the folder again, because descriptors made by dup() share a position.
#include "files/folder_names.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "std.h"

namespace carom {
namespace {

constexpr string_view tail = ".part";

/// None, with errno set: the folder cannot be read.
optional<vector<string>> read_names(int folder) {
  // Open the folder again, because reading moves a position that descriptors made by dup() share.
  Descriptor copy(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  DIR* stream = copy ? fdopendir(copy.get()) : nullptr;
  if (!stream) return nullopt;
  copy.release();

  vector<string> names;
  errno = 0;
  while (const dirent* entry = readdir(stream)) {
    const string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }

  // The reason of a failure is readdir's.
  const int error = errno;
  closedir(stream);
  errno = error;
  if (error != 0) return nullopt;
  ranges::sort(names);
  return names;
}

}  // namespace

vector<string> folder_names(int folder) {
  auto names = read_names(folder);
  if (!names) fail("read", place_of(folder), "");
  return std::move(*names);
}

bool try_to_remove(int folder, const string& name) {
  // A child process of a killed run may still create files in its folder. Therefore there is more than one attempt.
  for (int attempt = 0; attempt < 10; ++attempt) {
    if (unlinkat(folder, name.c_str(), 0) == 0 || is_absent(errno)) return true;
    if (errno != EISDIR && errno != EPERM) return false;

    // It is a folder. Empty it first.
    const Descriptor inner(openat(folder, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!inner) return is_absent(errno);
    const auto names = read_names(inner.get());
    if (!names) return false;
    for (const string& entry : *names)
      if (!try_to_remove(inner.get(), entry)) return false;

    if (unlinkat(folder, name.c_str(), AT_REMOVEDIR) == 0) return true;
    if (errno != ENOTEMPTY && errno != EEXIST) return is_absent(errno);
  }
  return false;
}

void remove_entry(const FilePlace& place, const string& name) {
  if (!try_to_remove(place.folder, name)) fail("remove", place, name);
}

void remove_parts(const FilePlace& place, string_view spared) {
  for (const string& name : folder_names(place.folder))
    if (is_part_name(name) && name != spared) remove_entry(place, name);
}

void remove_file(const FilePlace& place, const string& name) {
  if (unlinkat(place.folder, name.c_str(), 0) != 0 && !is_absent(errno)) fail("remove", place, name);
}

bool is_plain_name(string_view name) {
  if (name.empty() || name.size() > 200 || name.front() == '.') return false;
  return none_of(name, [](char c) { return c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' ' || c == 127; });
}

string part_name(string_view name) {
  return fmt::format(".{}{}", name, tail);
}

bool is_part_name(string_view name) {
  return name.size() > 1 + tail.size() && name.starts_with('.') && name.ends_with(tail);
}

string name_of_part(string_view part) {
  return string(part.substr(1, part.size() - 1 - tail.size()));
}

}  // namespace carom
