#pragma once
// The texts that errors point into, and places in them.

#include "std.h"

namespace carom {

/// A place in the file (source 0), or in a --set option or a table (a later source).
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

}  // namespace carom
