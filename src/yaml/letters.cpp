#include "yaml/letters.h"

#include <algorithm>

namespace carom {
namespace {

/// All bytes of a letter but its first one are 10xxxxxx in binary.
bool begins_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

}  // namespace

std::size_t letters_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_letter));
}

std::string shortened(std::string_view text, std::size_t most) {
  std::size_t letters = 0, cut = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!begins_letter(text[i])) continue;
    if (++letters == most) cut = i;
    if (letters > most) return std::string(text.substr(0, cut)) + "…";
  }
  return std::string(text);
}

}  // namespace carom
