// Follows the name folder by folder, and looks into a folder only where the name's own next part is missing.
#include "yaml/other_case.h"

#include <system_error>

#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

/// The first entry of a folder whose name has these letters.
string entry_like(const fs::path& folder, const string& name) {
  string found;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const string its = entry->path().filename().string();
    if (in_lower_case(its) == in_lower_case(name) && (found.empty() || its < found)) found = its;
  }
  return found;
}

}  // namespace

string name_in_other_case(const fs::path& folder, const fs::path& name) {
  fs::path there;
  for (const fs::path& part : name) {
    std::error_code error;
    if (fs::exists(folder / there / part, error)) {
      there /= part;
      continue;
    }
    const string like = entry_like(folder / there, part.string());
    if (like.empty()) return {};
    there /= like;
  }
  return there == name ? "" : there.string();
}

}  // namespace carom
