#pragma once
// Texts as one, with a separator. (With fmt::join each source compiles fmt's formatter of strings.)

#include "std.h"

namespace carom {

/// texts: a range of strings, string views or literals.
template <typename Texts>
string joined(const Texts& texts, string_view separator) {
  string all;
  bool first = true;
  for (const string_view text : texts) {
    if (!first) all += separator;
    first = false;
    all += text;
  }
  return all;
}

/// "1 entry", "2 entries"
inline string how_many(size_t count, string_view one, string_view many) {
  return to_string(count).append(" ").append(count == 1 ? one : many);
}

}  // namespace carom
