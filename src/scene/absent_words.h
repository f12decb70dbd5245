#pragma once
// Words of the field that the format does not have, or has under another name, and what there is instead.
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace carom {

struct AbsentWord {
  std::string_view words;    // separated by |, in lower case; the first is shown
  std::string_view meaning;  // what there is instead, in sentences
  std::string_view see;      // keys or kinds for `carom explain`, separated by |; empty: none
};

std::span<const AbsentWord> absent_words();

/// The row of a word, of any case, in which `_` and `-` stand for a space; null: there is none.
const AbsentWord* find_absent_word(std::string_view word);

}  // namespace carom
