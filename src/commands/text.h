#pragma once
// Numbers, lists and names for display. Not for files: those carry every digit.

#include "std.h"
#include "yaml/printable.h"

namespace carom {

/// Four significant digits and the unit: "0.4725 s". Not a number: "-".
string quantity(double value, string_view unit);
/// "1 frame", "12,000 frames".
string counted(uint64_t count, string_view singular, string_view plural);
/// Digits in groups of three: "1,234,567".
string grouped(uint64_t count);
/// "512 bytes", "3.2 MB" (powers of 1000).
string bytes_text(uint64_t bytes);
/// A time in seconds as text: "2.4 ms", "1.24 s", "3 min 20 s", "2 h 5 min".
string wait_text(double seconds);
/// "a", "a and b", "a, b and c"; beyond `most` names: "a, b and 7 more".
string listed(const vector<string>& names, size_t most = 10);
/// Breaks `text` at spaces so that no line is longer than `width` columns; further lines begin with `indent` spaces.
string wrapped(string_view text, size_t indent, size_t width);
/// A word for a shell: quoted if necessary, unprintable characters by their bytes.
string shell_word(const string& word);

}  // namespace carom
