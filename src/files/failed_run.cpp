// A failed run keeps one text file. Without a manifest no reader takes the folder for a complete run, and the run is
// repeated.
#include "files/failed_run.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

#include "files/folder_writer.h"
#include "files/stored_file.h"
#include "std.h"

namespace carom {
namespace {

constexpr uint64_t longest_reason = 1 << 20;  // bytes

}  // namespace

void store_failure(const string& path, const string& why) {
  FolderWriter folder(path, Durability::deferred);
  remove_files_of_run(folder.place());
  OutputFile file(folder.place(), failure_file);
  file.write(why);
  file.write("\n");
  file.publish();
  folder.keep();
}

bool names_full_disk(const string& why) {
  // The text, since a worker process or a program such as ffmpeg reports no more than that.
  return why.find(std::strerror(ENOSPC)) != string::npos || why.find(std::strerror(EDQUOT)) != string::npos;
}

string stored_failure(const string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  if (!folder) return "";
  string text = read_text(folder.get(), failure_file, longest_reason).value_or("");
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace carom
