// Follows the name folder by folder, and looks into a folder only where the name's own next part is missing.
#include "yaml/other_case.h"

#include <algorithm>
#include <system_error>

#include "std.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

bool differ_in_case(string_view a, string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return small(x) == small(y); });
}

/// The first entry of a folder whose name has these letters.
string entry_like(const fs::path& folder, const string& name) {
  string found;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const string its = entry->path().filename().string();
    if (differ_in_case(its, name) && (found.empty() || its < found)) found = its;
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
