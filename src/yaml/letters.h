#pragma once
// Letters of UTF-8 text, a code point counted as one.
#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

std::size_t letters_of(std::string_view text);

/// A text of at most `most` letters. A cut is marked with an ellipsis, which is one of them.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace carom
