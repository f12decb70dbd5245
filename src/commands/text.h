#pragma once
// Numbers, lists and names for display. Not for files: those carry every digit.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/printable.h"

namespace carom {

/// Four significant digits and the unit: "0.4725 s". Not a number: "-".
std::string quantity(double value, std::string_view unit);
/// "1 frame", "12,000 frames".
std::string counted(std::uint64_t count, std::string_view singular, std::string_view plural);
/// Digits in groups of three: "1,234,567".
std::string grouped(std::uint64_t count);
/// "512 bytes", "3.2 MB" (powers of 1000).
std::string bytes_text(std::uint64_t bytes);
/// A time in seconds as text: "2.4 ms", "1.24 s", "3 min 20 s", "2 h 5 min".
std::string wait_text(double seconds);
/// "a", "a and b", "a, b and c"; beyond `most` names: "a, b and 7 more".
std::string listed(const std::vector<std::string>& names, std::size_t most = 10);
/// Breaks `text` at spaces so that no line is longer than `width` columns; further lines begin with `indent` spaces.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);
/// A word for a shell: quoted if necessary, unprintable characters by their bytes.
std::string shell_word(const std::string& word);

}  // namespace carom
