#pragma once
// Words of the field that the format lacks or names differently, and the keys to use instead.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

struct AbsentWord {
  /// Separated by |, in lower case. The first is shown.
  std::string_view words;
  std::string_view meaning;  // the alternative, in sentences
  /// Keys or kinds for `carom explain`, separated by |. Empty: none.
  std::string_view see;
};

std::span<const AbsentWord> absent_words();

/// The row of a word or of its plural, or null. Case is ignored, and `_` and `-` stand for a space.
const AbsentWord* find_absent_word(std::string_view word);

/// "carom explain drag, carom explain restitution": the commands that explain what to use. Empty: none.
std::string commands_of(const AbsentWord& word);

}  // namespace carom
