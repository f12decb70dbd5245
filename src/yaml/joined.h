#pragma once
// Texts as one, with a separator. (With fmt::join each source compiles fmt's formatter of strings.)
#include <string>
#include <string_view>

namespace carom {

/// texts: a range of strings, string views or literals.
template <typename Texts>
std::string joined(const Texts& texts, std::string_view separator) {
  std::string all;
  bool first = true;
  for (const std::string_view text : texts) {
    if (!first) all += separator;
    first = false;
    all += text;
  }
  return all;
}

/// "1 entry", "2 entries"
inline std::string how_many(std::size_t count, std::string_view one, std::string_view many) {
  return std::to_string(count).append(" ").append(count == 1 ? one : many);
}

}  // namespace carom
