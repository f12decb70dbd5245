#pragma once
// What a sweep knows of one of its runs.

#include "std.h"

namespace carom {

enum class RunStatus : uint8_t {
  missing,
  done,
  failed,
  left_out  // its scene is invalid, and the sweep leaves such runs out
};

/// A run that is left out.
struct InvalidRun {
  size_t number = 0;
  string text;      // its errors, for a terminal
  string messages;  // the errors on one line, without places
};

}  // namespace carom
