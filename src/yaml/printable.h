#pragma once
// Text of unknown origin, a file's name or a title, as a person may see it.
#include <string>
#include <string_view>

namespace carom {

/// Whether a character shows nothing of itself or changes how others are shown: control characters, line separators,
/// marks that turn the direction of text or join and part letters unseen (Unicode's categories Cc, Cf, Zl and Zp, but
/// for the few visible ones of Cf).
bool is_unprintable(char32_t code);

/// The character by its number, as JSON and most languages write it: "\u202e"; beyond U+FFFF two such, a surrogate
/// pair.
std::string escaped(char32_t code);

/// `text` with what is unprintable, and bytes that are no UTF-8, written as "\x1b" or "\u202e".
std::string printable(std::string_view text);

}  // namespace carom
