#pragma once
// Letters of UTF-8 text, a code point counted as one.

#include "std.h"

namespace carom {

size_t letters_of(string_view text);

/// A text of at most `most` letters. A cut is marked with an ellipsis, which is one of them.
string shortened(string_view text, size_t most);

}  // namespace carom
