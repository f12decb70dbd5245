#pragma once
// The error of this folder, and of all that writes into a run's folder.
#include <stdexcept>

namespace carom {

/// Writing cannot continue, or must not begin. The text is for the user.
struct ExportError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace carom
