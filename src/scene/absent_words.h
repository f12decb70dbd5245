#pragma once
// Words of the field that the format lacks or names differently, and the keys to use instead.
#include <optional>
#include <span>
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

/// The row of a word, or null. Case is ignored, and `_` and `-` stand for a space.
const AbsentWord* find_absent_word(std::string_view word);

}  // namespace carom
