#include "scene/syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "scene/diagnostics.h"

namespace carom {
namespace {

/// A bracket or quote that has no partner.
struct Unpaired {
  std::size_t open = std::string::npos;
  std::size_t close = std::string::npos;  // the bracket that closes another kind; npos: the text ends
};

/// Walks brackets, quotes and comments as YAML sees them (blocks of text aside). What it finds only serves a message.
Unpaired find_unpaired(std::string_view text, std::size_t begin) {
  std::vector<std::size_t> open;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    const char before = i == begin ? '\n' : text[i - 1];
    const bool token_start =
        before == ' ' || before == '\n' || before == '[' || before == '{' || before == ',' || before == ':';
    if (c == '#' && (before == ' ' || before == '\n')) {
      i = std::min(text.find('\n', i), text.size());
    } else if ((c == '"' || c == '\'') && token_start) {
      std::size_t j = i + 1;
      for (; j < text.size(); ++j) {
        if (c == '"' && text[j] == '\\') {
          ++j;
        } else if (text[j] == c) {
          if (c == '\'' && j + 1 < text.size() && text[j + 1] == '\'') {
            ++j;
          } else {
            break;
          }
        }
      }
      if (j >= text.size()) return {i, std::string::npos};
      i = j;
    } else if ((c == '[' || c == '{') && (token_start || !open.empty())) {
      open.push_back(i);
    } else if ((c == ']' || c == '}') && !open.empty()) {
      if ((c == ']') != (text[open.back()] == '[')) return {open.back(), i};
      open.pop_back();
    }
  }
  if (!open.empty()) return {open.back(), std::string::npos};
  return {};
}

std::size_t line_start(std::string_view text, std::size_t i) {
  return i == 0 ? 0 : text.rfind('\n', i - 1) + 1;
}

std::string_view line_at(std::string_view text, std::size_t i) {
  const std::size_t begin = line_start(text, i);
  return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

bool has_colon(std::string_view line) {
  return line.find(": ") != std::string_view::npos || line.ends_with(':');
}

}  // namespace

void explain_syntax(const Source& source, std::uint32_t index, std::size_t begin, std::size_t noticed,
                    const std::string& complaint, Diagnostics& diagnostics) {
  const std::string_view text = source.text;
  const auto place = [&](std::size_t offset, std::size_t length = 1) {
    return Place{index, static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(length)};
  };
  const auto says = [&](std::string_view part) { return complaint.find(part) != std::string::npos; };

  if (says("anchor is not defined")) {
    diagnostics.add(place(noticed), "an alias", "expected the value itself: scenes have no anchors and aliases");
    return;
  }
  if (says("multiple tags") || says("multiple anchors") || says("tag")) {
    diagnostics.add(place(noticed), "a tag or anchor", "remove it: the key decides what kind of value it has");
    return;
  }
  if (says("unknown token")) {
    const char c = noticed < text.size() ? text[noticed] : ' ';
    diagnostics.add(place(noticed), fmt::format("plain text cannot begin with {}", quoted(std::string(1, c))),
                    "put the text in quotes");
    return;
  }
  if (says("unknown escape")) {
    diagnostics.add(place(noticed > 0 ? noticed - 1 : 0, 2), "an unknown escape in a text in double quotes",
                    "in single quotes a backslash is just a backslash");
    return;
  }

  const Unpaired unpaired = find_unpaired(text, begin);
  if (unpaired.open != std::string::npos) {
    const char c = text[unpaired.open];
    const std::string closing = c == '[' ? "]" : c == '{' ? "}" : std::string(1, c);
    if (unpaired.close != std::string::npos) {
      diagnostics.add(
          place(unpaired.close),
          fmt::format("{} cannot close the {} of line {}", quoted(text.substr(unpaired.close, 1)),
                      quoted(text.substr(unpaired.open, 1)),
                      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(unpaired.open), '\n')),
          fmt::format("expected {}", quoted(closing)));
    } else {
      diagnostics.add(place(unpaired.open),
                      fmt::format("this {} is never closed", quoted(text.substr(unpaired.open, 1))),
                      fmt::format("expected {} before the next key", quoted(closing)));
    }
    return;
  }
  if (says("illegal flow end")) {
    diagnostics.add(place(noticed), "this bracket closes nothing", "remove it");
    return;
  }
  if (says("flow not found")) {
    diagnostics.add(place(noticed), "a value ends and another thing begins",
                    "expected ',' or the closing bracket; is a ',' missing?");
    return;
  }
  if (says("illegal map value")) {
    // Two ": " in a line, or a line above that lacks its own and was read on.
    const std::size_t start = line_start(text, noticed);
    if (text.substr(start, noticed - start).find(": ") != std::string_view::npos) {
      diagnostics.add(place(noticed), "a second ':' in this line",
                      "expected one `key: value` a line; text that holds ': ' needs quotes");
      return;
    }
    std::size_t above = start;
    while (above > begin) {
      above = line_start(text, above - 1);
      const std::string_view line = line_at(text, above);
      const std::size_t word = line.find_first_not_of(' ');
      if (word == std::string_view::npos || line[word] == '#') continue;
      if (!has_colon(line)) {
        diagnostics.add(place(above + word, line.find_last_not_of(' ') + 1 - word), "this line has no ':'",
                        "expected `key: value`");
      } else {
        const std::string_view here = line_at(text, noticed);
        const std::size_t first = std::min(here.find_first_not_of(' '), noticed - start);
        diagnostics.add(place(start + first),
                        "this line is indented further than the line above, which has its value already",
                        "expected the same indentation");
      }
      return;
    }
  }
  if (says("end of map not found")) {
    diagnostics.add(place(noticed), "this does not fit the lines above",
                    "expected `key: value` at the indentation of one of them");
    return;
  }
  if (says("end of sequence not found")) {
    diagnostics.add(place(noticed), "this does not fit the list above",
                    "expected `- ` at its indentation, or a key further left");
    return;
  }
  if (says("block entry") || says("sequence entr")) {
    diagnostics.add(place(noticed), "a list entry cannot begin here",
                    "expected lists as [a, b], or `- ` in lines of their own");
    return;
  }
  if (says("bad file")) {
    diagnostics.add(place(noticed), "values are nested too deep", "expected a scene");
    return;
  }
  diagnostics.add(place(noticed), fmt::format("this is not YAML: {}", complaint), "expected `key: value`");
}

}  // namespace carom
