#include "files/folders.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "std.h"

namespace carom {

Descriptor open_folder(int parent, const string& name, bool follow) {
  Descriptor folder(openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | (follow ? 0 : O_NOFOLLOW)));
  if (!folder && !is_absent(errno) && (follow || errno != ELOOP)) fail("open", place_of(parent), name);
  return folder;
}

Descriptor make_folder(const FilePlace& parent, const string& name) {
  const FilePlace place{-1, parent.path + "/" + name};
  if (mkdirat(parent.folder, name.c_str(), 0777) != 0 && errno != EEXIST) fail("make", place, "");
  Descriptor folder = open_folder(parent.folder, name, false);
  if (!folder) fail("open", place, "", "it is not a folder, or a link; remove it");
  return folder;
}

void sync_names(const FilePlace& place) {
  // Some file systems do not support syncing a folder, and do not need it.
  if (fsync(place.folder) != 0 && errno != EINVAL && errno != ENOTSUP) fail("write", place, "");
}

Standing what_stands(const string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) == 0) return S_ISDIR(info.st_mode) ? Standing::folder : Standing::other;
  if (!is_absent(errno)) fail("look at", {AT_FDCWD, ""}, path);
  return Standing::nothing;
}

bool is_same_folder(const string& a, const string& b) {
  const Descriptor one = open_folder(AT_FDCWD, a, true), other = open_folder(AT_FDCWD, b, true);
  if (!one || !other) return false;
  struct stat first {
  }, second{};
  if (fstat(one.get(), &first) != 0) fail("look at", {AT_FDCWD, ""}, a);
  if (fstat(other.get(), &second) != 0) fail("look at", {AT_FDCWD, ""}, b);
  return first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

string canonical(const string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path.empty() ? "." : path, error);
  if (error) fail("look at", {AT_FDCWD, ""}, path, error.message());
  return whole.string();
}

string absolute(const string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  if (error) fail("look at", {AT_FDCWD, ""}, path, error.message());
  return whole.string();
}

string name_of_folder(const string& folder) {
  const std::filesystem::path path = std::filesystem::path(absolute(folder)).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

bool lock_folder(const FilePlace& place, LockKind kind) {
  int code = 0;
  do code = flock(place.folder, (kind == LockKind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB);
  while (code != 0 && errno == EINTR);
  if (code == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  if (errno != ENOTSUP && errno != ENOLCK && errno != ENOSYS && errno != EINVAL) fail("lock", place, "");
  return true;
}

}  // namespace carom
