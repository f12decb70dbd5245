#pragma once
// Words of the field that the format lacks or names differently, and the keys to use instead.

#include "std.h"

namespace carom {

struct AbsentWord {
  /// Separated by |, in lower case. The first is shown.
  string_view words;
  string_view meaning;  // the alternative, in sentences
  /// Keys or kinds for `carom explain`, separated by |. Empty: none.
  string_view see;
};

span<const AbsentWord> absent_words();

/// The row of a word or of its plural, or null. Case is ignored, and `_` and `-` stand for a space.
const AbsentWord* find_absent_word(string_view word);

/// "carom explain drag, carom explain restitution": the commands that explain what to use. Empty: none.
string commands_of(const AbsentWord& word);

}  // namespace carom
