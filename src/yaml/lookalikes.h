#pragma once
// Characters that look like one of ASCII and are none: dashes, spaces, quotes.

#include "std.h"

namespace carom {

struct Lookalike {
  char32_t code;
  string_view name;   // "a minus sign"
  string_view plain;  // what is meant: "`-`"
};

/// The one that begins at text[i]. None: another character begins there.
optional<Lookalike> lookalike_at(string_view text, size_t i);

/// Whether it is seen as a space, or not at all.
bool is_blank(const Lookalike& lookalike);

/// "U+2212 is a minus sign: write `-`", of the first one in `text`. Empty: there is none.
string lookalike_in(string_view text);

}  // namespace carom
