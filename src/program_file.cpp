#include "program_file.h"

#include <filesystem>
#include <system_error>

#include "std.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

/// What the kernel started. Empty: /proc cannot be read.
fs::path started() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

bool is_loader(const fs::path& file) {
  return file.filename().string().starts_with("ld-linux");
}

}  // namespace

string program_file() {
  // The link leads to the file itself, even where another one has its name by now.
  const fs::path file = started();
  return is_loader(file) ? (file.parent_path() / "carom").string() : "/proc/self/exe";
}

string program_prefix() {
  // bin/carom, or lib/ with the loader.
  return started().parent_path().parent_path().string();
}

string program_command() {
  const fs::path file = started();
  if (is_loader(file)) return (file.parent_path().parent_path() / "bin" / "carom").string();
  return file.empty() ? "carom" : file.string();
}

}  // namespace carom
