// Compares texts of resolved scenes line by line and value by value, instead of parsing each of them.
// The first scene's text is kept with a flag for each byte, and is parsed once at the end.
#include "compare/common_values.h"

#include "files/stored_file.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/source.h"

namespace carom {
namespace {

/// Returns the text up to the next separator and removes it from `rest`.
string_view take(string_view& rest, char separator) {
  const size_t end = min(rest.find(separator), rest.size());
  const string_view part = rest.substr(0, end);
  rest.remove_prefix(min(end + 1, rest.size()));
  return part;
}

}  // namespace

void CommonValues::add(const RunRecord& run) {
  if (!run.done) return;
  const auto stored = read_text(run.folder.get(), "scene.yaml", max_source_bytes);
  if (!stored) return;
  const string text = without_tables(*stored);
  if (text_.empty()) {
    folder_ = run.run.folder;
    text_ = text;
    same_.assign(text_.size(), true);
  } else if (text_ != text) {
    compare(text);
  }
}

// A resolved scene has a line for each thing and a comma between its values. Ten thousand scenes need not be parsed.
void CommonValues::compare(string_view other) {
  if (ranges::count(text_, '\n') != ranges::count(other, '\n')) {
    same_.assign(text_.size(), false);
    return;
  }

  const auto differ = [&](string_view part) {
    const auto from = same_.begin() + (part.data() - text_.data());
    std::fill(from, from + ptrdiff_t(part.size()), false);
  };

  // Line by line, and within a line value by value.
  for (string_view rest = text_; !rest.empty();) {
    string_view line = take(rest, '\n'), other_line = take(other, '\n');
    if (line == other_line) continue;

    if (ranges::count(line, ',') != ranges::count(other_line, ',')) {
      differ(line);
      continue;
    }

    while (!line.empty()) {
      const string_view value = take(line, ',');
      if (value != take(other_line, ',')) differ(value);
    }
  }
}

vector<SceneValue> CommonValues::values() const {
  vector<SceneValue> common;
  if (text_.empty()) return common;
  for (SceneValue& value : scene_values(folder_ + "/scene.yaml", text_)) {
    // A text or a list may contain commas, and differ after them.
    const size_t length = value.text.find(',') == string::npos ? 1 : value.text.size();
    const auto from = same_.begin() + ptrdiff_t(min(value.offset, same_.size()));
    const auto until = from + min(ptrdiff_t(length), same_.end() - from);
    if (std::find(from, until, false) == until) common.push_back(std::move(value));
  }
  return common;
}

}  // namespace carom
