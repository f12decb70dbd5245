#pragma once
// C++ text as tokens, for the tests that count and compare declarations.
#include <cstddef>
#include <string>
#include <vector>

namespace carom::testing {

/// A name, a number or a punctuator as written. A string is the token `""` and a character is `''`, whatever their
/// content.
struct Token {
  std::string text;
  std::size_t line = 0;  // from 1 on, where it begins
};

/// Without comments and preprocessor directives; the code of #if and of #else is both there.
/// Punctuators are single characters, but for `::`, `->`, `&&`, `==`, `!=`, `<=` and `>=`.
std::vector<Token> tokens_of(const std::string& text);

/// Whether it begins as names and keywords do.
bool is_name(const Token& token);

}  // namespace carom::testing
