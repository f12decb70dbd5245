#pragma once
// The bytes of a scene file, read and checked before any parsing.

#include "std.h"

namespace carom {

/// A place in the file (source 0) or in a --set option (source - 1 is its number).
struct Place {
  uint32_t source = 0;
  uint32_t offset = 0;  // bytes from the start of the source's text
  uint32_t length = 1;  // bytes
};

/// One text that errors point into.
struct Source {
  /// The path as given by the user, or "--set path=value".
  string name;
  /// UTF-8, no byte order mark, lines end in LF.
  string text;
  /// A --set option, which is one line and has no line numbers.
  bool option = false;
};

class Diagnostics;

inline constexpr uint64_t max_source_bytes = 32 << 20;

/// Reads the file's text without byte order mark and without carriage returns at line ends.
/// Never blocks on a FIFO and never reads a device. On failure adds an error without a place and returns false.
bool read_source(const string& path, Source& source, Diagnostics& diagnostics);

/// The reason why this path cannot be read as a regular file: "there is no file" or the system's reason.
/// Empty: it can be read, as far as its metadata shows.
string why_no_file(const string& path);

/// Refuses what no scene needs and what may disturb a terminal or a parser.
/// These are invalid UTF-8, control characters, tabs, and more brackets than any scene has.
/// The parser's scanner keeps all tokens of an open bracket in memory.
/// Tabs between words become spaces, so that checking can continue. Returns false if it cannot.
bool check_text(Source& source, uint32_t index, Diagnostics& diagnostics);

/// The length in bytes of the UTF-8 character at `text[i]`, or 0 if it is not valid. `code` receives its code point.
int utf8_length(string_view text, size_t i, char32_t& code);

/// Control characters, byte order marks and non-characters, which no text should hold. LF and tab are included.
bool is_control(char32_t code);

}  // namespace carom
