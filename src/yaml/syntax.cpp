// Finds the cause of a parse failure: unpaired brackets and quotes, a missing ':', wrong indentation.
// It reads the text itself, because yaml-cpp reports the place where it detected the failure, often many lines later.
// The checks run from the most to the least specific. Without a match the parser's own message is shown.
#include "yaml/syntax.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/letters.h"
#include "yaml/lookalikes.h"

namespace carom {
namespace {

/// A bracket or quote without a partner.
struct Unpaired {
  size_t open = string::npos;
  /// A bracket of another kind that stands where the partner is expected. npos: the text ends before any partner.
  size_t close = string::npos;
};

/// Walks brackets, quotes and comments as YAML reads them, except in blocks of text. The result serves only a message.
Unpaired find_unpaired(string_view text, size_t begin) {
  vector<size_t> open;
  for (size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    const char before = i == begin ? '\n' : text[i - 1];
    const bool token_start =
        before == ' ' || before == '\n' || before == '[' || before == '{' || before == ',' || before == ':';

    if (c == '#' && (before == ' ' || before == '\n')) {
      i = min(text.find('\n', i), text.size());
    } else if ((c == '"' || c == '\'') && token_start) {
      // The closing quote. Double quotes escape by a backslash, single ones by doubling.
      size_t j = i + 1;
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
      if (j >= text.size()) return {i, string::npos};
      i = j;

    } else if ((c == '[' || c == '{') && (token_start || !open.empty())) {
      open.push_back(i);
    } else if ((c == ']' || c == '}') && !open.empty()) {
      if ((c == ']') != (text[open.back()] == '[')) return {open.back(), i};
      open.pop_back();
    }
  }

  if (!open.empty()) return {open.back(), string::npos};
  return {};
}

size_t line_start(string_view text, size_t i) {
  return i == 0 ? 0 : text.rfind('\n', i - 1) + 1;
}

string_view line_at(string_view text, size_t i) {
  const size_t begin = line_start(text, i);
  return text.substr(begin, min(text.find('\n', begin), text.size()) - begin);
}

bool has_colon(string_view line) {
  return line.find(": ") != string_view::npos || line.ends_with(':');
}

/// The meaning of one of the parser's messages.
struct SyntaxCause {
  string_view complaint;  // a part of the message
  string_view message, remedy;
};

constexpr string_view no_tags = "remove it: the key determines the type of its value";
constexpr string_view own_lines = "expected lists as [a, b], or `- ` in lines of their own";

constexpr SyntaxCause causes_in_values[] = {
    {"anchor is not defined", "an alias", "expected the value itself: scenes have no anchors and aliases"},
    {"multiple anchors", "a tag or anchor", no_tags},
    {"tag", "a tag or anchor", no_tags},
};
constexpr SyntaxCause causes_in_brackets[] = {
    {"illegal flow end", "this bracket closes nothing", "remove it"},
    {"flow not found", "a value ends and something else follows",
     "expected ',' or the closing bracket; is a ',' missing?"},
};
constexpr SyntaxCause causes_in_lines[] = {
    {"end of map not found", "this does not fit the lines above",
     "expected `key: value` at the indentation of one of them"},
    {"end of sequence not found", "this does not fit the list above",
     "expected `- ` at its indentation, or a key further left"},
    {"block entry", "a list entry cannot begin here", own_lines},
    {"sequence entr", "a list entry cannot begin here", own_lines},
    {"bad file", "values are nested too deep", "expected a scene"},
};

/// A failure of the parser. Each function adds an error if it finds the cause, and returns whether it did.
class ParseFailure {
 public:
  ParseFailure(const Source& source, uint32_t index, size_t begin, size_t detected, const string& complaint,
               Diagnostics& diagnostics)
      : text_(source.text),
        index_(index),
        begin_(begin),
        detected_(detected),
        complaint_(complaint),
        diagnostics_(diagnostics) {}

  void explain() {
    const bool known = explain_by(causes_in_values) || explain_character() || explain_blank() || explain_comment() ||
                       explain_unpaired() || explain_by(causes_in_brackets) || explain_map_value() ||
                       explain_text_after_bracket() || explain_by(causes_in_lines);
    if (!known) add(detected_, fmt::format("this is not YAML: {}", complaint_), "expected `key: value`");
  }

 private:
  void add(size_t offset, string message, string remedy, size_t length = 1) {
    const Place place{index_, uint32_t(offset), uint32_t(length)};
    diagnostics_.add(place, std::move(message), std::move(remedy));
  }
  bool complaint_has(string_view part) const { return complaint_.find(part) != string::npos; }

  bool explain_by(span<const SyntaxCause> causes) {
    for (const SyntaxCause& cause : causes) {
      if (!complaint_has(cause.complaint)) continue;
      add(detected_, string(cause.message), string(cause.remedy));
      return true;
    }
    return false;
  }

  bool explain_character() {
    if (complaint_has("unknown token")) {
      const char c = detected_ < text_.size() ? text_[detected_] : ' ';
      add(detected_, fmt::format("plain text cannot begin with {}", in_backticks(string(1, c))),
          "put the text in quotes");
      return true;
    }
    if (complaint_has("unknown escape")) {
      add(detected_ - min<size_t>(detected_, 2), "an unknown escape in a text in double quotes",
          "in single quotes a backslash is just a backslash", 2);
      return true;
    }
    return false;
  }

  /// What looks like a space, at the start of a line or after a ':', up to the line where the parser stopped.
  bool explain_blank() {
    const size_t end = line_start(text_, detected_) + line_at(text_, detected_).size();
    bool structural = true;
    for (size_t i = begin_; i < end; ++i) {
      const optional<Lookalike> found = lookalike_at(text_, i);
      if (structural && found && is_blank(*found)) {
        char32_t code = 0;
        add(i, "this is no space to YAML", "", size_t(utf8_length(text_, i, code)));
        return true;
      }
      structural = text_[i] == '\n' || text_[i] == ':' || (structural && text_[i] == ' ');
    }
    return false;
  }

  /// `color: #ff0000` in brackets: the comment hides the rest of the line.
  bool explain_comment() {
    size_t depth = 0;
    for (size_t i = begin_; i <= min(detected_, text_.size() - 1); ++i) {
      const char c = text_[i];
      if (c == '[' || c == '{') ++depth;
      if ((c == ']' || c == '}') && depth > 0) --depth;
      if (c != '#' || i == 0 || text_[i - 1] != ' ') continue;

      const size_t before = text_.find_last_not_of(' ', i - 1), end = text_.find_first_of(" ,]}\n", i);
      const size_t word = min(end, text_.size()) - i;
      const bool is_value = before != string_view::npos && string_view(":,[").find(text_[before]) < 3;

      if (depth > 0 && is_value && word > 1) {
        add(i,
            fmt::format("{} begins a comment, which hides the rest of the line", in_backticks(text_.substr(i, word))),
            fmt::format("a colour that begins with # needs quotes: '{}'", text_.substr(i, word)), word);
        return true;
      }
      i = min(text_.find('\n', i), text_.size());
    }
    return false;
  }

  bool explain_unpaired() {
    const Unpaired unpaired = find_unpaired(text_, begin_);
    if (unpaired.open == string::npos) return false;

    const char c = text_[unpaired.open];
    const string open = in_backticks(text_.substr(unpaired.open, 1));
    const string closing = c == '[' ? "]" : c == '{' ? "}" : string(1, c);

    if (unpaired.close != string::npos) {
      const auto before = text_.begin() + ptrdiff_t(unpaired.open);
      add(unpaired.close,
          fmt::format("{} cannot close the {} of line {}", in_backticks(text_.substr(unpaired.close, 1)), open,
                      1 + std::count(text_.begin(), before, '\n')),
          fmt::format("expected {}", in_backticks(closing)));
    } else {
      add(unpaired.open, fmt::format("this {} is never closed", open),
          fmt::format("expected {} before the next key", in_backticks(closing)));
    }
    return true;
  }

  bool explain_text_after_bracket() {
    if (!complaint_has("end of map not found")) return false;
    const string_view before = text_.substr(0, detected_);
    const size_t last = before.find_last_not_of(' ');
    if (last == string_view::npos || (before[last] != '}' && before[last] != ']')) return false;
    add(detected_, string(text_after_bracket), string(quotes_for_bracket));
    return true;
  }

  /// Two ": " in a line, or a line above without a ':' that the parser joined to this one.
  bool explain_map_value() {
    if (!complaint_has("illegal map value")) return false;
    const size_t start = line_start(text_, detected_);
    if (text_.substr(start, detected_ - start).find(": ") != string_view::npos) {
      add(detected_, "a second ':' in this line",
          "expected one `key: value` a line; text that holds ': ' needs quotes");
      return true;
    }

    // The last line above that is neither empty nor a comment.
    size_t above = start;
    while (above > begin_) {
      above = line_start(text_, above - 1);
      const string_view line = line_at(text_, above);
      const size_t word = line.find_first_not_of(' ');
      if (word == string_view::npos || line[word] == '#') continue;

      if (!has_colon(line)) {
        add(above + word, "this line has no ':'", "expected `key: value`", line.find_last_not_of(' ') + 1 - word);
      } else {
        const string_view here = line_at(text_, detected_);
        const size_t first = min(here.find_first_not_of(' '), detected_ - start);
        add(start + first, "this line is indented further than the line above, which has its value already",
            "expected the same indentation");
      }
      return true;
    }
    return false;
  }

  const string_view text_;
  const uint32_t index_;
  const size_t begin_, detected_;
  const string& complaint_;
  Diagnostics& diagnostics_;
};

}  // namespace

void explain_syntax(const Source& source, uint32_t index, size_t begin, size_t detected, const string& complaint,
                    Diagnostics& diagnostics) {
  ParseFailure(source, index, begin, detected, complaint, diagnostics).explain();
}

}  // namespace carom
