#pragma once
// The error of this folder, and of all that writes into a run's folder.

#include "std.h"

namespace carom {

/// Writing cannot continue, or must not begin. The text is for the user.
struct ExportError : runtime_error {
  using runtime_error::runtime_error;
};

}  // namespace carom
