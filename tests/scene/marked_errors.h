#pragma once
// The errors of a scene as pairs of the text that the caret marks and the message.
#include <sstream>
#include <utility>

#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {

using Marked = vector<std::pair<string, string>>;

/// For each error: the marked part of its line, and the message. Lines must be short enough to be shown whole.
inline Marked marked_errors(const string& text, const string& set = "") {
  Marked found;
  std::istringstream in(set.empty() ? errors_of(text) : errors_with(text, set));
  for (string message, line, marks; std::getline(in, message);) {
    const size_t error = message.find(": error: ");
    if (error == string::npos || !std::getline(in, line) || !std::getline(in, marks)) continue;
    const size_t first = marks.find('^'), end = marks.find_last_of("^~") + 1;
    found.emplace_back(line.substr(first, end - first), message.substr(error + 9));
  }
  return found;
}

}  // namespace carom
