#pragma once
// The bytes of a scene file, read and checked before any parsing.

#include "std.h"
#include "yaml/place.h"

namespace carom {

class Diagnostics;

inline constexpr uint64_t max_source_bytes = 32 << 20;

/// Reads the file's text without byte order mark and without carriage returns at line ends.
/// Never blocks on a FIFO and never reads a device. On failure adds an error without a place and returns false.
bool read_source(const string& path, Source& source, Diagnostics& diagnostics);

/// The path of standard input, and how messages name it.
inline constexpr const char* standard_input = "-";

/// Reads all of standard input, or as much as a source may have; from here on read_source() has it by the path above.
/// To be called once. `stop_check` is called often, and may throw.
void read_standard_input(const function<void()>& stop_check);

/// The reason why this path cannot be read as a regular file: "there is no file" or the system's reason.
/// Empty: it can be read, as far as its metadata shows.
string why_no_file(const string& path);

/// Refuses what no scene needs and what may disturb a terminal or a parser.
/// These are invalid UTF-8, control characters, tabs, and more brackets than any scene has.
/// The parser's scanner keeps all tokens of an open bracket in memory.
/// Tabs between words become spaces, so that checking can continue. Returns false if it cannot.
bool check_text(Source& source, uint32_t index, Diagnostics& diagnostics);

}  // namespace carom
