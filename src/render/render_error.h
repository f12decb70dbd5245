#pragma once

#include "std.h"

namespace carom {

/// Drawing cannot continue. The text is for the user.
struct RenderError : runtime_error {
  using runtime_error::runtime_error;
};

}  // namespace carom
