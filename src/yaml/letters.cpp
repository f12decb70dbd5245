#include "yaml/letters.h"

#include "std.h"

namespace carom {
namespace {

/// All bytes of a letter but its first one are 10xxxxxx in binary.
bool begins_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

}  // namespace

int utf8_length(string_view text, size_t i, char32_t& code) {
  const auto byte = [&](size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x80) {
    code = first;
    return 1;
  }

  const int length = first >= 0xC2 && first <= 0xDF   ? 2
                     : first >= 0xE0 && first <= 0xEF ? 3
                     : first >= 0xF0 && first <= 0xF4 ? 4
                                                      : 0;
  if (length == 0 || i + size_t(length) > text.size()) return 0;

  code = first & (0x7F >> length);
  for (int k = 1; k < length; ++k) {
    const unsigned char next = byte(i + size_t(k));
    if ((next & 0xC0) != 0x80) return 0;
    code = (code << 6) | (next & 0x3F);
  }

  // Overlong forms, surrogates, and code points beyond U+10FFFF.
  if ((length == 3 && code < 0x800) || (length == 4 && (code < 0x10000 || code > 0x10FFFF))) return 0;
  if (code >= 0xD800 && code <= 0xDFFF) return 0;
  return length;
}

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 || code == 0xFEFF ||
         (code & 0xFFFE) == 0xFFFE || (code >= 0xFDD0 && code <= 0xFDEF);
}

size_t count_characters(string_view text) {
  size_t count = 0;
  for (size_t i = 0; i < text.size(); ++count) {
    char32_t code = 0;
    i += size_t(max(utf8_length(text, i, code), 1));
  }
  return count;
}

string in_lower_case(string_view text) {
  string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

size_t letters_of(string_view text) {
  return size_t(ranges::count_if(text, begins_letter));
}

string shortened(string_view text, size_t most) {
  size_t letters = 0, cut = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (!begins_letter(text[i])) continue;
    if (++letters == most) cut = i;
    if (letters > most) return string(text.substr(0, cut)) + "…";
  }
  return string(text);
}

}  // namespace carom
