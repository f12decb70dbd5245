#pragma once
// The errors of a scene in parts, without the layout of their text.
#include <sstream>

#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {

using Marked = vector<pair<string, string>>;
using Parts = vector<std::tuple<string, string, string>>;

/// For each error in the text of errors_of(): "LINE:COLUMN MARKED", the message, and the remedies, one a line.
/// In a setting the place is "--set:COLUMN". Lines must be of ASCII, and short enough to be shown whole.
inline Parts in_parts(const string& errors) {
  Parts found;
  std::istringstream in(errors);
  for (string line, before; std::getline(in, line); before = line) {
    const size_t error = line.find(": error: ");

    if (error != string::npos && !line.starts_with(' ')) {
      const bool of_setting = line.starts_with("--set");
      const size_t place = of_setting ? error : std::min(line.find(':') + 1, error);
      found.emplace_back(of_setting ? "--set:" : line.substr(place, error - place), line.substr(error + 9), "");

      // Of no layout that an error has: an entry of its own, which no test expects.
    } else if (found.empty() || !line.starts_with(' ')) {
      found.emplace_back("", line, "");
    } else if (auto& [marked, message, remedies] = found.back(); line.starts_with("     = ")) {
      remedies += (remedies.empty() ? "" : "\n") + line.substr(7);
    } else if (const size_t mark = line.find('^');
               mark != string::npos && line.find_first_not_of(" |^~") == string::npos) {
      if (marked.ends_with(':')) marked += to_string(mark - 6);
      marked += " " + before.substr(std::min(mark, before.size()), line.size() - mark);
    }
  }
  return found;
}

/// For each error the marked part of its line, and the message.
inline Marked marked_errors(const string& text, const string& set = "") {
  Marked found;
  for (const auto& [marked, message, remedies] : in_parts(set.empty() ? errors_of(text) : errors_with(text, set)))
    found.emplace_back(marked.substr(marked.find(' ') + 1), message);
  return found;
}

}  // namespace carom
