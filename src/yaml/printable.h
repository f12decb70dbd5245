#pragma once
// Text of unknown origin, such as a file name or a title, made safe to display.

#include "std.h"

namespace carom {

/// Whether a character is invisible or changes how others are shown.
/// These are control characters, line separators, marks of text direction,
/// and marks that join or split letters invisibly.
/// They are Unicode's categories Cc, Cf, Zl and Zp without the few visible characters of Cf.
bool is_unprintable(char32_t code);

/// The character as an escape sequence of JSON: "\u202e". A character beyond U+FFFF becomes a surrogate pair.
string escaped(char32_t code);

/// `text` with unprintable characters and bytes that are not UTF-8 escaped as "\x1b" or "\u202e".
string printable(string_view text);

}  // namespace carom
