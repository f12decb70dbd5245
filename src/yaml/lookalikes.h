#pragma once
// Characters that look like one of ASCII and are none: dashes, spaces, quotes.
#include <optional>
#include <string>
#include <string_view>

namespace carom {

struct Lookalike {
  char32_t code;
  std::string_view name;   // "a minus sign"
  std::string_view plain;  // what is meant: "`-`"
};

/// The one that begins at text[i]. None: another character begins there.
std::optional<Lookalike> lookalike_at(std::string_view text, std::size_t i);

/// Whether it is seen as a space, or not at all.
bool is_blank(const Lookalike& lookalike);

/// "U+2212 is a minus sign: write `-`", of the first one in `text`. Empty: there is none.
std::string lookalike_in(std::string_view text);

}  // namespace carom
