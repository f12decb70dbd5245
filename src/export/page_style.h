#pragma once
// The style sheet of pages.

#include "std.h"

namespace carom {

extern const string_view page_style;

}  // namespace carom
