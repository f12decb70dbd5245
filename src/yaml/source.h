#pragma once
// The bytes of a scene file, read and checked before anything interprets them.
#include <cstdint>
#include <string>
#include <string_view>

namespace carom {

/// Where something stands: in the file (source 0) or in the --set number source - 1.
struct Place {
  std::uint32_t source = 0;
  std::uint32_t offset = 0;  // bytes from the start of the source's text
  std::uint32_t length = 1;  // bytes
};

/// One text that errors point into.
struct Source {
  std::string name;     // the path as the user named it, or "--set path=value"
  std::string text;     // UTF-8, no byte order mark, lines end in LF
  bool option = false;  // a --set: one line, no line numbers
};

class Diagnostics;

inline constexpr std::uint64_t max_source_bytes = 32 << 20;

/// The file's text without byte order mark and carriage returns at line ends. Never blocks on a FIFO, never reads a
/// device. On failure adds an error without a place to `diagnostics` and gives false.
bool read_source(const std::string& path, Source& source, Diagnostics& diagnostics);

/// Why no regular file can be read by this path, "there is no file" or the system's reason; empty: one can be, as far
/// as looking at it says.
std::string why_no_file(const std::string& path);

/// Refuses what no scene needs and a terminal or a parser may choke on: invalid UTF-8, control characters, tabs, and
/// more brackets than any scene has (the parser's scanner keeps all tokens of an open bracket in memory).
/// Tabs between words become spaces so that checking can go on; gives false if it cannot.
bool check_text(Source& source, std::uint32_t index, Diagnostics& diagnostics);

/// Bytes of the UTF-8 character at `text[i]`; 0 if it is not valid there. `code` is its code point.
int utf8_length(std::string_view text, std::size_t i, char32_t& code);

/// Control characters, byte order marks, non-characters: nothing that a text should hold. LF and tab count as such.
bool is_control(char32_t code);

}  // namespace carom
