#include "yaml/letters.h"

#include <algorithm>

#include "std.h"

namespace carom {
namespace {

/// All bytes of a letter but its first one are 10xxxxxx in binary.
bool begins_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

}  // namespace

size_t letters_of(string_view text) {
  return static_cast<size_t>(std::ranges::count_if(text, begins_letter));
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
