#pragma once
// The style sheet of pages.

#include "std.h"

namespace carom {

string_view page_style();

}  // namespace carom
