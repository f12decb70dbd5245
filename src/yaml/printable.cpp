// Decides by table which characters are unprintable, and escapes them.
// A fixed table makes the result independent of the locale and of the C library.
#include "yaml/printable.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/letters.h"

namespace carom {

bool is_unprintable(char32_t code) {
  if (code < 0xA0) return is_control(code);
  struct Block {
    char32_t first, last;
  };
  // Unicode 15.1, DerivedGeneralCategory.txt. The visible signs of Cf, U+0600 to U+08E2, are left out.
  static constexpr Block blocks[] = {{0xAD, 0xAD},       {0x61C, 0x61C},     {0x180E, 0x180E},   {0x200B, 0x200F},
                                     {0x2028, 0x202E},   {0x2060, 0x206F},   {0xFEFF, 0xFEFF},   {0xFFF9, 0xFFFB},
                                     {0x13430, 0x1343F}, {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}};
  return is_control(code) || std::any_of(std::begin(blocks), std::end(blocks),
                                         [&](const Block& block) { return code >= block.first && code <= block.last; });
}

string escaped(char32_t code) {
  const auto number = uint32_t(code);
  if (number < 0x20) return fmt::format("\\x{:02x}", number);
  if (number < 0x10000) return fmt::format("\\u{:04x}", number);
  return fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + ((number - 0x10000) >> 10), 0xDC00 + ((number - 0x10000) & 0x3FF));
}

string printable(string_view text) {
  string result;
  for (size_t i = 0; i < text.size();) {
    char32_t code = 0;
    const int length = utf8_length(text, i, code);  // 0: not UTF-8

    if (length == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    else if (is_unprintable(code))
      result += escaped(code);
    else
      result += text.substr(i, size_t(length));
    i += size_t(max(length, 1));
  }
  return result;
}

}  // namespace carom
