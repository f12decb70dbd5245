#pragma once
#include <stdexcept>

namespace carom {

/// Drawing cannot continue. The text is for the user.
struct RenderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace carom
