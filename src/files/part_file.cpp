// Temporary names are `.name.part`, in the folder of the final name, so that renaming is atomic.
// Every access is relative to a folder's descriptor and follows no link.
#include "files/part_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "std.h"

namespace carom {
namespace {

constexpr const char* folder_there = "a folder of that name stands there; remove it";

}  // namespace

void refuse_folder(const FilePlace& place, const string& name) {
  struct stat info {};
  if (fstatat(place.folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) {
    if (!is_absent(errno)) fail("write", place, name);
  } else if (S_ISDIR(info.st_mode)) {
    fail("write", place, name, folder_there);
  }
}

void give_name(int from, const string& part, const FilePlace& place, const string& name) {
  if (renameat(from, part.c_str(), place.folder, name.c_str()) == 0) return;
  fail("write", place, name, errno == EISDIR ? folder_there : "");
}

Descriptor nameless_file(const FilePlace& place) {
  Descriptor file(openat(place.folder, ".", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (file) return file;
  if (errno != EOPNOTSUPP && errno != EISDIR && errno != ENOENT && errno != EINVAL)
    fail("write", place, "", string("a temporary file: ") + std::strerror(errno));
  // On a file system without unnamed files, create a temporary file and remove its name.
  const string part = part_name("temporary");
  remove_entry(place, part);
  file = Descriptor(openat(place.folder, part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!file) fail("write", place, part);
  remove_entry(place, part);
  return file;
}

PartFile::PartFile(const FilePlace& place, string name) : place_(place) {
  if (!is_plain_name(name))
    fail("write", place, name, "a file name must not contain a slash or a control character, or start with a dot");
  record_.name = std::move(name);
  refuse_folder(place_, record_.name);
  // A temporary file of an interrupted run is removed and never opened for writing, because it may be a link.
  if (!place_.goes_on) remove_entry(place_, part());
}

PartFile::~PartFile() {
  if (!handed_over_) try_to_remove(place_.folder, part());
}

void PartFile::publish() {
  give_name(place_.folder, part(), place_, record_.name);
  handed_over_ = true;
}

}  // namespace carom
