#pragma once
// Numbers in messages and scenes: the fewest digits that are read back as the same number.
#include <charconv>

#include "std.h"

namespace carom::stress {

inline string text(double value) {
  char digits[40];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace carom::stress
