#pragma once
// Letters of UTF-8 text, a code point counted as one.

#include "std.h"

namespace carom {

/// The length in bytes of the UTF-8 character at `text[i]`, or 0 if it is not valid. `code` receives its code point.
int utf8_length(string_view text, size_t i, char32_t& code);

/// Control characters, byte order marks and non-characters, which no text should hold. LF and tab are included.
bool is_control(char32_t code);

/// The number of UTF-8 characters. A byte that is not part of one counts as one.
size_t count_characters(string_view text);

/// Only letters of ASCII change.
string in_lower_case(string_view text);

size_t letters_of(string_view text);

/// A text of at most `most` letters. A cut is marked with an ellipsis, which is one of them.
string shortened(string_view text, size_t most);

}  // namespace carom
