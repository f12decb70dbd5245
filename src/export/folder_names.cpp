#include "export/folder_names.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

#include "export/output_file.h"

namespace carom {

std::vector<std::string> folder_names(int folder) {
  std::vector<std::string> names;
  // Opened anew: reading moves a position that descriptors made by dup() share.
  Descriptor copy(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  DIR* stream = copy ? fdopendir(copy.get()) : nullptr;
  if (!stream) return names;
  copy.release();
  while (const dirent* entry = readdir(stream)) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  closedir(stream);
  std::sort(names.begin(), names.end());
  return names;
}

void remove_entry(int folder, const std::string& name) {
  // A program whose run was killed may still be making files in a folder of its own: more than one attempt.
  for (int attempt = 0; attempt < 10; ++attempt) {
    if (unlinkat(folder, name.c_str(), 0) == 0) return;
    const Descriptor inner(openat(folder, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!inner) return;
    for (const std::string& entry : folder_names(inner.get())) unlinkat(inner.get(), entry.c_str(), 0);
    if (unlinkat(folder, name.c_str(), AT_REMOVEDIR) == 0) return;
  }
}

bool is_part_name(std::string_view name) {
  constexpr std::string_view tail = ".part";
  return name.size() > 1 + tail.size() && name.starts_with('.') && name.ends_with(tail);
}

}  // namespace carom
